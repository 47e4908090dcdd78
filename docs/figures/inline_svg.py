"""Figures of matplotlib as elements of a page."""

from __future__ import annotations

import re

from lxml import etree
from markupsafe import Markup
from matplotlib.figure import Figure

from perilune.analysis.reports.common.svg import svg_bytes

SVG = "{http://www.w3.org/2000/svg}"
XLINK_HREF = "{http://www.w3.org/1999/xlink}href"
DECIMALS = re.compile(r"(\.\d\d)\d+")  # beyond hundredths of a point
REFERENCE = re.compile(r"url\(#([^)]+)\)")


def inline_svg(figure: Figure, name: str, description: str, *, kind: str = "") -> Markup:
    """A figure as an <svg> element for a page.

    Every id is prefixed with ``name``, which must differ between the figures of a page;
    ``description`` is what a screen reader says. Text stays text: it can be searched and copied. Coordinates are
    cut to hundredths of a point. The figure is as wide as what it stands in; ``kind`` is a class more, for the style.
    """
    root = etree.fromstring(svg_bytes(figure, name, text_as_paths=False), etree.XMLParser(resolve_entities=False))
    for unwanted in (*root.iter(f"{SVG}metadata"), *root.iter(f"{SVG}style")):
        parent = unwanted.getparent()
        assert parent is not None  # neither is the root
        parent.remove(unwanted)
    for element in root.iter():
        if not isinstance(element.tag, str):
            continue
        for key, value in element.attrib.items():
            if key == "id":
                element.set(key, f"{name}-{value}")
            elif key == XLINK_HREF and value.startswith("#"):
                element.set(key, f"#{name}-{value[1:]}")
            elif "url(#" in value:
                element.set(key, REFERENCE.sub(rf"url(#{name}-\1)", value))
            elif key in ("d", "x", "y"):
                element.set(key, DECIMALS.sub(r"\1", value))
    etree.strip_tags(root, etree.Comment)
    del root.attrib["width"], root.attrib["height"]
    root.set("role", "img")
    root.set("aria-label", description)
    root.set("class", f"figure {kind}".rstrip())
    return Markup(etree.tostring(root, encoding="unicode"))
