"""A document as lines of a terminal."""

from __future__ import annotations

from ...campaigns.tables import align_columns
from ...reports.common.quantities import display_unit, in_shown_unit, number
from ..model import Cell, Document, Fold, Node, Quantity, Table, Text, nodes_of


def document_lines(document: Document) -> list[str]:
    """Return the lines that a terminal shows of a document."""
    return [line for node in nodes_of(document) for line in _lines(node)]


def cell_text(cell: Cell) -> str:
    """Return a cell as text; a quantity in its displayed unit."""
    if not isinstance(cell, Quantity):
        return number(cell)
    text = number(in_shown_unit(cell.value, cell.unit), cell.digits)
    unit = display_unit(cell.unit)
    return text if cell.is_bare or not unit else f"{text} {unit}"


def _lines(node: Node) -> list[str]:
    match node:
        case Text(text):
            return [text]
        case Fold(summary):
            return [summary]
        case Table() if node.rows:
            rows = [[cell_text(cell) for cell in row] for row in node.rows[: node.listed]]
            more = len(node.rows) - len(rows)
            return [*align_columns([list(node.heads), *rows]), *([f"and {more} more"] if more else [])]
    return []
