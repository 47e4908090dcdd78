"""Cells and sentences of documents as plain text, for a terminal and for a notebook's words."""

from __future__ import annotations

from ...reports.common.quantities import display_unit, in_display_unit, number
from ..model import Cell, Code, Document, Interval, KeyNumbers, LegendEntry, Phrase, Quantity, Rich, Verdict


def cell_text(cell: Cell) -> str:
    """Return a cell as text; a quantity in its displayed unit."""
    match cell:
        case Code(text):
            return text
        case Phrase(content):
            return rich_text(content)
        case LegendEntry(_, lines):
            return ", ".join(lines)
        case Interval(low, high):
            return f"{cell_text(low)} to {cell_text(high)}"
        case Quantity(value, unit, digits, is_bare, decimals):
            text = number(in_display_unit(value, unit), digits, decimals)
            return text if is_bare or not display_unit(unit) else f"{text} {display_unit(unit)}"
    return number(cell)


def rich_text(content: Rich) -> str:
    """Return a sentence as text."""
    return content if isinstance(content, str) else "".join(map(cell_text, content))


def number_line(numbers: KeyNumbers) -> str:
    """Return key numbers as one line."""
    return "; ".join(f"{name} {cell_text(cell)}" for name, cell in numbers.entries)


def lead_text(document: Document) -> str:
    """Return the answer of a document, that of its verdict."""
    return next(rich_text(node.lead) for node in document.summary if isinstance(node, Verdict))
