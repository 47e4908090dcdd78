"""A document as HTML of a notebook's cell."""

from __future__ import annotations

from ...reports.common.notebook import Grid, notebook_view
from ...reports.common.panels import HALF_WIDTH
from ..model import Document, Figures, Table, Text, nodes_of
from .html import cell_markup

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
    return notebook_view(document.title, [node.text for node in nodes if isinstance(node, Text)], grids, plot)
