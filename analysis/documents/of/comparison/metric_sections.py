"""Sections on metrics: distributions, rates, statistics, groups, pairs of variants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

from ....campaigns.compare.campaign_comparison import CampaignComparison, name_of
from ....campaigns.definition.campaign import Metric
from ....campaigns.summary import SummaryRow
from ...cell import Cell, Code, Head, Percentage, Phrase, Quantity, Row, RowHeading, Strong, Track
from ...common.colours import Look
from ...common.quantities import MINUS
from ...model import Fold, Group, Missing, Node, Note, Section, Table, Text
from ...pictures import Figures
from ..campaign.distributions import distribution_note
from ..campaign.metrics import metric_table
from ..campaign.variants import group_rows, interval_cell, variant_cells, variant_heads, variant_rows
from ..campaign.verdict_table import axis_start
from .content import ComparisonContent
from .flights.sections import missing_nodes
from .pairs import metric_pair_table, metric_pairs, rate_pair_table
from .variant_distributions import metric_figures, overlaid_figures


def distribution_section(content: ComparisonContent) -> Section:
    """Return the section of distributions of the metrics of success and requirements."""
    nodes = missing_nodes(content, "propellant")
    if content.judged_metrics:
        nodes += [_distributions(content, content.judged_metrics), distribution_note(of_successes=True)]
    return Section("Distributions", nodes)


def other_distribution_section(content: ComparisonContent) -> list[Section]:
    """Return the section on other metrics: distributions, constant metrics, and metrics without a finite value."""
    varying, constant, empty = content.sorted_metrics
    others = [metric for metric in varying if metric not in content.judged_metrics]
    nodes: list[Node] = [
        *([_distributions(content, others)] if others else []),
        *(
            Note([f"{metric.name} is ", Quantity(value, metric.unit), " in every successful trial of every variant."])
            for metric, value in constant
        ),
        *(Missing(["", f"{metric.name} has no finite value in any successful trial"]) for metric in empty),
    ]
    return [Section("Other distributions", nodes, is_folded=True)] if nodes else []


def _distributions(content: ComparisonContent, metrics: Sequence[Metric]) -> Figures:
    draw = partial(metric_figures, content.distributions, metrics, content.styles)
    return overlaid_figures(draw, content.styles)


def rate_section(content: ComparisonContent) -> Section:
    """Return the section of the rates of success and of Boolean metrics."""
    rows = variant_rows(content.comparison.summary)
    note = (
        "Clopper-Pearson exact 95 % confidence intervals. A metric that is true or false in every trial is a rate; a "
        "trial in which it is not finite counts as false."
    )
    nodes: list[Node] = [rate_table(content.comparison, rows, content.styles), Note(note)]
    return Section("Success probabilities", nodes, is_folded=True)


def metric_section(content: ComparisonContent) -> Section:
    """Return the section of the statistics of metrics."""
    nodes: list[Node] = [Missing("the campaign declares only metrics that are rates")]
    if content.comparison.metrics:
        note = (
            "Percentiles are order statistics, infinite values included. The other columns and the number of "
            "trials refer to finite values."
        )
        nodes = [*_metric_tables(content, variant_rows(content.comparison.summary)), Note(note)]
    return Section("Metrics of the successful trials", nodes, is_folded=True)


def _metric_tables(content: ComparisonContent, rows: Sequence[SummaryRow], by: str | None = None) -> list[Node]:
    metrics, styles = content.comparison.metrics, content.styles
    return [
        metric_table(rows, metrics, "metrics", styles, by),
        Fold("The same over all trials", [metric_table(rows, metrics, "metrics_all", styles, by)]),
    ]


def group_section(content: ComparisonContent) -> list[Section]:
    """Return the section of rates and metrics by group of trials; no section without groups."""
    compared = content.comparison
    if compared.group is None:
        return []
    rows = group_rows(compared.summary)
    nodes: list[Node] = [
        Text(["the same trials by the value of ", Code(compared.group), ", which is in the campaign's own unit"]),
        rate_table(compared, rows, content.styles, compared.group),
    ]
    if compared.metrics:
        nodes.append(Group("Metrics of the successful trials", _metric_tables(content, rows, compared.group)))
    return [Section(f"By {compared.group}", nodes, is_folded=True)]


def pair_section(content: ComparisonContent) -> Section:
    """Return the section of differences of rates and metrics between pairs of variants, trial by trial."""
    heading = "Paired comparison"
    if not content.comparison.pairs:
        return Section(heading, [Missing("there is only one variant: no pairs")], is_folded=True)
    nodes: list[Node] = [_reference_text(content), Group("Rates", _rate_nodes(content))]
    if content.metric_groups:
        nodes.append(Group("Metrics, trials in which both succeed", _metric_nodes(content)))
    return Section(heading, nodes, is_folded=True)


def _reference_text(content: ComparisonContent) -> Text:
    reference = content.comparison.reference
    has_folders = len(content.comparison.batches) > 1
    others = " within a folder, and the first folder between folders; " if has_folders else "; "
    return Text([
        "each trial has the same samples and random streams in A and B; differences are taken trial by trial. An "
        f"interval in bold does not contain 0. B is {reference}{others}",
        Code("--reference"),
        " names another variant" if has_folders else " names another",
    ])  # fmt: skip


def _rate_nodes(content: ComparisonContent) -> list[Node]:
    groups, styles = content.rate_groups, content.styles
    others = [Fold("The other pairs", [rate_pair_table(groups, "others", styles)])] if groups[0].others else []
    note = (
        "p: McNemar's exact test, on the trials in which only one of the two is true. Interval of the difference: "
        "Bonett and Price's. Neither is corrected for the number of comparisons on this page."
    )
    return [rate_pair_table(groups, "first", styles), *others, Note(note)]


def _metric_nodes(content: ComparisonContent) -> list[Node]:
    groups, styles = content.metric_groups, content.styles
    over_all = metric_pairs(content.comparison, content.paired, successful=False)
    has_others = bool(groups[0].others)
    note = (
        f"Median: of the differences A {MINUS} B; of an even number of differences the lower of the two middle "
        "values, since all quantiles here are values of trials. Its interval lies between order statistics "
        "of the differences and "
        "assumes nothing about their distribution; it needs six trials. p: the sign test, ties left out."
    )
    return [
        metric_pair_table(groups, "first", styles),
        *([Fold("The other pairs", [metric_pair_table(groups, "others", styles)])] if has_others else []),
        Fold(
            "The same over all trials in which both have a finite value",
            [
                metric_pair_table(over_all, "first", styles),
                *([metric_pair_table(over_all, "others", styles)] if has_others else []),
            ],
        ),
        Note(note),
    ]


def rate_table(
    comparison: CampaignComparison, rows: Sequence[SummaryRow], styles: Mapping[str, Look], by: str | None = None
) -> Table:
    """Return a block of rows for each rate; rows may be groups ``by`` an input."""
    body: list[Sequence[Cell] | Row | RowHeading] = []
    for rate in comparison.rates:
        name = name_of(rate)
        start = axis_start(row.entry.rates[name].interval for row in rows)
        body.append(RowHeading([Strong(name)], "" if rate is None else rate.description))
        for row in rows:
            estimate = row.entry.rates[name]
            body.append((
                *variant_cells(row, by, styles),
                Percentage(estimate.rate),
                interval_cell(estimate.interval),
                Track(estimate.rate, *estimate.interval, start, has_ends=row is rows[-1]),
                Phrase([Quantity(estimate.count), " of ", Quantity(estimate.trials)]),
            ))  # fmt: skip
    heads = (*variant_heads(by), "rate, %", "95 % interval", "", Head("trials", column="numbers"))
    return Table(heads, body, style="tight", is_grouped=by is not None)
