"""Writer of the documentation's pictures: `make figures`, after build_fmus.py."""

from __future__ import annotations

import re
from pathlib import Path

from lxml import etree
from matplotlib.figure import Figure

from perilune.analysis.documents.common.svg import svg_bytes
from perilune.common.paths import ROOT

IMAGES = ROOT / "docs" / "images"
LARGEST = 100_000  # bytes of a picture in git
COORDINATES = re.compile(r"(?<=[ \"(,-])(\d+\.\d)\d+")  # of paths and marks, beyond tenths of a point
LINES = set("MLz 0123456789.-\n")  # of a path without curves


def write_picture(figure: Figure, path: Path) -> Path:
    """Write a figure as a compact SVG file. Raises ValueError if it is larger than `LARGEST`."""
    root = etree.fromstring(svg_bytes(figure, path.stem, text_as_paths=True))
    for element in root.iter("{*}g", "{*}path", "{*}use"):
        element.tail = element.text = None
        _round(element)
        _share_style(element)
    drawing = etree.tostring(root, xml_declaration=True, encoding="UTF-8")
    if len(drawing) > LARGEST:
        raise ValueError(f"{path.name} has {len(drawing)} bytes, {LARGEST} are permitted: draw fewer points")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(drawing)
    return path


def _round(element: etree._Element) -> None:
    parent = element.getparent()
    if parent is not None and parent.tag.endswith("defs") and not element.get("id", "").startswith("m"):
        return  # glyphs are scaled up
    for name in ("x", "y", "points"):
        value = element.get(name)
        if value is not None:
            element.set(name, COORDINATES.sub(r"\1", value))
    path = element.get("d")
    if path is not None:
        element.set("d", _polyline(path) if set(path) <= LINES else COORDINATES.sub(r"\1", path))


def _polyline(path: str) -> str:
    """Return a path of move and line commands in tenths of a point; lines are relative to the previous point."""
    tokens, last, short = path.split(), (0, 0), []
    for index, token in enumerate(tokens):
        if token in "ML":
            x, y = (round(10.0 * float(number)) for number in tokens[index + 1 : index + 3])
            if token == "M":
                short.append(f"M{x / 10:g} {y / 10:g}")
            elif x == last[0] or y == last[1]:
                short.append(f"v{(y - last[1]) / 10:g}" if x == last[0] else f"h{(x - last[0]) / 10:g}")
            else:
                short.append(f"l{(x - last[0]) / 10:g} {(y - last[1]) / 10:g}")
            last = x, y
        elif token == "z":
            short.append("z")
    return "".join(short)


def _share_style(group: etree._Element) -> None:
    """Move a style common to all marks of a group to the group."""
    styles = {child.get("style") for child in group}
    if len(group) > 1 and len(styles) == 1 and all(str(child.tag).endswith("use") for child in group):
        (style,) = styles
        if style is not None and group.get("style") is None:
            group.set("style", style)
            for child in group:
                del child.attrib["style"]
