"""Renderer of a document as HTML of a notebook cell."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice
from typing import TYPE_CHECKING

from markupsafe import Markup

from ..cell import Cell, LegendEntry
from ..common.notebook import CellGrid, notebook_view
from ..common.panels import HALF_WIDTH, PANEL_WIDTH
from ..model import Document, KeyNumbers, Listing, Medium, Node, Table, Text, Verdict, nodes_of
from ..pictures import Diagram, Figure, Figures, Plot
from .html import cell_markup
from .words import cell_text, heads_of, number_line, rich_text, rows_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

ROWS = 2  # rows of figures


def document_view(document: Document) -> str:
    """Return the HTML of a document: its statements, the first rows of its tables, its first figures."""
    nodes = nodes_of(document, Medium.NOTEBOOK)
    grids = [
        CellGrid(_heads(node), [[_cell(cell) for cell in row] for row in _rows(node)])
        for node in nodes
        if isinstance(node, Table | Listing)
    ]
    figures, key = figures_of(document), _key(nodes)
    plot = next((node.draw() for node in nodes if isinstance(node, Plot)), None)
    plot = plot or (plot_figures(figures, key) if figures else _plot_diagram(nodes))
    words = [text for node in nodes for text in _words(node)]
    return notebook_view(document.title, words, grids, plot)


def figures_of(document: Document) -> list[Figure]:
    """Return the first figures of a document."""
    groups = (node for node in nodes_of(document, Medium.NOTEBOOK) if isinstance(node, Figures))
    figures = (figure for group in groups for figure in group.draw())
    first = list(islice(figures, 1))
    return [*first, *islice(figures, ROWS * _columns(first) - 1)] if first else []


def _columns(figures: Sequence[Figure]) -> int:
    """Return the number of figures per row."""
    return 3 if figures and figures[0].is_narrow else 2


def _key(nodes: Sequence[Node]) -> list[str]:
    """Return the legend of the first figures if it refers to their first lines."""
    first = next((node for node in nodes if isinstance(node, Figures)), None)
    if first is None or not first.is_in_order:
        return []
    return [", ".join(entry.lines) for entry in first.legend]


def plot_figures(figures: Sequence[Figure], key: Sequence[str] = ()) -> Drawing:
    """Return figures side by side as one matplotlib figure with their legends; ``key`` is the common legend."""
    from ..chart.plot import plot_charts  # matplotlib is slow to import

    panes = [(each, chart) for each in figures for chart in (each.chart, each.below) if chart is not None]
    is_stacked = len(panes) > len(figures)
    labels = [
        "" if chart is each.below or chart.x.label.startswith(each.label) else each.label for each, chart in panes
    ]
    return plot_charts(
        [chart for _, chart in panes],
        max(each.height for each in figures) / (2.0 if is_stacked else 1.0),
        PANEL_WIDTH if figures[0].is_narrow else HALF_WIDTH,
        columns=1 if is_stacked else min(_columns(figures), len(figures)),
        titles=[": ".join(filter(None, (label, chart.title))) for label, (_, chart) in zip(labels, panes, strict=True)],
        legends=[[curve.name for curve in chart.curves] if each.legend else [] for each, chart in panes],
        key=key,
    )


def _plot_diagram(nodes: Sequence[Node]) -> Drawing | None:
    diagram = next((node for node in nodes if isinstance(node, Diagram)), None)
    if diagram is None:
        return None
    from ..chart.plot import POINTS, plot_charts

    chart, width, height = diagram.draw()
    return plot_charts([chart], height / POINTS, width / POINTS)


def _heads(node: Table | Listing) -> Sequence[str]:
    """Return a head for each column; for a listing its heading."""
    if isinstance(node, Table):
        return heads_of(node)
    return [node.heading, *[""] * (len(node.rows[0]) - 1 if node.rows else 0)]


def _rows(node: Table | Listing) -> Sequence[Sequence[Cell]]:
    return rows_of(node) if isinstance(node, Table) else node.rows


def _cell(cell: Cell) -> Markup | str:
    """Return the markup of a cell, without looks of lines, which need the style sheet of a page."""
    return cell_text(cell) if isinstance(cell, LegendEntry) else cell_markup(cell)


def _words(node: Node) -> list[str]:
    match node:
        case Text(content):
            return [rich_text(content)]
        case KeyNumbers():
            return [number_line(node)]
        case Verdict(lead, inner):
            return [rich_text(lead), *(text for each in inner for text in _words(each))]
    return []
