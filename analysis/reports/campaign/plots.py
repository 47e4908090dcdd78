"""Distributions of metrics in one figure."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ...campaigns.fly.results import BatchResult
from ...campaigns.spec.campaign import Metric
from ..common.style import WIDTH, Look, house_style, look, new_figure
from .distributions import draw_distribution, metric_values

COLUMNS = 3
HEIGHT = 2.3  # in, of a panel


def metric_plot(result: BatchResult, metrics: list[Metric]) -> Figure:
    """Empirical distributions over the trials that figures show, a panel per metric, a line per variant."""
    looks = {name: look(index) for index, name in enumerate(result.rows)}
    return distribution_plot({metric: metric_values(result, metric.name) for metric in metrics}, looks)


def distribution_plot(metrics: Mapping[Metric, Mapping[str, np.ndarray]], looks: Mapping[str, Look]) -> Figure:
    """A panel per metric with its values by label; those that are nowhere finite have no line."""
    columns = min(COLUMNS, len(metrics))
    rows = -(-len(metrics) // columns)
    with house_style():
        figure = new_figure(0.5 + HEIGHT * rows, WIDTH * columns / COLUMNS)
        panels = figure.subplots(rows, columns, squeeze=False, sharey=True).flatten()
        for axes, (metric, by_label) in zip(panels, metrics.items(), strict=False):
            some = {label: values for label, values in by_label.items() if np.any(np.isfinite(values))}
            draw_distribution(axes, metric, some, [looks[label] for label in some])
        for axes in panels[len(metrics) :]:
            axes.remove()
        lines = [Line2D([], [], color=style.colour, linestyle=style.dashes, linewidth=1.6) for style in looks.values()]
        figure.legend(lines, list(looks), loc="outside upper left", ncols=columns, handlelength=3.2)
        figure.supylabel("share of trials, %", fontsize=9.0)
    return figure
