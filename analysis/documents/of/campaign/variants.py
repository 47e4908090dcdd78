"""Rows of variants: names with line styles, trials, and success rates by group."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ....campaigns.summary import Interval, Summary, SummaryRow, summary_rows
from ... import cell
from ...cell import Cell, Head, LegendEntry, Percentage, Quantity
from ...common.colours import Look
from ...model import Table


def variant_rows(summary: Summary) -> list[SummaryRow]:
    """Return a row per variant, over all its trials."""
    return [row for row in summary_rows(summary) if row.group is None]


def group_rows(summary: Summary) -> list[SummaryRow]:
    """Return a row per variant and group of trials, ordered by variant."""
    return [row for row in summary_rows(summary) if row.group is not None]


def variant_heads(by: str | None) -> list[str | Head]:
    """Return the headings of `variant_cells`, with a column for the input that trials are grouped ``by``, if any."""
    return ["variant"] if by is None else ["variant", Head(by, column="numbers")]


def variant_cells(row: SummaryRow, by: str | None, styles: Mapping[str, Look]) -> list[Cell]:
    """Return the variant of a row and, if trials are grouped, its group."""
    name = variant_cell(row.variant, styles)
    return [name] if by is None else [name, row.group]


def variant_cell(variant: str, styles: Mapping[str, Look]) -> Cell:
    """Return a variant's name, with the look of its lines if available."""
    return LegendEntry(styles[variant], [variant]) if variant in styles else variant


def interval_cell(ends: Interval) -> cell.Interval:
    """Return the confidence interval of a rate, in per cent."""
    low, high = ends
    return cell.Interval(Percentage(low), Percentage(high))


def interval_head(confidence: float) -> str:
    """Return the heading of a column of confidence intervals."""
    return f"{100 * confidence:g} % interval"


def success_table(rows: Sequence[SummaryRow], by: str | None = None) -> Table:
    """Return trials and success rate of each row; rows may be groups ``by`` an input."""
    heads = (*variant_heads(by), "trials", "success, %", interval_head(rows[0].entry.confidence))
    body = [
        (
            *variant_cells(row, by, {}),
            Quantity(row.entry.trials),
            Percentage(row.entry.success_rate),
            interval_cell(row.entry.success_interval),
        )
        for row in rows
    ]
    return Table(heads, body, style="", is_grouped=by is not None)
