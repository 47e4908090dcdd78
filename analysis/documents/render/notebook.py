"""A document as HTML of a notebook's cell."""

from __future__ import annotations

from ...reports.common.notebook import Grid, notebook_view
from ...reports.common.panels import HALF_WIDTH
from ..model import Document, Figures, Node, Table, Text, Verdict, nodes_of
from .html import cell_markup
from .words import rich_text

PLOTTED = 4  # figures


def document_view(document: Document) -> str:
    """Return the HTML of a document: its statements, the first rows of its tables, its first figures."""
    nodes = nodes_of(document)
    grids = [
        Grid(node.heads, [[cell_markup(cell) for cell in row] for row in node.rows])
        for node in nodes
        if isinstance(node, Table)
    ]
    figures = [figure for node in nodes if isinstance(node, Figures) for figure in node.draw()][:PLOTTED]
    plot = None
    if figures:
        from ...reports.chart.plot import plot_charts  # matplotlib takes as long to import as all the rest

        charts, titles = [each.chart for each in figures], [each.label for each in figures]
        plot = plot_charts(charts, figures[0].height, HALF_WIDTH, columns=2, titles=titles)
    return notebook_view(document.title, [text for node in nodes for text in _words(node)], grids, plot)


def _words(node: Node) -> list[str]:
    match node:
        case Text(content):
            return [rich_text(content)]
        case Verdict(lead, inner):
            return [rich_text(lead), *(text for each in inner for text in _words(each))]
    return []
