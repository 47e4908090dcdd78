"""Distributions as matplotlib draws them, read back out of its figure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from perilune.analysis.campaigns.definition.campaign import Metric
from perilune.analysis.documents.chart.plot_lines import QuantityLine
from perilune.analysis.documents.common.colours import Look
from perilune.analysis.documents.common.quantities import display_factor, label_with_unit
from perilune.analysis.documents.common.style import house_style, new_figure, plain_ticks
from perilune.analysis.documents.interactive.charts import Chart
from perilune.analysis.documents.of.campaign.distributions import _find_ends
from tests.support.figures.axes import log_ticks_x
from tests.support.figures.read_figure import read_charts


def read_distribution(metric: Metric, samples: Mapping[str, np.ndarray], styles: Sequence[Look]) -> Chart:
    """Return the chart of `distribution_chart`, of series that have several finite numbers."""
    with house_style():
        figure = new_figure(2.5, 3.4)
        axes = figure.subplots()
        scaled = [series * display_factor(metric.unit) for series in samples.values()]
        everything = np.concatenate(scaled)
        everything = everything[np.isfinite(everything)]
        low, high, is_logarithmic = _find_ends(everything)
        for variant, series, (colour, dashes, _) in zip(samples, scaled, styles, strict=True):
            finite = np.clip(np.sort(series[np.isfinite(series)]), low, None)
            probability = 100.0 * np.arange(1, finite.size + 1) / series.size
            x = np.concatenate([[low], finite, [high]])
            y = np.concatenate([[0.0], probability, probability[-1:]])
            line = QuantityLine(
                x, y, name=variant, unit="%", metric=f"metric.{metric.name}",
                drawstyle="steps-post", color=colour, linestyle=dashes, linewidth=1.6,
            )  # fmt: skip
            axes.add_line(line)
        axes.autoscale_view()
        if is_logarithmic:
            log_ticks_x(axes)
        else:
            plain_ticks(axes, x=5)
            if np.all(everything == np.round(everything)) and np.ptp(everything) < 8.0:
                axes.set_xticks(np.arange(everything.min(), everything.max() + 1.0))
        axes.set_xlim(low, high)
        axes.set_ylim(-3.0, 103.0)
        axes.set_yticks([0, 25, 50, 75, 100])
        axes.set_xlabel(label_with_unit(metric.name, metric.unit))
        (chart,) = read_charts(figure, reduced=False)
    return chart
