"""A laid-out system: where its blocks, terminals and edges are. Lengths in px, from the system's upper left corner."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise

from .graph import Block, Edge, Port, PortKey
from .shapes import Label, Shape

Point = tuple[float, float]
Segment = tuple[Point, Point]


@dataclass
class Placed:
    """A block. ``ports`` are the points at which edges end; ``inner`` is what a system has inside, at ``origin``."""

    block: Block
    shape: Shape
    x: float
    y: float
    width: float
    height: float
    ports: dict[PortKey, Point]
    inner: Placement | None = None
    origin: Point = (0.0, 0.0)

    @property
    def bottom(self) -> float:
        return self.y + self.height


@dataclass
class Terminal:
    """A connector of the system itself, at ``point`` of its label."""

    key: PortKey
    port: Port
    label: Label
    x: float
    y: float
    width: float
    height: float
    point: Point

    @property
    def bottom(self) -> float:
        return self.y + self.height


@dataclass
class Route:
    """An edge with the points of its line, from its source to its target."""

    edge: Edge
    points: list[Point]

    def segments(self) -> Iterator[Segment]:
        return pairwise(self.points)


@dataclass
class Placement:
    """A system; ``junctions`` are the points at which lines from one port part."""

    width: float
    height: float
    blocks: list[Placed] = field(default_factory=list)
    terminals: list[Terminal] = field(default_factory=list)
    routes: list[Route] = field(default_factory=list)
    junctions: list[Point] = field(default_factory=list)

    @property
    def boxes(self) -> list[Placed | Terminal]:
        """What lines go around."""
        return [*self.blocks, *self.terminals]
