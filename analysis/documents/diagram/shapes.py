"""Sizes of blocks and their texts before layout. Lengths are in px."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from ....common.visible import on_one_line, visible
from ..common.quantities import declared_unit
from ..font.text import shorten, text_width
from .graph import DiagramBlock, DiagramPort, Edge, PortKey, Side

NAME_SIZE, TEXT_SIZE, LIST_SIZE = 11.0, 9.0, 9.0
LONGEST = 40  # characters of a label
LINE = 13.0  # distance between ports
LIST_LINE = 12.0
HEADER = 36.0  # height of a block's heading: name and model
MARGIN = 8.0  # distance between a block's side and its text
GAP = 14.0  # distance between the labels of inputs and outputs
TERMINAL = 16.0  # height of a system's connector


@dataclass(frozen=True)
class Label:
    """A line of text followed by its unit or remark; ``width`` includes both."""

    text: str
    remark: str = ""

    @property
    def width(self) -> float:
        return text_width(self.text, TEXT_SIZE) + self.remark_width

    @property
    def remark_width(self) -> float:
        return text_width(f" {self.remark}", TEXT_SIZE) if self.remark else 0.0


@dataclass(frozen=True)
class BlockEntry:
    """An entry in the list at the bottom of a block: a fault, or a parameter with the ``edge`` that sets it."""

    text: str
    x: float
    line: int
    edge: Edge | None = None


@dataclass
class Shape:
    """The smallest size of a block, and its texts. ``foot`` is the height of its list."""

    width: float
    height: float
    foot: float
    labels: dict[PortKey, Label] = field(default_factory=dict)
    items: list[BlockEntry] = field(default_factory=list)


def plain(text: str, longest: int = LONGEST) -> str:
    """Return a name to draw: on one line, without direction marks, shortened if long."""
    return shorten(on_one_line(visible(text)), longest)


def shape_of(block: DiagramBlock, notes: dict[PortKey, str]) -> Shape:
    """Return the shape of a component; ``notes`` are the remarks on values that enter a port."""
    labels = {key: port_label(key, port, notes.get(key, "")) for key, port in block.visible_ports().items()}
    widths = {side: max((labels[key].width for key in labels if key.side is side), default=0.0) for side in Side}
    both = sum(widths.values()) + (GAP if all(widths.values()) else 0.0)
    head = text_width(plain(block.name), NAME_SIZE, is_bold=True) + GAP + text_width(block.kind_label, LIST_SIZE)
    entries = [fault_text(fault) for fault in block.faults] + [f"{parameter_text(edge)}," for edge in block.parameters]
    longest = max((text_width(text, LIST_SIZE) for text in entries), default=0.0)
    width = max(both, head, text_width(plain(block.model), TEXT_SIZE), longest) + 2.0 * MARGIN
    items = list(_items(block, width))
    lines = max((item.line for item in items), default=-1) + 1
    foot = lines * LIST_LINE + 4.0
    rows = max(sum(key.side is side for key in labels) for side in Side)
    return Shape(width, HEADER + rows * LINE + foot, foot, labels, items)


def port_label(key: PortKey, port: DiagramPort, note: str) -> Label:
    """Return the label of a port: its unit if it is an output or unconnected, else the conversion of its input."""
    has_unit = key.side is Side.OUT or not port.is_connected
    return Label(plain(port.label), plain(note or (declared_unit(port.unit) if has_unit else "")))


def fault_text(fault: str) -> str:
    """Return a fault as its block displays it."""
    return plain(f"fault: {fault}", 2 * LONGEST)


def parameter_text(edge: Edge) -> str:
    """Return the text of a parameter that another one sets: its name, and the name of the other if different."""
    source, target = (
        key.name.removesuffix("[]") + elements
        for key, elements in zip((edge.source, edge.target), edge.elements, strict=True)
    )
    text = target if source == target else f"{target} = {source}"
    return plain(f"{text} ({edge.change})" if edge.change else text, 2 * LONGEST)


def _items(block: DiagramBlock, width: float) -> Iterable[BlockEntry]:
    """Return faults, a line each, then parameters, as many per line as fit."""
    line = -1
    for fault in block.faults:
        line += 1
        yield BlockEntry(fault_text(fault), MARGIN, line)
    x = width
    for number, edge in enumerate(block.parameters, 1):
        text = parameter_text(edge) + ("," if number < len(block.parameters) else "")
        length = text_width(text, LIST_SIZE)
        if x + length > width - MARGIN:
            line, x = line + 1, MARGIN
        yield BlockEntry(text, x, line, edge)
        x += length + text_width(" ", LIST_SIZE)
