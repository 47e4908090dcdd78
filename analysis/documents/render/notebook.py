"""A document as HTML of a notebook's cell."""

from __future__ import annotations

from itertools import islice

from markupsafe import Markup

from ...reports.common.notebook import Grid, notebook_view
from ...reports.common.panels import HALF_WIDTH
from ..model import Cell, Diagram, Document, Figures, KeyNumbers, LegendEntry, Node, Table, Text, Verdict, nodes_of
from .html import cell_markup
from .words import cell_text, key_numbers_text, rich_text

PLOTTED = 4  # figures


def document_view(document: Document) -> str:
    """Return the HTML of a document: its statements, the first rows of its tables, its first figures."""
    nodes = nodes_of(document)
    grids = [
        Grid(node.heads, [[_cell(cell) for cell in row] for row in node.rows])
        for node in nodes
        if isinstance(node, Table)
    ]
    figures = list(islice((figure for node in nodes if isinstance(node, Figures) for figure in node.draw()), PLOTTED))
    diagrams = [node for node in nodes if isinstance(node, Diagram)]
    plot = None
    if figures or diagrams:
        from ...reports.chart.plot import POINTS, plot_charts  # matplotlib takes as long to import as all the rest

    if figures:
        charts, titles = [each.chart for each in figures], [each.label for each in figures]
        plot = plot_charts(charts, figures[0].height, HALF_WIDTH, columns=2, titles=titles)
    elif diagrams:
        chart, width, height = diagrams[0].draw()
        plot = plot_charts([chart], height / POINTS, width / POINTS)
    return notebook_view(document.title, [text for node in nodes for text in _words(node)], grids, plot)


def _cell(cell: Cell) -> Markup | str:
    """Return a cell as markup; the look of a line needs the style of a page."""
    return cell_text(cell) if isinstance(cell, LegendEntry) else cell_markup(cell)


def _words(node: Node) -> list[str]:
    match node:
        case Text(content):
            return [rich_text(content)]
        case KeyNumbers():
            return [key_numbers_text(node)]
        case Verdict(lead, inner):
            return [rich_text(lead), *(text for each in inner for text in _words(each))]
    return []
