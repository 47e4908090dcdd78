"""Assembly of rows below each other, and routing of edges that ELK does not route. Lengths are in px.

These are feedback edges and edges between rows. Such an edge leaves its port to the right, runs down to a lane below
its row, and from there to its target: up in the same row, down in the next one, or through the channel on the left to
another row. Vertical lines are in strips inserted at the sides of columns, which contain only horizontal lines.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import Enum

from .graph import Edge, PortKey
from .placement import Arrangement, Point, Route
from .rows import columns_of

CLEARANCE = 8.0  # distance between a box and the nearest line
PITCH = 5.0  # distance between parallel lines
ROW_GAP = 16.0  # distance between a lane and the next row


class PortDirection(Enum):
    """Direction of an edge at its port: leaving, or entering from a lane below or above, or from the channel."""

    LEAVES = "leaves"
    FROM_BELOW = "from below"
    FROM_ABOVE = "from above"
    FROM_CHANNEL = "from the channel"


Stub = tuple[PortKey, PortDirection]


@dataclass
class _Group:
    """The edges of one port in ``row``; ``lanes`` are the abscissas of its lanes by row, ``y`` their ordinates."""

    source: PortKey
    row: int
    edges: list[Edge]
    lanes: dict[int, list[float]] = field(default_factory=dict)
    y: dict[int, float] = field(default_factory=dict)
    channel: float = 0.0


def join_rows(rows: Sequence[Arrangement], edges: Sequence[Edge]) -> Arrangement:
    """Combine all rows into one arrangement, with the edges that are not within a row."""
    return _Lanes(rows, edges).join()


class _Lanes:
    def __init__(self, rows: Sequence[Arrangement], edges: Sequence[Edge]) -> None:
        self.rows = rows
        self.edges = edges
        self.homes = {key: number for number, row in enumerate(rows) for key in row.ports()}
        self.first = {key for row in rows for box in columns_of(row.boxes)[0].boxes for key in box.ports}
        self.stubs: dict[Stub, float] = {}
        for number in range(len(rows)):
            self.widen(number)
        self.ports = {key: point for row in rows for key, point in row.ports().items()}
        self.groups = self.make_groups()
        self.left = self.add_channel()
        self.tops = self.add_lanes()

    def join(self) -> Arrangement:
        """Combine all rows into one arrangement."""
        routes = [Route(edge, self.line(edge, group)) for group in self.groups for edge in group.edges]
        joined = Arrangement(max(row.width for row in self.rows) - self.left, self.tops[-1])
        for row, top in zip(self.rows, self.tops, strict=False):
            row.move(0.0, top)
            joined.blocks += row.blocks
            joined.terminals += row.terminals
            joined.routes += row.routes
        joined.routes += routes
        joined.move(-self.left, 0.0)
        return joined

    def way_in(self, edge: Edge) -> PortDirection:
        """Return the direction in which an edge enters its target."""
        source, target = self.homes[edge.source], self.homes[edge.target]
        if edge.target in self.first and target not in (source, source + 1):
            return PortDirection.FROM_CHANNEL
        return PortDirection.FROM_ABOVE if target > source else PortDirection.FROM_BELOW

    def lane_row(self, edge: Edge) -> int:
        """Return the row above the last lane of an edge: the target's row, or the one before it."""
        return self.homes[edge.target] - (self.way_in(edge) is PortDirection.FROM_ABOVE)

    def widen(self, number: int) -> None:
        """Insert strips for vertical lines at the sides of a row's columns.

        Strips of even and odd rows are offset by half a pitch, so lines of two rows do not cover each other. The line
        closest to a block belongs to its lowest port if lines arrive from below, and to its highest port if they arrive
        from above, which avoids crossings.
        """
        row = self.rows[number]
        ports, parity = row.ports(), PITCH / 2.0 * (number % 2)
        stubs: dict[Stub, None] = dict.fromkeys((edge.source, PortDirection.LEAVES) for edge in self.edges)
        stubs |= dict.fromkeys((edge.target, self.way_in(edge)) for edge in self.edges)
        strips: list[tuple[float, float]] = []
        shift = 0.0
        for column in columns_of(row.boxes):
            here = {key for box in column.boxes for key in box.ports}
            for leaves in (False, True):
                chosen = [
                    (key, way)
                    for key, way in stubs
                    if key in here and (way is PortDirection.LEAVES) is leaves and way is not PortDirection.FROM_CHANNEL
                ]
                chosen.sort(key=lambda stub: _nearness(stub, ports))
                width = CLEARANCE + PITCH * (len(chosen) + 1) if chosen else 0.0
                side = (column.right if leaves else column.left + width) + shift
                for position, stub in enumerate(chosen):
                    distance = CLEARANCE + PITCH * position
                    if leaves:
                        self.stubs[stub] = math.ceil((side + distance - parity) / PITCH) * PITCH + parity
                    else:
                        self.stubs[stub] = math.floor((side - distance - parity) / PITCH) * PITCH + parity
                strips.append((column.right + 0.5 if leaves else column.left, width))
                shift += width
        row.stretch(strips)

    def make_groups(self) -> list[_Group]:
        by_source: dict[PortKey, list[Edge]] = defaultdict(list)
        for edge in self.edges:
            by_source[edge.source].append(edge)
        groups = [_Group(source, self.homes[source], edges) for source, edges in by_source.items()]
        for group in groups:
            group.lanes[group.row] = [self.stubs[group.source, PortDirection.LEAVES]]
            for edge in group.edges:
                if self.way_in(edge) is not PortDirection.FROM_CHANNEL:
                    end = self.stubs[edge.target, self.way_in(edge)]
                    group.lanes.setdefault(self.lane_row(edge), []).append(end)
        return groups

    def add_channel(self) -> float:
        """Assign vertical lines on the left to groups that reach other rows; return the smallest abscissa."""

        def rows_apart(group: _Group) -> int:
            return max(abs(self.lane_row(edge) - group.row) for edge in group.edges)

        through = sorted((group for group in self.groups if rows_apart(group)), key=rows_apart)
        for number, group in enumerate(through):
            group.channel = -CLEARANCE - PITCH * number
            for ends in group.lanes.values():
                ends.append(group.channel)
        return min((group.channel for group in through), default=0.0)

    def add_lanes(self) -> list[float]:
        """Add the lanes below each row, the shortest uppermost; return the top of each row, and the bottom."""
        tops = [0.0]
        for number, row in enumerate(self.rows):
            obstacles = [(box.x, box.x + box.width, box.bottom) for box in row.boxes]
            bottoms = {key: box.bottom for box in row.boxes for key in box.ports}
            for (key, _), x in self.stubs.items():
                if key in bottoms:  # the line between a port and its vertical line
                    left, right = sorted((x, self.ports[key][0]))
                    obstacles.append((left, right, bottoms[key]))
            for route in row.routes:
                obstacles += [(min(a[0], b[0]), max(a[0], b[0]), max(a[1], b[1])) for a, b in route.segments()]
            bottom = max(bottom for _, _, bottom in obstacles)
            chosen = [group for group in self.groups if number in group.lanes]
            for group in sorted(chosen, key=lambda group: max(group.lanes[number]) - min(group.lanes[number])):
                left, right = min(group.lanes[number]), max(group.lanes[number])
                passed = [y for x0, x1, y in obstacles if x0 <= right + PITCH and x1 >= left - PITCH]
                lane = max(passed, default=0.0) + CLEARANCE
                obstacles.append((left, right, lane + PITCH - CLEARANCE))
                group.y[number] = lane + tops[number]
                bottom = max(bottom, lane)
            tops.append(tops[number] + bottom + (ROW_GAP if number + 1 < len(self.rows) else 0.0))
        return tops

    def line(self, edge: Edge, group: _Group) -> list[Point]:
        """Return the points of an edge's line."""
        (x0, y0), (x9, y9) = self.ports[edge.source], self.ports[edge.target]
        y0, y9 = y0 + self.tops[self.homes[edge.source]], y9 + self.tops[self.homes[edge.target]]
        x1, lane = self.stubs[edge.source, PortDirection.LEAVES], group.y[group.row]
        points = [(x0, y0), (x1, y0), (x1, lane)]
        if self.way_in(edge) is PortDirection.FROM_CHANNEL:
            return [*points, (group.channel, lane), (group.channel, y9), (x9, y9)]
        if self.lane_row(edge) != group.row:
            points += [(group.channel, lane), (group.channel, group.y[self.lane_row(edge)])]
            lane = points[-1][1]
        x8 = self.stubs[edge.target, self.way_in(edge)]
        return [*points, (x8, lane), (x8, y9), (x9, y9)]


def _nearness(stub: Stub, ports: dict[PortKey, Point]) -> tuple[bool, float]:
    """Return the sort key that orders vertical lines by distance from their block."""
    is_above, height = stub[1] is PortDirection.FROM_ABOVE, ports[stub[0]][1]
    return is_above, height if is_above else -height
