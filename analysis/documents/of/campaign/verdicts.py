"""First table in documents of campaigns: a row per variant, judged by success and requirements."""

from __future__ import annotations

from collections.abc import Mapping

from ...cell import Cell, Head, Link, Percentage, Quantity, Rich, Strong, Track, VerdictCell
from ...common.colours import Look
from ...common.quantities import label_with_unit
from ...model import Node, Note, Table, Text
from .variants import interval_cell, interval_head, variant_cell
from .verdict_table import JudgedMetric, VerdictRow, VerdictTable

Anchors = Mapping[tuple[str, int], str]  # anchors by variant and trial


def verdict_nodes(table: VerdictTable, styles: Mapping[str, Look], anchors: Anchors) -> list[Node]:
    """Return the table of verdicts and an explanation; worst trials link to their commands at ``anchors``."""
    confidence = table.rows[0].entry.confidence
    heads: list[str | Head] = [
        "variant",
        *(["requirements"] if table.has_verdicts else []),
        "success, %",
        interval_head(confidence),
        "",
        "trials",
        *map(_metric_head, table.metrics),
    ]
    rows = [_row(table, row, styles, anchors) for row in table.rows]
    note = [
        f"Clopper-Pearson exact {100 * confidence:g} % confidence intervals of the probability of success.",
        "Metrics over all trials, failures included; worst: farthest beyond the limit, or nearest to it."
        if table.metrics
        else "",
        "Bold: best." if len(table.rows) > 1 else "",
    ]
    return [Table(heads, rows, style="tight verdicts"), Note(" ".join(filter(None, note)))]


def unjudged_node() -> Text:
    """Return the statement that a campaign without requirements has no verdict, and how to declare requirements."""
    return Text([
        VerdictCell("Not judged", "not-applicable"),
        ": no requirements declared; see Requirements in docs/campaigns.md",
    ])  # fmt: skip


def _metric_head(judged: JudgedMetric) -> Head:
    text = label_with_unit(judged.metric.name, judged.metric.unit)
    if judged.limits is None:
        return Head(text, below=["50 %"])
    return Head(text, _limits(judged), ["50 %", "worst", "trial"])


def _limits(judged: JudgedMetric) -> Rich:
    assert judged.limits is not None
    low, high = (
        Quantity(each, judged.metric.unit, is_bare=True) if abs(each) < float("inf") else None
        for each in (judged.limits.low, judged.limits.high)
    )
    if low is not None and high is not None:
        return [low, " to ", high]
    return ["at least ", low] if low is not None else ["at most ", Quantity(None) if high is None else high]


def _row(table: VerdictTable, row: VerdictRow, styles: Mapping[str, Look], anchors: Anchors) -> list[Cell]:
    rate, (low, high) = row.entry.success_rate, row.entry.success_interval
    content: list[Cell] = [
        variant_cell(row.variant, styles),
        *([VerdictCell(row.verdict, row.grade)] if table.has_verdicts else []),
        _strong(row.is_best, Percentage(rate)),
        interval_cell((low, high)),
        Track(rate, low, high, table.start, has_ends=row is table.rows[-1]),
        row.entry.trials,
    ]
    for judged, numbers in zip(table.metrics, row.numbers, strict=True):
        unit = judged.metric.unit
        content.append(_strong(numbers.is_best, Quantity(numbers.median, unit, is_bare=True)))
        if numbers.trial is not None:
            anchor = anchors.get((row.variant, numbers.trial))
            trial: Cell = numbers.trial if anchor is None else Link(str(numbers.trial), anchor)
            content += [Quantity(numbers.worst, unit, is_bare=True), trial]
    return content


def _strong(is_best: bool, cell: Cell) -> Cell:
    return Strong(cell) if is_best else cell
