"""Loops back: edges from right to left, in lanes below everything that they pass. Lengths in px."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

from .graph import Edge, PortKey
from .placement import Placement, Point, Route

CLEARANCE = 8.0  # between a block and the nearest line next to it
PITCH = 5.0  # between lines


@dataclass
class _Column:
    """Blocks one above the other, between the abscissas ``left`` and ``right``."""

    left: float
    right: float
    leaving: list[PortKey]
    entering: list[PortKey]


def add_loops(placement: Placement, edges: Sequence[Edge]) -> None:
    """Add the routes of edges that lead back to a placement that has all others.

    The gaps between columns of blocks are widened for their vertical lines: at a column's sides there is nothing but
    horizontal lines, so nothing else changes. The lower a port, the nearer is its line to the block, so that loops
    which begin or end at one block do not cross each other.
    """
    if not edges:
        return
    columns = _columns(placement)
    heights = {key: point[1] for placed in placement.blocks for key, point in placed.ports.items()}
    homes = {key: _column_of(columns, placed.x) for placed in placement.blocks for key in placed.ports}
    for edge in edges:
        leaving, entering = homes[edge.source].leaving, homes[edge.target].entering
        if edge.source not in leaving:
            leaving.append(edge.source)
        if edge.target not in entering:
            entering.append(edge.target)
    verticals = _widen(placement, columns, heights)
    ports = {key: point for placed in placement.blocks for key, point in placed.ports.items()}
    _add_lanes(placement, edges, ports, verticals)


def _columns(placement: Placement) -> list[_Column]:
    columns: list[_Column] = []
    for box in sorted(placement.boxes, key=lambda box: box.x):
        if columns and box.x < columns[-1].right:
            columns[-1].right = max(columns[-1].right, box.x + box.width)
        else:
            columns.append(_Column(box.x, box.x + box.width, [], []))
    return columns


def _column_of(columns: Sequence[_Column], x: float) -> _Column:
    return next(column for column in columns if column.left <= x < column.right)


def _widen(
    placement: Placement, columns: Sequence[_Column], heights: dict[PortKey, float]
) -> dict[tuple[PortKey, bool], float]:
    """Make room for vertical lines; their abscissas by port and whether the line enters it."""
    verticals: dict[tuple[PortKey, bool], float] = {}
    shift, strips = 0.0, []
    for column in columns:
        for ports, enters in ((column.entering, True), (column.leaving, False)):
            edge_of_column = (column.left if enters else column.right) + shift
            width = CLEARANCE + PITCH * len(ports) if ports else 0.0
            if enters:  # the strip pushes its column to the right
                strips.append((column.left, width))
                shift += width
                edge_of_column += width
            for number, key in enumerate(sorted(ports, key=lambda key: -heights[key])):
                distance = CLEARANCE + PITCH * number
                verticals[key, enters] = edge_of_column + (-distance if enters else distance)
            if not enters:
                strips.append((column.right + 0.5, width))
                shift += width

    def moved(x: float) -> float:
        return x + sum(width for position, width in strips if x >= position)

    for placed in placement.blocks:
        x = moved(placed.x)
        placed.ports = {key: (px + x - placed.x, py) for key, (px, py) in placed.ports.items()}
        placed.x = x
    for terminal in placement.terminals:
        x = moved(terminal.x)
        terminal.point = (terminal.point[0] + x - terminal.x, terminal.point[1])
        terminal.x = x
    ends = {key: point for placed in placement.blocks for key, point in placed.ports.items()}
    ends |= {terminal.key: terminal.point for terminal in placement.terminals}
    for route in placement.routes:
        inner = [(moved(x), y) for x, y in route.points[1:-1]]
        route.points = [ends[route.edge.source], *inner, ends[route.edge.target]]
    placement.junctions = [(moved(x), y) for x, y in placement.junctions]
    placement.width += shift
    return verticals


def _add_lanes(
    placement: Placement,
    edges: Sequence[Edge],
    ports: dict[PortKey, Point],
    verticals: dict[tuple[PortKey, bool], float],
) -> None:
    """The lanes of loops, one for all edges of a port, the shortest ones uppermost."""
    groups: dict[PortKey, list[Edge]] = defaultdict(list)
    for edge in edges:
        groups[edge.source].append(edge)
    obstacles = [(box.x, box.x + box.width, box.bottom) for box in placement.boxes]
    for route in placement.routes:
        obstacles += [(min(a[0], b[0]), max(a[0], b[0]), max(a[1], b[1])) for a, b in route.segments()]
    spans = {
        source: (min(verticals[edge.target, True] for edge in group), verticals[source, False])
        for source, group in groups.items()
    }
    spans = {source: (min(span), max(span)) for source, span in spans.items()}
    for source in sorted(groups, key=lambda source: (spans[source][1] - spans[source][0], ports[source])):
        left, right = spans[source]
        lane = max(bottom for x0, x1, bottom in obstacles if x0 <= right + PITCH and x1 >= left - PITCH) + CLEARANCE
        obstacles.append((left, right, lane + PITCH - CLEARANCE))
        _add_routes(placement, groups[source], lane, ports, verticals)
        placement.height = max(placement.height, lane + PITCH)


def _add_routes(
    placement: Placement,
    group: Sequence[Edge],
    lane: float,
    ports: dict[PortKey, Point],
    verticals: dict[tuple[PortKey, bool], float],
) -> None:
    source = group[0].source
    (x0, y0), x1 = ports[source], verticals[source, False]
    if any(route.edge.source == source for route in placement.routes):
        placement.junctions.append((x1, y0))
    branches = sorted(group, key=lambda edge: verticals[edge.target, True])
    for number, edge in enumerate(branches):
        (x3, y3), x2 = ports[edge.target], verticals[edge.target, True]
        placement.routes.append(Route(edge, [(x0, y0), (x1, y0), (x1, lane), (x2, lane), (x2, y3), (x3, y3)]))
        if number > 0:
            placement.junctions.append((x2, lane))
