"""Drawing of a law's graph: sources on the left, functions on the edges, outputs on the right."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

import numpy as np

from ....design.laws.expression_tree import (
    BINARY,
    IDENTITY,
    OUTPUT_NUMBERS,
    UNARY,
    OperationNode,
    expression_tree,
    nodes_of,
)
from ....design.laws.law import NetworkOperator
from ....design.laws.layers import Edge, GraphLayout
from ...chart.lines import line
from ...chart.marks import outline, rectangle
from ...chart.symbols import BARB, arrow, mark, marker
from ...common.colours import BLUE, FAINT, INK, VERMILION
from ...common.quantities import MINUS
from ...font.text import text_width
from ...interactive.charts import Area, Axis, Backing, Chart, ChartNote, Curve
from ...pictures import Diagram

INCH = 72.0  # pt
COLUMN, ROW = 1.75 * INCH, 0.66 * INCH  # pt, distances between layers and between neighbours
RADIUS = 0.13 * INCH  # pt, of a node
LABEL = (0.95 * INCH, 0.2 * INCH)  # pt, about the size of an edge's label
LOWEST = 1.5 * INCH  # pt, least height of a drawing
HEAD = 4.5  # pt, of an arrow
TEXT, SMALL = 9.0, 8.0  # pt
ROOM = 3.2  # pt, margin around the name of a source
POINTS = np.linspace(0.0, 1.0, 17)[1:, np.newaxis]  # values of the parameter of a piece of an edge, a Bezier curve
WHOLE = (0.0, 0.0, 1.0, 1.0)  # box of axes as large as the picture
CENTRED, BELOW = ("center", "center"), ("center", "top")
OUTPUT_NAMES = dict(zip(OUTPUT_NUMBERS, ("u1", "u2"), strict=True))

Point = tuple[float, float]


def law_diagram(law: NetworkOperator) -> Diagram:
    """Return the graph of a law as a diagram."""
    return Diagram("law", f"Graph of {law.name}", partial(law_chart, law))


def law_chart(law: NetworkOperator) -> tuple[Chart, float, float]:
    """Return a chart without axes of the nodes on which outputs depend, and its width and height (pt)."""
    nodes = {node.number: node for node in nodes_of(expression_tree(law.matrix))}
    edges = [(other.number, node.number) for node in nodes.values() for _, other in node.terms]
    layout = GraphLayout(list(nodes), edges)
    heights = [y for path in layout.paths.values() for _, y in path] + [y for _, y in layout.nodes.values()]
    columns = max(x for x, _ in layout.nodes.values())
    width, height = COLUMN * (columns + 1.2), max(ROW * (max(heights) - min(heights) + 1.6), LOWEST)
    traces = {edge: _trace(path, _half_width(nodes[edge[0]])) for edge, path in layout.paths.items()}
    labels = {
        (other.number, node.number): UNARY[operation].edge
        for node in nodes.values()
        for operation, other in node.terms
        if operation != IDENTITY
    }
    label_points = _label_points(traces, list(labels), list(layout.nodes.values()))
    backing = Backing("#ffffff", 1.0, 0.9)
    notes = [_note(labels[edge], at, BLUE, SMALL, backing=backing) for edge, at in label_points.items()]
    curves = [curve for trace in traces.values() for curve in _edge(trace)]
    areas: list[Area] = []
    for number, at in layout.nodes.items():
        areas += _box(nodes[number], at)
        curves += _circle(nodes[number], at)
        notes += _names(nodes[number], at)
    middle, half = (max(heights) + min(heights)) / 2.0, height / ROW / 2.0
    x, y = Axis(ends=(-0.7, columns + 0.5), size=0.0), Axis(ends=(middle + half, middle - half), size=0.0)
    return Chart(WHOLE, x, y, curves=curves, areas=areas, notes=notes), width, height


def _trace(points: list[Point], offset: float) -> np.ndarray:
    """Return a smooth line through the points, [points, 2], horizontal at each of them.

    It begins ``offset`` columns to the right of the first point, and ends at the rim of the last node.
    """
    begins = [(points[0][0] + offset, points[0][1]), *points[1:-1]]
    ends = [*points[1:-1], (points[-1][0] - RADIUS / COLUMN, points[-1][1])]
    spans = [np.array(begins[:1])]
    for begin, end in zip(begins, ends, strict=True):
        x, y = ((1.0 - POINTS) ** 3, 3.0 * POINTS * (1.0 - POINTS) ** 2), (3.0 * POINTS**2 * (1.0 - POINTS), POINTS**3)
        middle = 0.5 * (begin[0] + end[0])
        spans.append(
            x[0] * begin + x[1] * np.array([middle, begin[1]]) + y[0] * np.array([middle, end[1]]) + y[1] * end
        )
    return np.concatenate(spans)


def _edge(trace: np.ndarray) -> list[Curve]:
    """Return the line of an edge, and the arrow head at its end."""
    step = (trace[-1] - trace[-2]) * (COLUMN, -ROW)
    angle = math.atan2(step[1], step[0])
    begin = trace[-1] - HEAD * np.array([math.cos(angle) / COLUMN, -math.sin(angle) / ROW])
    head = arrow((float(begin[0]), float(begin[1])), angle, HEAD, FAINT, HEAD / BARB)
    return [line(trace[:, 0], trace[:, 1], FAINT, width=0.9), head]


def _label_points(traces: dict[Edge, np.ndarray], labelled: list[Edge], nodes: list[Point]) -> dict[Edge, Point]:
    """Return the centres of the labels of edges, each on its edge, as far as possible from other items."""
    sizes = np.array([COLUMN / LABEL[0], ROW / LABEL[1]])
    positions: dict[Edge, Point] = {}
    for edge in sorted(labelled, key=lambda edge: (len(traces[edge]), edge)):
        trace = traces[edge]
        candidates = [np.array([x, np.interp(x, trace[:, 0], trace[:, 1])]) for x in _columns(trace)]
        occupied = np.array([*nodes, *positions.values()])
        others = np.concatenate([traces[other] for other in traces if other != edge] or [trace[:1] + 99.0])

        def room(point: np.ndarray, occupied: np.ndarray = occupied, others: np.ndarray = others) -> float:
            to_labels = np.abs((occupied - point) * sizes).max(axis=1).min()
            to_edges = np.abs((others - point) * sizes).max(axis=1).min()
            return float(min(to_labels, 1.0) + 0.5 * min(to_edges, 1.0))

        positions[edge] = tuple(max(candidates, key=room).tolist())  # the first of equally good candidates
    return positions


def _columns(trace: np.ndarray) -> np.ndarray:
    """Return the candidate abscissas of a label, not close to either end of its edge."""
    return np.linspace(trace[0, 0] + 0.3, trace[-1, 0] - 0.3, 9 * int(np.ceil(trace[-1, 0] - trace[0, 0])))


def _source(node: OperationNode) -> str:
    return (node.source or "").replace("pi", "π").replace("theta", "θ").replace("-", MINUS)


def _half_width(node: OperationNode) -> float:
    """Return half the width, in columns, of the box of a source without inputs; 0 for other nodes."""
    return 0.0 if node.terms or not node.source else (text_width(_source(node), TEXT) / 2.0 + ROOM) / COLUMN


def _box(node: OperationNode, at: Point) -> list[Area]:
    """Return the box of a source without inputs."""
    across, down = _half_width(node), (TEXT / 2.0 + ROOM) / ROW
    if not across:
        return []
    x, y = at
    box = rectangle(x - across, x + across, y - down, y + down, "#f2f2f2", 1.0)
    return [box, outline(box.x, box.y, FAINT, 0.8)]


def _circle(node: OperationNode, at: Point) -> list[Curve]:
    """Return the circle of an output, or of a node that combines inputs."""
    if node.source and not node.terms:
        return []
    colour = VERMILION if node.number in OUTPUT_NAMES else INK
    return [mark(*at, marker("o", 2.0 * RADIUS - 1.0, colour, fill="#ffffff"))]


def _names(node: OperationNode, at: Point) -> Iterator[ChartNote]:
    """Yield the texts of a node: a source's name in its box; or an operation in a circle and the node's number."""
    source = _source(node)
    if source and not node.terms:
        yield _note(source, at, INK, TEXT)
        return
    if len(node.terms) > 1 or source:
        yield _note(BINARY[node.operation], at, INK, TEXT)
    is_output = node.number in OUTPUT_NAMES
    name = f"{OUTPUT_NAMES[node.number]} = z{node.number}" if is_output else f"z{node.number}"
    if source:
        name += f", from {source}"
    offset = (0.0, -RADIUS - 1.0)
    yield _note(name, at, VERMILION if is_output else FAINT, SMALL, offset, BELOW)


def _note(
    text: str,
    at: Point,
    colour: str,
    size: float,
    offset: Point = (0.0, 0.0),
    align: tuple[str, str] = CENTRED,
    backing: Backing | None = None,
) -> ChartNote:
    return ChartNote(text, at, (False, False), offset, align, colour.lower(), size, backing=backing)
