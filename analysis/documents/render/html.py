"""A document as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from markupsafe import Markup, escape

from ...reports.chart.panel import chart_panel, wide_figure
from ...reports.common.page import exact, write_page
from ...reports.common.panels import HALF_WIDTH, Panel, swatch
from ...reports.common.quantities import display_unit
from ..model import Cell, Code, Document, Figure, LegendEntry, Phrase, Quantity, Rich, Table
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
        panels=_panels,
        legend=_legend,
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
        case LegendEntry(look, lines):
            return swatch(look) + ", ".join(lines)
        case Quantity(value, unit, digits, is_bare):
            number = exact(value, unit, digits)
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


def _panels(figures: Sequence[Figure]) -> list[Panel]:
    return [
        Panel(each.label, wide_figure(each.name, each.words, each.chart, each.height))
        if each.is_wide
        else chart_panel(each.label, each.name, each.words, each.chart, each.height, HALF_WIDTH)
        for each in figures
    ]


def _legend(entries: Sequence[LegendEntry]) -> list[tuple[Markup, Sequence[str]]]:
    return [(swatch(entry.look), entry.lines) for entry in entries]
