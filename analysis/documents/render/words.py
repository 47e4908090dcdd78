"""Plain text of cells and sentences, for terminals and notebooks."""

from __future__ import annotations

from collections.abc import Sequence

from ....common.percent import short_percent
from ..cell import (
    Bar,
    Cell,
    Code,
    CommandLine,
    Digest,
    DisplayedNumber,
    Faint,
    Head,
    Interval,
    LegendEntry,
    Lines,
    Link,
    Percentage,
    Phrase,
    Quantity,
    QuantityVector,
    Rich,
    Row,
    RowHeading,
    RowNote,
    Strong,
    Track,
    VerdictCell,
)
from ..common.quantities import display_unit, in_display_unit, number
from ..model import Document, KeyNumbers, Table, Verdict


def cell_text(cell: Cell) -> str:
    """Return a cell as text, quantities in their displayed unit; empty for a drawing."""
    match cell:
        case Code(text) | CommandLine(text) | Digest(text) | DisplayedNumber(text) | Link(text) | VerdictCell(text):
            return text
        case Phrase(content, _):
            return rich_text(content)
        case Strong(inner) | Faint(inner):
            return cell_text(inner)
        case Lines(content):
            return ", ".join(map(cell_text, content))
        case LegendEntry(_, lines):
            return ", ".join(lines)
        case Interval(low, None):
            return f"at least {cell_text(low)}"
        case Interval(None, high):
            return f"at most {cell_text(high)}"
        case Interval(low, high):
            return f"{cell_text(low)} to {cell_text(high)}"
        case QuantityVector(values, unit, _, is_bare):
            text = ", ".join(cell_text(Quantity(value, unit, cell.digits, is_bare=True)) for value in values)
            return text if is_bare or not display_unit(unit) else f"{text} {display_unit(unit)}"
        case Percentage(fraction, decimals):
            return short_percent(fraction, decimals)
        case Track() | Bar():
            return ""
        case Quantity(value, unit, digits, is_bare, decimals):
            text = number(in_display_unit(value, unit), digits, decimals)
            return text if is_bare or not display_unit(unit) else f"{text} {display_unit(unit)}"
    return number(cell)


def rich_text(content: Rich) -> str:
    """Return a sentence as text."""
    return content if isinstance(content, str) else "".join(map(cell_text, content))


def heads_of(table: Table) -> list[str]:
    """Return the heading of every column as text, preceded by a common heading of several columns if it has one."""
    heads = [head if isinstance(head, Head) else Head(head) for head in table.heads]
    return [" ".join(filter(None, (head.text, each))) for head in heads for each in head.below or [""]]


def rows_of(table: Table) -> list[Sequence[Cell]]:
    """Return the rows of cells of a table, without headings and notes between them."""
    rows = (row for row in table.rows if not isinstance(row, RowHeading | RowNote))
    return [row.content if isinstance(row, Row) else row for row in rows]


def number_line(numbers: KeyNumbers) -> str:
    """Return key numbers on one line."""
    return "; ".join(f"{name} {cell_text(cell)}" for name, cell in numbers.entries)


def lead_text(document: Document) -> str:
    """Return the answer of a document as text, from its verdict."""
    return next(rich_text(node.lead) for node in document.summary if isinstance(node, Verdict))
