"""A document as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby
from pathlib import Path

from markupsafe import Markup, escape

from ...reports.chart.legend import swatch_of
from ...reports.chart.panel import chart_panel, wide_figure
from ...reports.common.colours import Look
from ...reports.common.page import exact, write_page
from ...reports.common.panels import HALF_WIDTH, PANEL_WIDTH, Panel, mark_swatch, swatch
from ...reports.common.quantities import display_unit
from ...reports.interactive.charts import Curve, Marker
from ..model import Cell, Code, Document, Figure, Interval, LegendEntry, Phrase, Quantity, Rich, Table
from .diagram import diagram_svg

TEMPLATE = Path(__file__).with_name("document.html")


def write_document(document: Document, path: Path) -> None:
    """Write the page of a document; equal documents have pages of equal bytes."""
    write_page(
        path,
        TEMPLATE,
        title=document.title,
        document=document,
        cell=cell_markup,
        rich=rich_markup,
        is_number=_is_number,
        is_unbroken=_is_unbroken,
        is_long=_is_long,
        rows=_rows,
        entry_swatch=_swatch,
        diagram=diagram_svg,
    )


def cell_markup(cell: Cell) -> Markup:
    """Return a cell with its exact SI value in the markup; a name may continue in a new line."""
    match cell:
        case str():
            return Markup("__<wbr>").join(cell.split("__"))
        case Code(text):
            return Markup("<code>{}</code>").format(text)
        case Phrase(content):
            return rich_markup(content)
        case LegendEntry(_, lines):
            return _swatch(cell) + ", ".join(lines)
        case Interval(low, high):
            return Markup("{} to {}").format(cell_markup(low), cell_markup(high))
        case Quantity(value, unit, digits, is_bare, decimals):
            number = exact(value, unit, digits, decimals)
            return number if is_bare or not display_unit(unit) else Markup("{} {}").format(number, display_unit(unit))
    return exact(cell)


def rich_markup(content: Rich, *, is_sentence: bool = False) -> Markup:
    """Return a sentence as markup; ``is_sentence``: with a capital letter and a full stop."""
    inline = [content] if isinstance(content, str) else list(content)
    if is_sentence and isinstance(inline[0], str):
        inline[0] = inline[0][:1].upper() + inline[0][1:]
    return Markup("").join(map(cell_markup, inline)) + (escape(".") if is_sentence else Markup(""))


def _is_number(table: Table, column: int) -> bool:
    """True if a column has numbers, which are aligned to the right."""
    return not all(isinstance(row[column], str | Code | Phrase | LegendEntry) for row in table.rows)


def _is_unbroken(cell: Cell) -> bool:
    """True for a cell that stays in one line."""
    return isinstance(cell, Phrase | LegendEntry)


def _is_long(table: Table, column: int) -> bool:
    """True if a column has code that is not narrowed."""
    cells = (row[column] for row in table.rows)
    return any(isinstance(cell, Code) and cell.is_long for cell in cells)


def _rows(figures: Sequence[Figure]) -> list[tuple[str, list[Panel]]]:
    """Return runs of figures of one width in order: ``wide``, or a kind of grid."""
    return [(kind, [_panel(figure) for figure in run]) for kind, run in groupby(figures, _kind)]


def _kind(figure: Figure) -> str:
    return "wide" if figure.is_wide else "" if figure.is_narrow else "halves"


def _panel(figure: Figure) -> Panel:
    arguments = (figure.name, figure.words, figure.chart, figure.height)
    legend = [(_swatch(entry), ", ".join(entry.lines)) for entry in figure.legend]
    title = figure.chart.title
    if figure.is_wide:
        return Panel(figure.label, wide_figure(*arguments, title=title), legend)
    width = PANEL_WIDTH if figure.is_narrow else HALF_WIDTH
    return chart_panel(figure.label, *arguments, width, title=title)._replace(legend=legend)


def _swatch(entry: LegendEntry) -> Markup:
    match entry.look:
        case Look():
            return swatch(entry.look)
        case Marker():
            return mark_swatch(entry.look)
        case Curve():
            return swatch_of(entry.look)
