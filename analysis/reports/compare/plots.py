"""Metrics of a comparison in one figure."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from ...campaigns.compare.comparison import Comparison
from ...campaigns.spec.campaign import Metric
from ..campaign.plots import distribution_plot
from .metrics import distributed, sort_metrics
from .page import looks_of


def varying_metrics(comparison: Comparison) -> list[Metric]:
    """Metrics that are finite somewhere and not the same everywhere."""
    return sort_metrics(distributed(comparison))[0]


def metric_plot(comparison: Comparison, metrics: Sequence[Metric]) -> Figure:
    """Empirical distributions over the successful trials, a panel per metric, a line per contender."""
    shown = distributed(comparison)
    return distribution_plot({metric: shown[metric] for metric in metrics}, looks_of(comparison))
