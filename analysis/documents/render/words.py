"""Cells and sentences of documents as plain text, for a terminal and for a notebook's words."""

from __future__ import annotations

from ...reports.common.quantities import display_unit, in_display_unit, number
from ..model import Cell, Code, KeyNumbers, LegendEntry, Phrase, Quantity, Rich


def cell_text(cell: Cell) -> str:
    """Return a cell as text; a quantity in its displayed unit."""
    match cell:
        case Code(text):
            return text
        case Phrase(content):
            return rich_text(content)
        case LegendEntry(_, lines):
            return ", ".join(lines)
        case Quantity(value, unit, digits, is_bare):
            text = number(in_display_unit(value, unit), digits)
            return text if is_bare or not display_unit(unit) else f"{text} {display_unit(unit)}"
    return number(cell)


def key_numbers_text(numbers: KeyNumbers) -> str:
    """Return short numbers with their names in one line."""
    return "; ".join(f"{name} {cell_text(cell)}" for name, cell in numbers.entries)


def rich_text(content: Rich) -> str:
    """Return a sentence as text."""
    return content if isinstance(content, str) else "".join(map(cell_text, content))
