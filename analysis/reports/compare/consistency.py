"""Whether a filter's own standard deviations tell its errors: metrics that are errors over them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.stats import norm

from ...campaigns.compare.comparison import Comparison
from ...campaigns.spec.campaign import Metric
from ...campaigns.summary import success_interval
from .recorded import RATIO

SUFFIXES = ("_over_sigma", RATIO)
LIMITS = (1, 2, 3)
NORMAL = {limit: float(norm.cdf(limit) - norm.cdf(-limit)) for limit in LIMITS}


@dataclass(frozen=True)
class Share:
    """Trials within so many standard deviations: their share and its 95 % interval."""

    rate: float
    interval: tuple[float, float]


@dataclass(frozen=True)
class SigmaRow:
    """One error over its sigma in the trials of one contender: mean, deviation, shares within 1, 2 and 3.

    ``count`` is of trials with a finite value other than 0; without such nothing can be told, as where
    there is no covariance.
    """

    metric: str
    label: str
    count: int
    mean: float | None
    std: float | None
    within: list[Share]


def is_over_sigma(metric: Metric) -> bool:
    """Whether a metric is an error over the filter's standard deviation, by its name."""
    return metric.unit == "1" and metric.name.endswith(SUFFIXES)


def sigma_rows(comparison: Comparison) -> list[SigmaRow]:
    """A row per such metric and contender."""
    return [
        _row(metric.name, label, comparison.values(label, metric.name))
        for metric in comparison.metrics
        if is_over_sigma(metric)
        for label in comparison.contenders
    ]


def _row(metric: str, label: str, values: np.ndarray) -> SigmaRow:
    reported = values[np.isfinite(values) & (values != 0.0)]
    if not reported.size:
        return SigmaRow(metric, label, 0, None, None, [])
    within = []
    for limit in LIMITS:
        inside = int(np.sum(np.abs(reported) <= limit))
        within.append(Share(inside / reported.size, success_interval(inside, reported.size)))
    deviation = float(reported.std(ddof=1)) if reported.size > 1 else None
    return SigmaRow(metric, label, int(reported.size), float(reported.mean()), deviation, within)
