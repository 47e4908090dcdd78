"""A document as one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from markupsafe import Markup

from ...reports.chart.panel import chart_panel
from ...reports.common.page import exact, write_page
from ...reports.common.panels import HALF_WIDTH, Panel, swatch
from ...reports.common.quantities import display_unit
from ..model import Cell, Document, Figure, LegendEntry, Quantity, Table

TEMPLATE = Path(__file__).with_name("document.html")


def write_document(document: Document, path: Path) -> None:
    """Write the page of a document; equal documents have pages of equal bytes."""
    write_page(
        path,
        TEMPLATE,
        title=document.title,
        document=document,
        cell=cell_markup,
        is_number=_is_number,
        panels=_panels,
        legend=_legend,
    )


def cell_markup(cell: Cell) -> Markup | str:
    """Return a cell with its exact SI value in the markup; a name may continue in a new line."""
    if isinstance(cell, str):
        return Markup("__<wbr>").join(cell.split("__"))
    if not isinstance(cell, Quantity):
        return exact(cell)
    unit = display_unit(cell.unit)
    number = exact(cell.value, cell.unit, cell.digits)
    return number if cell.is_bare or not unit else Markup("{} {}").format(number, unit)


def _is_number(table: Table, column: int) -> bool:
    """True if a column has numbers, which are aligned to the right."""
    return not all(isinstance(row[column], str) for row in table.rows)


def _panels(figures: Sequence[Figure]) -> list[Panel]:
    return [chart_panel(each.label, each.name, each.words, each.chart, each.height, HALF_WIDTH) for each in figures]


def _legend(entries: Sequence[LegendEntry]) -> list[tuple[Markup, Sequence[str]]]:
    return [(swatch(entry.look), entry.lines) for entry in entries]
