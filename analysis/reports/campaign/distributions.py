"""Success probabilities of the variants of a batch, and empirical distributions of their metrics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from ....common.percent import percent
from ...campaigns.fly.results import BatchResult
from ...campaigns.spec.campaign import Metric
from ...campaigns.verdicts.order_statistics import quantiles
from ..common.panels import Panel, Widths, both_widths, is_slim, panel, swatch
from ..common.quantities import display_factor, label_with_unit
from ..common.style import (
    INK,
    WIDTH,
    LineStyle,
    Look,
    house_style,
    label_lanes,
    log_ticks_x,
    look,
    new_figure,
    plain_ticks,
)
from ..interactive.lines import QuantityLine

CUMULATIVE = "cumulative probability (CDF), %"
DECADES = 2.0  # range of a metric from which its axis is logarithmic
TAIL = 0.01  # on a logarithmic axis, the fraction of values drawn at its left edge


def metric_values(result: BatchResult, metric: str) -> dict[str, np.ndarray]:
    """A metric by variant, one value for each plotted trial, nan and inf included."""
    return {name: sample.first.metrics[metric] for name, sample in result.plotted.items()}


def sort_metrics(result: BatchResult) -> tuple[list[Metric], list[tuple[Metric, float]], list[Metric]]:
    """Metrics that vary; constant ones with their value; those without a finite value."""
    varying, constant, empty = [], [], []
    for metric in result.plan.campaign.metrics:
        statistics = [entry.metrics_all[metric.name] for entry in result.summary.values()]
        trials = sum(entry.trials for entry in result.summary.values())
        ends = {end for entry in statistics for end in (entry.min, entry.max) if end is not None}
        if not ends:
            empty.append(metric)
        elif len(ends) == 1 and sum(entry.count for entry in statistics) == trials > 1:
            constant.append((metric, ends.pop()))
        else:
            varying.append(metric)
    return varying, constant, empty


def distribution_panels(result: BatchResult, metrics: Sequence[Metric]) -> list[Panel]:
    """Empirical cumulative distributions over all trials."""
    analyses = [look(index) for index in range(len(result.rows))]

    def draw(axes: Axes, metric: Metric) -> None:
        draw_distribution(axes, metric, metric_values(result, metric.name), analyses)
        axes.set_title(CUMULATIVE, loc="left", fontsize=8.5)

    return [
        panel(
            metric.name,
            f"distribution-{index}",
            f"Cumulative distribution of {metric.name}",
            partial(draw, metric=metric),
        )
        for index, metric in enumerate(metrics)
    ]


def legend_of(result: BatchResult) -> list[tuple[Markup, str]]:
    """Variants with their line styles."""
    return [(swatch(look(index)), variant) for index, variant in enumerate(result.rows)]


def draw_distribution(axes: Axes, metric: Metric, values: dict[str, np.ndarray], looks: Sequence[Look]) -> None:
    """One panel: the empirical distribution of a metric in several series with their line styles."""
    scaled = [series * display_factor(metric.unit) for series in values.values()]
    everything = np.concatenate(scaled)
    everything = everything[np.isfinite(everything)]
    low, high, logarithmic = _limits(everything)
    for variant, series, (colour, dashes, marker) in zip(values, scaled, looks, strict=True):
        finite = np.clip(np.sort(series[np.isfinite(series)]), low, None)
        probability = 100.0 * np.arange(1, finite.size + 1) / series.size
        x = np.concatenate([[low], finite, [high]])
        y = np.concatenate([[0.0], probability, probability[-1:] if probability.size else [0.0]])
        line = QuantityLine(
            x, y, name=variant, unit="%", metric=f"metric.{metric.name}",
            drawstyle="steps-post", color=colour, linestyle=dashes, linewidth=1.6,
        )  # fmt: skip
        axes.add_line(line)
        if finite.size == 1:
            axes.plot(finite, probability, color=colour, marker=marker, markersize=5)
    axes.autoscale_view()
    if logarithmic:
        log_ticks_x(axes)
    else:
        plain_ticks(axes, x=5)
        if np.all(everything == np.round(everything)) and np.ptp(everything) < 8.0:
            axes.set_xticks(np.arange(everything.min(), everything.max() + 1.0))
    axes.set_xlim(low, high)
    axes.set_ylim(-3.0, 103.0)
    axes.set_yticks([0, 25, 50, 75, 100])
    axes.set_xlabel(label_with_unit(metric.name, metric.unit))


def _limits(values: np.ndarray) -> tuple[float, float, bool]:
    """Low and high end of an axis, and whether it is logarithmic."""
    minimum, maximum = float(values.min()), float(values.max())
    positive = values[values > 0.0]
    if minimum >= 0.0 and positive.size:
        start = float(quantiles(positive, [TAIL])[0])
        if np.log10(maximum / start) > DECADES:
            return start / 1.5, maximum * 1.5, True
    margin = 0.05 * (maximum - minimum) or 0.05 * abs(maximum) or 1.0
    return minimum - margin, maximum + margin, False


COLUMNS = 3
HEIGHT = 2.3  # in, of a panel


def metric_plot(result: BatchResult, metrics: list[Metric]) -> Figure:
    """Empirical distributions over the plotted trials, a panel per metric, a line per variant."""
    analyses = {name: look(index) for index, name in enumerate(result.rows)}
    return distribution_plot({metric: metric_values(result, metric.name) for metric in metrics}, analyses)


def distribution_plot(metrics: Mapping[Metric, Mapping[str, np.ndarray]], looks: Mapping[str, Look]) -> Figure:
    """A panel per metric with its values by label; series without a finite value have no line."""
    columns = min(COLUMNS, len(metrics))
    rows = -(-len(metrics) // columns)
    with house_style():
        figure = new_figure(0.5 + HEIGHT * rows, WIDTH * columns / COLUMNS)
        panels = figure.subplots(rows, columns, squeeze=False, sharey=True).flatten()
        for axes, (metric, by_label) in zip(panels, metrics.items(), strict=False):
            finite = {label: values for label, values in by_label.items() if np.any(np.isfinite(values))}
            draw_distribution(axes, metric, finite, [looks[label] for label in finite])
        for axes in panels[len(metrics) :]:
            axes.remove()
        lines = [Line2D([], [], color=style.colour, linestyle=style.dashes, linewidth=1.6) for style in looks.values()]
        figure.legend(lines, list(looks), loc="outside upper left", ncols=columns, handlelength=3.2)
        figure.supylabel(CUMULATIVE, fontsize=9.0)
    return figure


LANE, SLIM_LANE = 0.36, 0.52  # in
RING: LineStyle = {
    "linestyle": "", "marker": "o", "markersize": 11, "markerfacecolor": "none", "markeredgecolor": INK,
    "markeredgewidth": 1.2, "clip_on": False, "zorder": 4,
}  # fmt: skip


def rates_figure(result: BatchResult, published: Mapping[str, float] | None = None) -> Widths:
    """A mark per variant at its success probability, a bar over the interval, both labelled.

    ``published`` are rates to compare with, as fractions of 1, plotted as rings.
    """
    names = list(result.summary)
    others = [100.0 * rate for rate in (published or {}).values()]
    intervals = [[100.0 * end for end in result.summary[name].success_interval] for name in names]
    lowest = min([low for low, _ in intervals] + others)

    def draw(figure: Figure) -> None:
        slim = is_slim(figure)
        axes = figure.subplots()
        for index, (name, (low, high)) in enumerate(zip(names, intervals, strict=True)):
            _draw_rate(axes, index, name, (100.0 * result.summary[name].success_rate, low, high), slim)
            if published is not None and name in published:
                axes.plot(100.0 * published[name], index, **RING)
        label_lanes(axes, [""] * len(names) if slim else names, -0.8 if slim else -0.6)
        axes.set_xlim(max(-2.0, lowest - 0.06 * (100.0 - lowest) - 1.0), 100.0)
        plain_ticks(axes, x=5 if slim else 8)
        axes.set_xlabel(
            f"success probability, %, with {100.0 * result.summary[names[0]].confidence:g} % confidence interval"
        )
        if others:
            figure.legend([Line2D([], [], **RING)], ["published rate"], loc="outside upper right", borderpad=0.1)

    remainder = 0.75 + (0.25 if others else 0.0)
    description = "Success probabilities of " + ", ".join(names)
    return both_widths("rates", description, draw, remainder + LANE * len(names), remainder + SLIM_LANE * len(names))


def _draw_rate(axes: Axes, index: int, name: str, rate_and_ends: tuple[float, float, float], slim: bool) -> None:
    """A rate with its interval (%) and its text next to the bar; on a narrow figure, name and rate above it."""
    rate, low, high = rate_and_ends
    colour, _, marker = look(index)
    axes.plot([low, high], [index, index], color=colour, linewidth=2.2, solid_capstyle="butt")
    for end in (low, high):
        axes.plot([end, end], [index - 0.16, index + 0.16], color=colour, linewidth=1.3, clip_on=False)
    axes.plot(rate, index, color=colour, marker=marker, markersize=7, clip_on=False, zorder=3)
    label = "{} % ({} to {})".format(*(percent(value / 100.0) for value in rate_and_ends))
    where = ("axes fraction", "data")
    if not slim:
        axes.annotate(label, (1.02, index), xycoords=where, va="center")
        return
    for text, x, side in ((name, 0.01, "left"), (label, 1.0, "right")):
        axes.annotate(text, (x, index - 0.32), xycoords=where, ha=side, va="bottom", fontsize=8.5)
