"""Success rates of the variants of a batch, and empirical distributions of their metrics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import ndtr

from .....common.percent import percent
from ....campaigns.definition.campaign import Metric
from ....campaigns.execute.campaign_result import CampaignResult
from ....campaigns.verdicts.order_statistics import quantiles
from ...chart.axes import lane_axis, linear_axis, logarithmic_axis, ticked_axis
from ...chart.lines import line
from ...chart.panel import wide_figure
from ...chart.symbols import mark, marker, marks
from ...common.colours import INK, Look, look
from ...common.panels import PANEL_HEIGHT
from ...common.quantities import display_factor, label_with_unit
from ...font.text import text_width
from ...interactive.charts import NO_BOX, Chart, ChartNote, Drawing
from ...interactive.measures import FAILED_DASHES, TICK_SIZE, WIDTH
from ...model import Note
from ...pictures import Figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Plot

CUMULATIVE = "cumulative probability (CDF), %"
DECADES = 2.0  # range of a metric, in decades, from which its axis is logarithmic
FEW_INTEGERS = 8.0  # range of integers from which ticks need not be integers
NORMAL_REACH = 3.5  # least deviations shown on either side of 0, with a normal distribution
TAIL = 0.01  # fraction of values at the left edge of a logarithmic axis


def metric_values(batch: CampaignResult, metric: str) -> dict[str, np.ndarray]:
    """Return the values of a metric by variant, one per plotted trial, including NaN and infinity."""
    return {name: sample.first.metrics[metric] for name, sample in batch.plotted.items()}


def sort_metrics(batch: CampaignResult) -> tuple[list[Metric], list[tuple[Metric, float]], list[Metric]]:
    """Return the metrics that vary, constant metrics with their values, and metrics without a finite value."""
    varying, constant, empty = [], [], []
    for metric in batch.plan.campaign.metrics:
        statistics = [entry.metrics_all[metric.name] for entry in batch.summary.values()]
        trials = sum(entry.trials for entry in batch.summary.values())
        ends = {end for entry in statistics for end in (entry.min, entry.max) if end is not None}
        if not ends:
            empty.append(metric)
        elif len(ends) == 1 and sum(entry.count for entry in statistics) == trials > 1:
            constant.append((metric, ends.pop()))
        else:
            varying.append(metric)
    return varying, constant, empty


def distribution_chart(
    metric: Metric, samples: Mapping[str, np.ndarray], styles: Sequence[Look], half_range: float = 0.0
) -> Chart:
    """Return the chart of a metric's empirical distributions in several series, in SI; at least one number is finite.

    Unless ``half_range`` is 0, the abscissa extends at least this far (as displayed) to either side of 0.
    """
    scaled = [series * display_factor(metric.unit) for series in samples.values()]
    everything = np.concatenate(scaled)
    everything = everything[np.isfinite(everything)]
    low, high, is_logarithmic = _find_ends(everything)
    if half_range:
        low, high, is_logarithmic = min(low, -half_range), max(high, half_range), False
    lines, dots = [], []
    for name, series, style in zip(samples, scaled, styles, strict=True):
        finite = np.clip(np.sort(series[np.isfinite(series)]), low, None)
        probability = 100.0 * np.arange(1, finite.size + 1) / series.size
        x = np.concatenate([[low], finite, [high]])
        y = np.concatenate([[0.0], probability, probability[-1:] if probability.size else [0.0]])
        column = f"metric.{metric.name}"
        lines.append(
            line(
                x, y, style.colour, width=1.6, dashes=style.lengths, steps=True, name=name, unit="%", metric=column,
            )
        )  # fmt: skip
        if finite.size == 1:
            dots.append(marks(finite, probability, marker(style.marker, 5.0, style.colour)))
    label = label_with_unit(metric.name, metric.unit)
    is_integer = bool(np.all(everything == np.round(everything)) and np.ptp(everything) < FEW_INTEGERS)
    abscissa = (
        logarithmic_axis((low, high), 6, label=label)
        if is_logarithmic
        else linear_axis((low, high), int(FEW_INTEGERS) if is_integer else 5, label=label, integer=is_integer)
    )
    return Chart(NO_BOX, abscissa, ticked_axis((-3.0, 103.0), [0, 25, 50, 75, 100]), curves=[*lines, *dots])


def distribution_figure(
    metric: Metric, samples: Mapping[str, np.ndarray], styles: Sequence[Look], name: str, *, is_normal: bool = False
) -> Figure:
    """Return the empirical distributions of a metric as the figure ``name``, if ``is_normal`` with the normal one."""
    chart = distribution_chart(metric, samples, styles, NORMAL_REACH if is_normal else 0.0)
    if is_normal:
        x = np.linspace(*chart.x.ends, 121)
        normal = line(x, 100.0 * ndtr(x), INK, width=1.0, dashes=FAILED_DASHES, name="normal", unit="%")
        chart = replace(chart, curves=[*chart.curves, normal])
    words = f"Cumulative distribution of {metric.name}"
    return Figure(metric.name, name, words, replace(chart, title=CUMULATIVE), PANEL_HEIGHT, is_narrow=True)


def distribution_note(*, of_successes: bool) -> Note:
    """Return the note that explains the curves, which are over all trials or over successful ones."""
    ends, failed = ("succeed", "has failed trials, or some") if of_successes else ("end", "has trials")
    return Note(
        f"Empirical cumulative distribution: the fraction of all trials that {ends} with at most this value. A curve "
        f"that ends below 100 % {failed} without a finite value. On logarithmic axes, values below the 1st percentile "
        "are drawn at the left edge."
    )


def _find_ends(numbers: np.ndarray) -> tuple[float, float, bool]:
    """Return the ends of an axis, and True if it is logarithmic."""
    minimum, maximum = float(numbers.min()), float(numbers.max())
    positive = numbers[numbers > 0.0]
    if minimum >= 0.0 and positive.size:
        start = float(quantiles(positive, [TAIL])[0])
        if np.log10(maximum / start) > DECADES:
            return start / 1.5, maximum * 1.5, True
    margin = 0.05 * (maximum - minimum) or 0.05 * abs(maximum) or 1.0
    return minimum - margin, maximum + margin, False


COLUMNS = 3
HEIGHT = 2.3  # in, of a panel


def metric_plot(batch: CampaignResult, metrics: list[Metric]) -> Plot:
    """Return a figure of empirical distributions over the plotted trials: a panel per metric, a line per variant."""
    styles = {name: look(index) for index, name in enumerate(batch.rows)}
    return distribution_plot({metric: metric_values(batch, metric.name) for metric in metrics}, styles)


def distribution_plot(metrics: Mapping[Metric, Mapping[str, np.ndarray]], styles: Mapping[str, Look]) -> Plot:
    """Return a figure with a panel for each metric, from its numbers by label; all metrics have the same labels."""
    from ...chart.plot import plot_charts  # which imports matplotlib

    charts = [distribution_chart(metric, by_label, list(styles.values())) for metric, by_label in metrics.items()]
    columns = min(COLUMNS, len(charts))
    titles = [CUMULATIVE] * len(charts)
    return plot_charts(charts, HEIGHT, WIDTH / COLUMNS, columns=columns, titles=titles, key=list(styles))


AXES_HEIGHT, LANE = 0.75, 0.52  # in
NARROW = 242.0  # pt, width for two texts above a lane on a telephone
CAP = 9.0  # pt, the end of an interval
RING = marker("o", 11.0, INK, fill="", width=1.2)


def rates_figure(batch: CampaignResult, published: Mapping[str, float] | None = None) -> Drawing:
    """Return the figure of `rates_chart`: success rates of variants with their confidence intervals."""
    names = list(batch.summary)
    description = "Success probabilities of " + ", ".join(names)
    height = AXES_HEIGHT + LANE * len(names)
    return wide_figure("rates", description, rates_chart(batch, published or {}), height)


def rates_chart(batch: CampaignResult, published: Mapping[str, float]) -> Chart:
    """Return the chart of success rates (%): a lane for each variant with the rate, its interval, and both as text.

    ``published`` are rates (0 to 1) for comparison, shown as rings. With long names the text omits the interval.
    """
    names = list(batch.summary)
    rates = {name: (entry.success_rate, *entry.success_interval) for name, entry in batch.summary.items()}
    lowest = 100.0 * min([low for _, low, _ in rates.values()] + list(published.values()))
    texts = {
        name: f"{percent(rate)} % ({percent(low)} to {percent(high)})" for name, (rate, low, high) in rates.items()
    }
    if any(text_width(name + text, TICK_SIZE) > NARROW for name, text in texts.items()):
        texts = {name: f"{percent(rate)} %" for name, (rate, _, _) in rates.items()}
    curves, notes = [], []
    for lane, (name, (rate, low, high)) in enumerate(rates.items()):
        style = look(lane)
        ends, at = 100.0 * np.array([low, high]), np.full(2, float(lane))
        interval = line(ends, at, style.colour, width=2.2)
        curves.append(replace(interval, marker=marker("|", CAP, style.colour, width=1.3), beyond=True))
        curves.append(mark(100.0 * rate, lane, marker(style.marker, 7.0, style.colour), beyond=True))
        if name in published:
            curves.append(mark(100.0 * published[name], lane, RING, beyond=True))
        notes.append(_above(lane, name, 0.01, "left"))
        notes.append(_above(lane, texts[name], 1.0, "right"))
    confidence = batch.summary[names[0]].confidence
    abscissa = linear_axis(
        (max(-2.0, lowest - 0.06 * (100.0 - lowest) - 1.0), 100.0),
        5,
        label=f"success probability, %, with {100.0 * confidence:g} % confidence interval",
    )
    lanes = lane_axis([""] * len(names), (len(names) - 0.4, -0.8))
    return Chart(NO_BOX, abscissa, lanes, curves=curves, notes=notes)


def _above(lane: int, text: str, x: float, side: str) -> ChartNote:
    """Return a text above a lane at a fraction of the abscissa."""
    return ChartNote(text, (x, lane - 0.32), (True, False), (0.0, 0.0), (side, "bottom"), INK, TICK_SIZE)
