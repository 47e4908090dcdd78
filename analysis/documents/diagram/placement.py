"""Positions of blocks, terminals and edges of a laid-out system. Lengths are in px from its upper left corner."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from .graph import DiagramBlock, DiagramPort, Edge, PortKey
from .shapes import Label, Shape

Point = tuple[float, float]
Segment = tuple[Point, Point]


@dataclass
class PlacedBlock:
    """A placed block; ``ports`` are the ends of edges, and ``inner`` is a nested system's content at ``origin``."""

    block: DiagramBlock
    shape: Shape
    x: float
    y: float
    width: float
    height: float
    ports: dict[PortKey, Point]
    inner: Arrangement | None = None
    origin: Point = (0.0, 0.0)

    @property
    def bottom(self) -> float:
        return self.y + self.height

    def move(self, x: float, y: float) -> None:
        """Move the block with its ports."""
        self.x, self.y = self.x + x, self.y + y
        self.ports = {key: (px + x, py + y) for key, (px, py) in self.ports.items()}


@dataclass
class Terminal:
    """A connector of the system; an edge ends at its ``point``."""

    key: PortKey
    port: DiagramPort
    label: Label
    x: float
    y: float
    width: float
    height: float
    point: Point

    @property
    def bottom(self) -> float:
        return self.y + self.height

    @property
    def ports(self) -> dict[PortKey, Point]:
        return {self.key: self.point}

    def move(self, x: float, y: float) -> None:
        """Move the terminal with its point."""
        self.x, self.y, self.point = self.x + x, self.y + y, (self.point[0] + x, self.point[1] + y)


@dataclass
class Route:
    """An edge with the points of its line from source to target."""

    edge: Edge
    points: list[Point]

    def segments(self) -> Iterator[Segment]:
        """Yield the straight segments of the line."""
        return pairwise(self.points)


@dataclass
class Arrangement:
    """The placed blocks, terminals and edges of a system, or of a row of its blocks."""

    width: float
    height: float
    blocks: list[PlacedBlock] = field(default_factory=list)
    terminals: list[Terminal] = field(default_factory=list)
    routes: list[Route] = field(default_factory=list)

    @property
    def boxes(self) -> list[PlacedBlock | Terminal]:
        """Blocks and terminals, which lines must avoid."""
        return [*self.blocks, *self.terminals]

    def ports(self) -> dict[PortKey, Point]:
        """Return the points at which edges end."""
        return {key: point for box in self.boxes for key, point in box.ports.items()}

    def move(self, x: float, y: float) -> None:
        """Move all items."""
        for box in self.boxes:
            box.move(x, y)
        for route in self.routes:
            route.points = [(px + x, py + y) for px, py in route.points]

    def stretch(self, strips: Sequence[tuple[float, float]]) -> None:
        """Insert empty strips, a width at each abscissa; ends of edges stay at their ports."""

        def shift(x: float) -> float:
            return sum(width for position, width in strips if x >= position)

        for box in self.boxes:
            box.move(shift(box.x), 0.0)
        ends = self.ports()
        for route in self.routes:
            inner = [(x + shift(x), y) for x, y in route.points[1:-1]]
            route.points = [ends[route.edge.source], *inner, ends[route.edge.target]]
        self.width += sum(width for _, width in strips)

    def junctions(self) -> Iterator[tuple[PortKey, Point]]:
        """Yield the points where lines of one port diverge or merge, with the source port."""
        sources: dict[Point, PortKey] = {}
        for end in ("source", "target"):
            groups: dict[PortKey, list[Route]] = defaultdict(list)
            for route in self.routes:
                groups[getattr(route.edge, end)].append(route)
            for routes in groups.values():
                segments = list(dict.fromkeys(segment for route in routes for segment in route.segments()))
                for point in dict.fromkeys(point for segment in segments for point in segment):
                    if len({way for segment in segments for way in _iterate_directions(point, segment)}) > 2:
                        sources.setdefault(point, routes[0].edge.source)
        for point, source in sources.items():
            yield source, point


def _iterate_directions(point: Point, segment: Segment) -> Iterator[Point]:
    """Yield the directions, as signs, in which a segment leads away from a point on it."""
    (x0, y0), (x1, y1) = segment
    x, y = point
    if min(x0, x1) <= x <= max(x0, x1) and min(y0, y1) <= y <= max(y0, y1):
        for end_x, end_y in segment:
            if (end_x, end_y) != point:
                yield float((end_x > x) - (end_x < x)), float((end_y > y) - (end_y < y))
