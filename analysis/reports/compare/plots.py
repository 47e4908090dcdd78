"""Metrics of a comparison in one figure."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ...campaign.campaign import Metric
from ...compare.comparison import Comparison
from ..batch.distributions import draw_distribution
from ..kit.style import WIDTH, house_style, new_figure
from .metrics import distributed, sort_metrics
from .page import looks_of

COLUMNS = 3
HEIGHT = 2.3  # in, of a panel


def varying_metrics(comparison: Comparison) -> list[Metric]:
    """Metrics that are finite somewhere and not the same everywhere."""
    return sort_metrics(distributed(comparison))[0]


def metric_plot(comparison: Comparison, metrics: Sequence[Metric]) -> Figure:
    """Empirical distributions over the successful trials, a panel per metric, a line per contender."""
    shown, looks = distributed(comparison), looks_of(comparison)
    columns = min(COLUMNS, len(metrics))
    with house_style():
        figure = new_figure(0.5 + HEIGHT * -(-len(metrics) // columns), WIDTH * columns / COLUMNS)
        panels = figure.subplots(-(-len(metrics) // columns), columns, squeeze=False, sharey=True).flatten()
        for axes, metric in zip(panels, metrics, strict=False):
            some = {label: values for label, values in shown[metric].items() if np.any(np.isfinite(values))}
            draw_distribution(axes, metric, some, [looks[label] for label in some])
        for axes in panels[len(metrics) :]:
            axes.remove()
        lines = [Line2D([], [], color=look.colour, linestyle=look.dashes, linewidth=1.6) for look in looks.values()]
        figure.legend(lines, list(looks), loc="outside upper left", ncols=columns, handlelength=3.2)
        figure.supylabel("share of trials, %", fontsize=9.0)
    return figure
