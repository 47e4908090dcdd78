"""Drawing of the diagram as SVG: text remains text, reproducible to the byte. Lengths are in px.

Groups of class ``block`` list the signals of the block in ``data-signals`` as JSON. Groups of class ``edge`` list there
the signals from which the edge takes its values, in the order of its ``data-targets``. A parameter in the list of a
block is a group of class ``parameter`` with both attributes.
"""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterable, Sequence

from lxml import etree
from markupsafe import Markup

from ....common.visible import on_one_line, visible
from ..common import colours
from ..font.text import text_width
from .graph import DiagramBlock, Edge, PortKey, Side
from .placement import Arrangement, PlacedBlock, Point, Route, Segment, Terminal
from .shapes import HEADER, LIST_LINE, LIST_SIZE, MARGIN, NAME_SIZE, TEXT_SIZE, Label, plain
from .strokes import uncovered

INK, FAINT, PAPER = (f"var(--diagram-{name}, {colour})" for name, colour in (
    ("ink", colours.INK), ("faint", colours.FAINT), ("paper", "#ffffff")))  # fmt: skip
COLOURS = {
    "plants": INK,
    "sensors": colours.GREEN,
    "navigation": colours.BLUE,
    "guidance": colours.PURPLE,
    "control": colours.VERMILION,
    "actuators": colours.ORANGE,
    "sequencing": colours.SKY,
}
FONT = "'DejaVu Sans', Verdana, 'Segoe UI', sans-serif"
WARNING = "#a84300"  # colour of faults
BORDER = 2.0  # margin around the diagram
POINTED = "7"  # width of the line's area that reacts to the pointer
ARROW = 6.0  # length of an arrow's head
TO_LABEL = 10.0  # distance from a port to its label


def draw(system: DiagramBlock, placement: Arrangement) -> Markup:
    """Return the <svg> element of a laid-out system."""
    width, height = placement.width + 2.0 * BORDER, placement.height + 2.0 * BORDER
    count = sum(1 for block in system.all_blocks() if not block.blocks)
    edges = sum(1 for _ in system.all_edges())
    root = etree.Element(
        "svg",
        {
            "xmlns": "http://www.w3.org/2000/svg",
            "class": "diagram",
            "role": "img",
            "aria-label": f"Block diagram of {_line(system.name)}: {count} blocks, {edges} connections",
            "viewBox": f"{_number(-BORDER)} {_number(-BORDER)} {_number(width)} {_number(height)}",
            "width": _number(width),
            "height": _number(height),
            "style": f"--wide: {_number(width)}px; background: {PAPER}",
            "font-family": FONT,
        },
    )
    _draw_system(root, placement, (0.0, 0.0), {})
    return Markup(etree.tostring(root, encoding="unicode"))


def _draw_system(parent: etree._Element, placement: Arrangement, origin: Point, outer: dict[str, str]) -> None:
    group = etree.SubElement(parent, "g")
    if origin != (0.0, 0.0):
        group.set("transform", f"translate({_number(origin[0])} {_number(origin[1])})")
    colours = outer | {placed.block.path: COLOURS.get(placed.block.kind, FAINT) for placed in placement.blocks}
    for placed in placement.blocks:
        _draw_frame(group, placed, colours[placed.block.path])
    earlier: dict[PortKey, list[Segment]] = defaultdict(list)
    for route in placement.routes:
        source = route.edge.source
        _draw_edge(group, route, earlier[source], colours.get(source.block, FAINT))
        earlier[source] += route.segments()
    for source, (x, y) in placement.junctions():
        attributes = {"cx": _number(x), "cy": _number(y), "r": "2", "fill": colours.get(source.block, FAINT)}
        etree.SubElement(group, "circle", attributes)
    for placed in placement.blocks:
        _draw_text(group, placed)
        if placed.inner is not None:
            _draw_system(group, placed.inner, (placed.x + placed.origin[0], placed.y + placed.origin[1]), colours)
    for terminal in placement.terminals:
        _draw_terminal(group, terminal)


def _draw_frame(parent: etree._Element, placed: PlacedBlock, colour: str) -> None:
    frame = {"x": placed.x, "y": placed.y, "width": placed.width, "height": placed.height, "rx": 3.0}
    attributes = {name: _number(length) for name, length in frame.items()}
    fill = "none" if placed.inner is not None else PAPER
    etree.SubElement(parent, "rect", attributes | {"fill": fill, "stroke": colour, "stroke-width": "1.2"})
    head = f"M{_number(placed.x)} {_number(placed.y + HEADER - 4.0)}h{_number(placed.width)}"
    etree.SubElement(parent, "path", {"d": head, "stroke": colour, "stroke-width": "0.6"})


def _draw_edge(parent: etree._Element, route: Route, earlier: Iterable[Segment], colour: str) -> None:
    """Draw an edge where no ``earlier`` line of its port covers it, and a transparent line for the pointer."""
    attributes = {"class": "edge", "data-signals": _json(a for a, _ in route.edge.pairs)}
    group = etree.SubElement(parent, "g", attributes | {"data-targets": _json(b for _, b in route.edge.pairs)})
    _title(group, edge_text(route.edge))
    stretches = "".join(map(_path, uncovered(route.points, earlier)))
    line = {"d": stretches, "fill": "none", "stroke": colour}
    etree.SubElement(group, "path", line)
    x, y = route.points[-1]
    head = f"M{_number(x)} {_number(y)}l{_number(-ARROW)} -2.5v5z"
    etree.SubElement(group, "path", {"d": head, "fill": colour})
    whole = {"class": "whole-line", "d": _path(route.points), "fill": "none", "color": colour}
    etree.SubElement(group, "path", whole | {"stroke": "transparent", "stroke-width": POINTED})


