"""A law's graph as a drawing: sources on the left, what is done to them on the edges, outputs on the right."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyArrowPatch
from matplotlib.path import Path

from ...reports.common.quantities import MINUS
from ...reports.common.style import BLUE, FAINT, INK, VERMILION, house_style, new_figure
from ...reports.common.svg import svg_bytes
from .expression_tree import BINARY, IDENTITY, OUTPUT_NUMBERS, UNARY, Node, expression_tree, nodes_of
from .law import Law
from .layers import Edge, Layout

COLUMN, ROW = 1.75, 0.66  # in, between layers and between neighbours
RADIUS = 0.13  # in, of a node
LABEL = (0.95, 0.2)  # in, about the size of an edge's label
OUTPUT_NAMES = dict(zip(OUTPUT_NUMBERS, ("u1", "u2"), strict=True))

Point = tuple[float, float]


def law_svg(law: Law) -> bytes:
    with house_style():
        return svg_bytes(law_figure(law), law.name, text_as_paths=True)


def law_figure(law: Law) -> Figure:
    """The graph of what the outputs depend on. Call it inside `house_style`."""
    nodes = {node.number: node for node in nodes_of(expression_tree(law.matrix))}
    edges = [(other.number, node.number) for node in nodes.values() for _, other in node.terms]
    layout = Layout(list(nodes), edges)
    heights = [y for path in layout.paths.values() for _, y in path] + [y for _, y in layout.nodes.values()]
    columns = max(x for x, _ in layout.nodes.values())
    width, height = COLUMN * (columns + 1.2), ROW * (max(heights) - min(heights) + 1.6)
    figure = new_figure(max(height, 1.5), width)
    axes = figure.add_subplot()
    axes.set_axis_off()
    axes.set_xlim(-0.7, columns + 0.5)
    axes.set_ylim(max(heights) + 0.8, min(heights) - 0.8)
    curves = {edge: _curve(path) for edge, path in layout.paths.items()}
    style = "-|>,head_length=0.45,head_width=0.22"
    for curve in curves.values():
        axes.add_patch(FancyArrowPatch(path=curve, arrowstyle=style, mutation_scale=10, color=FAINT, linewidth=0.9))
    labels = {
        (other.number, node.number): UNARY[operation].edge
        for node in nodes.values()
        for operation, other in node.terms
        if operation != IDENTITY
    }
    for edge, (x, y) in _label_places(curves, list(labels), list(layout.nodes.values())).items():
        _label(axes, x, y, labels[edge])
    for number, (x, y) in layout.nodes.items():
        _node(axes, nodes[number], x, y)
    return figure


def _curve(points: list[Point]) -> Path:
    """A smooth line through the points, level at each of them, up to the rim of the last node."""
    vertices, codes = [points[0]], [Path.MOVETO]
    ends = [*points[1:-1], (points[-1][0] - RADIUS / COLUMN, points[-1][1])]
    for (x0, y0), (x1, y1) in zip(points, ends, strict=False):
        middle = 0.5 * (x0 + x1)
        vertices += [(middle, y0), (middle, y1), (x1, y1)]
        codes += [Path.CURVE4] * 3
    return Path(vertices, codes)


def _label_places(curves: dict[Edge, Path], labelled: list[Edge], nodes: list[Point]) -> dict[Edge, Point]:
    """Where the labels of edges stand: each on its edge, as far as can be from nodes, labels and other edges."""
    sizes = np.array([COLUMN / LABEL[0], ROW / LABEL[1]])
    traces = {edge: np.array(curve.to_polygons(closed_only=False)[0]) for edge, curve in curves.items()}
    positions: dict[Edge, Point] = {}
    for edge in sorted(labelled, key=lambda edge: (len(np.asarray(curves[edge].vertices)), edge)):
        trace = traces[edge]
        candidates = [np.array([x, np.interp(x, trace[:, 0], trace[:, 1])]) for x in _columns(trace)]
        taken = np.array([*nodes, *positions.values()])
        others = np.concatenate([traces[other] for other in traces if other != edge] or [trace[:1] + 99.0])

        def room(point: np.ndarray, taken: np.ndarray = taken, others: np.ndarray = others) -> float:
            to_labels = np.abs((taken - point) * sizes).max(axis=1).min()
            to_edges = np.abs((others - point) * sizes).max(axis=1).min()
            return float(min(to_labels, 1.0) + 0.5 * min(to_edges, 1.0))

        positions[edge] = tuple(max(candidates, key=room).tolist())  # the first of the best
    return positions


def _columns(trace: np.ndarray) -> np.ndarray:
    """Abscissae at which a label may stand: not close to either end."""
    return np.linspace(trace[0, 0] + 0.3, trace[-1, 0] - 0.3, 9 * int(np.ceil(trace[-1, 0] - trace[0, 0])))


def _label(axes: Axes, x: float, y: float, text: str) -> None:
    box = {"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none"}
    axes.text(x, y, text, color=BLUE, fontsize=7.5, ha="center", va="center", zorder=3, bbox=box)


def _node(axes: Axes, node: Node, x: float, y: float) -> None:
    """A source with its name, or a circle with the operation that gathers, and the node's number."""
    source = (node.source or "").replace("pi", "π").replace("theta", "θ").replace("-", MINUS)
    if source and not node.terms:
        box = {"boxstyle": "round,pad=0.35", "facecolor": "#f2f2f2", "edgecolor": FAINT, "linewidth": 0.8}
        axes.text(x, y, source, ha="center", va="center", bbox=box, zorder=4)
        return
    is_output = node.number in OUTPUT_NAMES
    colour = VERMILION if is_output else INK
    size = 2.0 * 72.0 * RADIUS - 1.0
    axes.plot(x, y, "o", markersize=size, markerfacecolor="white", markeredgecolor=colour, zorder=4)
    if len(node.terms) > 1 or source:
        axes.text(x, y, BINARY[node.operation], ha="center", va="center", zorder=5)
    name = f"{OUTPUT_NAMES[node.number]} = z{node.number}" if is_output else f"z{node.number}"
    if source:
        name += f", from {source}"
    offset = (0.0, -72.0 * RADIUS - 1.0)
    axes.annotate(
        name,
        (x, y),
        offset,
        textcoords="offset points",
        ha="center",
        va="top",
        fontsize=7.5,
        color=colour if is_output else FAINT,
        zorder=5,
    )
