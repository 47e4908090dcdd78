"""Figures as SVG, the same bytes every time: documents for files and notebooks, and elements inside a page."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib
from lxml import etree
from markupsafe import Markup
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure

from ..interactive.charts import Drawing
from ..interactive.read_figure import STILL, read_charts, still_artists

IMAGE_DPI = 200  # of what is no vector


class Picture(Figure):
    """matplotlib's figure, which a notebook shows where it stands as a cell's result."""

    def _repr_svg_(self) -> str:
        return svg_bytes(self, "notebook", text_as_paths=True).decode()


def svg_bytes(figure: Figure, name: str, *, text_as_paths: bool) -> bytes:
    """A figure as an SVG document without date or version; ``name`` salts its identifiers."""
    buffer = io.BytesIO()
    settings: Any = {"svg.hashsalt": name, "svg.fonttype": "path" if text_as_paths else "none"}
    with matplotlib.rc_context(settings), _lay_out(figure) as canvas:
        canvas.print_svg(buffer, metadata={"Date": None, "Creator": None})
    return buffer.getvalue()


@contextmanager
def _lay_out(figure: Figure) -> Iterator[FigureCanvasSVG]:
    """The figure's SVG, with its layout made: savefig would draw the whole once more to have it made."""
    before, dpi, engine = figure.canvas, figure.dpi, figure.get_layout_engine()
    canvas = FigureCanvasSVG(figure)  # whose text the layout measures
    try:
        if engine is not None:
            engine.execute(figure)
            figure.set_layout_engine("none")
        figure.dpi = IMAGE_DPI
        yield canvas
    finally:
        if engine is not None:
            figure.set_layout_engine(engine)
        figure.set_canvas(before)
        figure.dpi = dpi


SVG = "{http://www.w3.org/2000/svg}"
XLINK_HREF = "{http://www.w3.org/1999/xlink}href"
DECIMALS = re.compile(r"(\.\d\d)\d+")  # beyond hundredths of a point
REFERENCE = re.compile(r"url\(#([^)]+)\)")


def inline_svg(figure: Figure, name: str, description: str, *, kind: str = "", reduced: bool = False) -> Drawing:
    """A figure as an <svg> element for a page.

    Every id is prefixed with ``name``, which must differ between the figures of a page;
    ``description`` is what a screen reader says. Text stays text: it can be searched and copied. Coordinates are
    cut to hundredths of a point. The figure is as wide as what it stands in; ``kind`` is a class more, for the style.
    ``reduced``: the page has only envelopes of its lines.
    """
    for artist in still_artists(figure):
        artist.set_gid(STILL)
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
    for still in root.xpath(f"//*[@id='{name}-{STILL}']"):
        del still.attrib["id"]
        still.set("class", STILL)
    etree.strip_tags(root, etree.Comment)
    del root.attrib["width"], root.attrib["height"]
    root.set("role", "img")
    root.set("aria-label", description)
    root.set("class", f"figure {kind}".rstrip())
    return Drawing(Markup(etree.tostring(root, encoding="unicode")), read_charts(figure, reduced=reduced))
