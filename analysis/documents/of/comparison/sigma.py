"""Errors over the filter's standard deviation: means, deviations, and shares within 1, 2 and 3 sigma."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import norm

from ....campaigns.compare.campaign_comparison import CampaignComparison
from ....campaigns.definition.campaign import Metric
from ....campaigns.summary import Interval as Ends
from ....campaigns.summary import success_interval
from ...cell import Cell, Faint, Head, Interval, Lines, Percentage, Quantity, Row, RowHeading, Strong
from ...common.colours import Look
from ...model import Table
from ..campaign.recorded_names import RATIO
from ..campaign.variants import variant_cell

SUFFIXES = ("_over_sigma", RATIO)
LIMITS = (1, 2, 3)
DECIMALS = 1  # decimals of shares (%)
NORMAL = {limit: float(norm.cdf(limit) - norm.cdf(-limit)) for limit in LIMITS}


@dataclass(frozen=True)
class SigmaFraction:
    """Fraction of trials within a number of standard deviations, with its 95 % interval."""

    rate: float
    interval: Ends


@dataclass(frozen=True)
class SigmaRow:
    """An error over its sigma in one variant: mean, standard deviation, shares within 1, 2 and 3 sigma.

    ``count`` is the number of trials with a finite nonzero value; 0 means that there is no covariance.
    """

    metric: str
    label: str
    count: int
    mean: float | None
    std: float | None
    within: list[SigmaFraction]


def is_over_sigma(metric: Metric) -> bool:
    """Return True if the name of a metric marks it as an error over the filter's standard deviation."""
    return metric.unit == "1" and metric.name.endswith(SUFFIXES)


def sigma_rows(comparison: CampaignComparison) -> list[SigmaRow]:
    """Return a row for each error over sigma and variant."""
    rows = []
    for metric, label in itertools.product(filter(is_over_sigma, comparison.metrics), comparison.contenders):
        values = comparison.values(label, metric.name)
        reported = values[np.isfinite(values) & (values != 0.0)]
        count = int(reported.size)
        inside = [int(np.sum(np.abs(reported) <= limit)) for limit in LIMITS] if count else []
        within = [SigmaFraction(number / count, success_interval(number, count)) for number in inside]
        mean = float(reported.mean()) if count else None
        deviation = float(reported.std(ddof=1)) if count > 1 else None
        rows.append(SigmaRow(metric.name, label, count, mean, deviation, within))
    return rows


def sigma_table(rows: Sequence[SigmaRow], styles: Mapping[str, Look]) -> Table:
    """Return a block of rows for each metric; a share is highlighted if its interval excludes the normal share."""
    body: list[Sequence[Cell] | Row | RowHeading] = []
    for metric, group in itertools.groupby(sorted(rows, key=_metric_of), _metric_of):
        body.append(RowHeading([Strong(metric)]))
        for row in group:
            fractions = map(_within_cell, row.within, LIMITS) if row.within else [None] * len(LIMITS)
            numbers = (Quantity(each, digits=3) for each in (row.mean, row.std))
            body.append((variant_cell(row.label, styles), *numbers, *fractions, row.count))
    within = [
        Head(f"within {limit}\N{GREEK SMALL LETTER SIGMA}, %", f"normal: {100 * NORMAL[limit]:.1f}", column="numbers")
        for limit in LIMITS
    ]
    return Table(("variant", "mean", "std", *within, "trials"), body, style="tight")


def _metric_of(row: SigmaRow) -> str:
    return row.metric


def _within_cell(estimate: SigmaFraction, limit: int) -> Cell:
    low, high = estimate.interval
    interval = Interval(Percentage(low, DECIMALS), Percentage(high, DECIMALS))
    cell = Lines([Percentage(estimate.rate, DECIMALS), Faint(interval)], is_line_on_paper=True)
    return cell if low <= NORMAL[limit] <= high else Strong(cell)