def _path(points: Sequence[Point]) -> str:
    return "M" + "L".join(f"{_number(x)} {_number(y)}" for x, y in points)


def _draw_text(parent: etree._Element, placed: PlacedBlock) -> None:
    """Draw the texts of a block."""
    block, shape = placed.block, placed.shape
    signals = [signal for key, port in block.ports.items() if not key.entry for signal in port.signals]
    group = etree.SubElement(parent, "g", {"class": "block", "data-block": block.path, "data-signals": _json(signals)})
    _title(group, "\n".join(filter(None, [f"{block.path}: {block.model}", block.description])))
    left, right = placed.x + MARGIN, placed.x + placed.width - MARGIN
    _text(group, plain(block.name), left, placed.y + 14.0, NAME_SIZE, INK, is_bold=True)
    _text(group, plain(block.model), left, placed.y + 26.0, TEXT_SIZE, FAINT)
    _text(group, block.kind_label, right, placed.y + 14.0, LIST_SIZE, FAINT, is_right=True)
    if placed.inner is None:
        for key, label in shape.labels.items():
            _draw_port(group, key, label, placed.ports[key], is_open=not block.ports[key].is_connected)
    top = placed.bottom - shape.foot if placed.inner is None else placed.y + HEADER
    for item in shape.items:
        y = top + item.line * LIST_LINE + LIST_SIZE
        if item.edge is None:
            _text(group, item.text, placed.x + item.x, y, LIST_SIZE, WARNING)
            continue
        entry = etree.SubElement(group, "g", {"class": "parameter"})
        entry.set("data-signals", _json(source for source, _ in item.edge.pairs))
        entry.set("data-targets", _json(target for _, target in item.edge.pairs))
        _text(entry, item.text, placed.x + item.x, y, LIST_SIZE, FAINT)


def _draw_port(parent: etree._Element, key: PortKey, label: Label, point: Point, *, is_open: bool) -> None:
    x, y = point
    if is_open:
        attributes = {"cx": _number(x), "cy": _number(y), "r": "2.5", "fill": PAPER, "stroke": FAINT}
        etree.SubElement(parent, "circle", attributes)
    baseline = y + 0.35 * TEXT_SIZE
    start = x + MARGIN if key.side is Side.IN else x - MARGIN - label.width
    _draw_label(parent, label, start, baseline)


def _draw_label(parent: etree._Element, label: Label, x: float, baseline: float) -> None:
    _text(parent, label.text, x, baseline, TEXT_SIZE, INK)
    if label.remark:
        start = x + text_width(f"{label.text} ", TEXT_SIZE)
        _text(parent, label.remark, start, baseline, TEXT_SIZE, FAINT)


def _draw_terminal(parent: etree._Element, terminal: Terminal) -> None:
    attributes = {"class": "terminal", "data-signals": _json(terminal.port.signals)}
    group = etree.SubElement(parent, "g", attributes)
    frame = {"x": terminal.x, "y": terminal.y, "width": terminal.width, "height": terminal.height, "rx": 8.0}
    numbers = {name: _number(length) for name, length in frame.items()}
    etree.SubElement(group, "rect", numbers | {"fill": PAPER, "stroke": FAINT})
    x = terminal.x + (terminal.width - terminal.label.width) / 2.0
    _draw_label(group, terminal.label, x, terminal.y + terminal.height / 2.0 + 0.35 * TEXT_SIZE)


def edge_text(edge: Edge) -> str:
    """Describe an edge in one line: its ends and the conversion."""
    ends = []
    for key, names in zip((edge.source, edge.target), zip(*edge.pairs, strict=True), strict=True):
        owner = f"{key.block}." if key.block else ""
        size = f"[{len(names)}]" if key.name.endswith("[]") else ""
        ends.append(f"{owner}{key.name.removesuffix('[]')}{size}")
    return ", ".join(filter(None, (f"{ends[0]} → {ends[1]}", edge.note)))


def _title(parent: etree._Element, text: str) -> None:
    etree.SubElement(parent, "title").text = "\n".join(_line(line) for line in text.split("\n"))


def _text(
    parent: etree._Element,
    text: str,
    x: float,
    y: float,
    size: float,
    colour: str,
    *,
    is_bold: bool = False,
    is_right: bool = False,
) -> None:
    """Draw a line of text at its computed width, independent of the reader's fonts."""
    if not text:
        return
    width = text_width(text, size, is_bold=is_bold)
    attributes = {"x": _number(x - width if is_right else x), "y": _number(y), "font-size": _number(size)}
    attributes |= {"fill": colour, "textLength": _number(width), "lengthAdjust": "spacingAndGlyphs"}
    if is_bold:
        attributes["font-weight"] = "bold"
    etree.SubElement(parent, "text", attributes).text = text


def _line(text: str) -> str:
    return on_one_line(visible(text))


def _json(names: Iterable[str]) -> str:
    return json.dumps(list(names), separators=(",", ":"))


def _number(length: float) -> str:
    """Return a length rounded to hundredths of a px, as text."""
    return f"{round(length, 2) + 0.0:g}" if abs(length) < 1e4 else f"{length:.2f}"
