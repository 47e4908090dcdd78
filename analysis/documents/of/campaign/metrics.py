"""Tables of the statistics of metrics: a block of rows per metric, over successful or all trials."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

from ....campaigns.definition.campaign import Metric
from ....campaigns.statistics import QUANTILES, STATISTICS
from ....campaigns.summary import SummaryRow
from ....campaigns.tables import group_cells, group_headings
from ...cell import Cell, Code, Quantity, Row, RowHeading, Strong
from ...common.colours import Look
from ...common.quantities import display_unit
from ...model import Fold, Missing, Node, Note, Table, Text
from .variants import success_table, variant_cells, variant_heads

HEADINGS = {name: f"{QUANTILES[name]} %" if name in QUANTILES else name for name in STATISTICS}
NO_STYLES: Mapping[str, Look] = {}


def metric_table(
    rows: Sequence[SummaryRow],
    metrics: Sequence[Metric],
    scope: Literal["metrics", "metrics_all"],
    styles: Mapping[str, Look] = NO_STYLES,
    by: str | None = None,
) -> Table:
    """Return the table of metrics' statistics over successful trials (``metrics``) or all trials (``metrics_all``)."""
    body: list[Sequence[Cell] | Row | RowHeading] = []
    for metric in metrics:
        body.append(metric_heading(metric))
        for row in rows:
            values = getattr(row.entry, scope)[metric.name]
            numbers = [Quantity(values.value(name), metric.unit, is_bare=True) for name in HEADINGS]
            body.append((*variant_cells(row, by, styles), *numbers, values.count))
    heads = (*variant_heads(by), *HEADINGS.values(), "trials")
    return Table(heads, body, style="tight", is_grouped=by is not None)


def metric_summary(rows: Sequence[SummaryRow], metrics: Sequence[Metric], group: str | None) -> Table:
    """Return statistics over successful trials with units, a row for each metric and row of the summary."""
    body: list[Sequence[Cell]] = [
        (
            metric.name,
            *group_cells(row, group),
            *(Quantity(values.value(name), values.unit, is_bare=True) for name in STATISTICS),
            display_unit(values.unit),
        )
        for metric in metrics
        for row in rows
        for values in [row.entry.metrics[metric.name]]
    ]
    return Table(("metric, successful trials", *group_headings(group), *STATISTICS, "unit"), body)


def metric_heading(metric: Metric) -> RowHeading:
    """Return the heading of a metric's rows: name, unit and description."""
    unit = display_unit(metric.unit)
    return RowHeading([Strong(metric.name), f", {unit}" if unit else ""], metric.description)


def metric_nodes(
    rows: Sequence[SummaryRow],
    metrics: Sequence[Metric],
    styles: Mapping[str, Look] = NO_STYLES,
    by: str | None = None,
) -> list[Node]:
    """Return statistics of metrics over successful trials, folded statistics over all trials, and definitions."""
    if not metrics:
        return [Missing("the campaign declares no metrics")]
    return [
        metric_table(rows, metrics, "metrics", styles, by),
        Fold("Metrics of all trials", [metric_table(rows, metrics, "metrics_all", styles, by)]),
        Note(
            "Percentiles are order statistics of all values including infinite ones, not interpolated. Other columns "
            "and the number of trials refer to finite values."
        ),
    ]


def group_nodes(
    rows: Sequence[SummaryRow], metrics: Sequence[Metric], by: str, rates: Table | None = None
) -> list[Node]:
    """Return rates and metrics of trials grouped ``by`` an input; ``rates`` are by default success rates."""
    return [
        Text(["trials grouped by ", Code(by), ", in the campaign's unit"]),
        success_table(rows, by) if rates is None else rates,
        *([Fold("Metrics of successful trials", metric_nodes(rows, metrics, by=by))] if metrics else []),
    ]
