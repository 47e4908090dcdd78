"""The figures of a rare failure: limit state over simulations, exceedance probability, design points, intervals."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from ...campaigns.summary import success_interval
from ...campaigns.verdicts.order_statistics import quantiles
from ...studies.rare.outcome import RareResult
from ...studies.rare.uncertainty import CONFIDENCE
from ..common.panels import Panel, Widths, both_widths, is_slim, panel
from ..common.quantities import display_factor, label_with_unit, log_tick, number
from ..common.style import (
    BLUE,
    FAINT,
    INK,
    VERMILION,
    WIDTH,
    LineStyle,
    house_style,
    label_lanes,
    new_figure,
    plain_ticks,
)

GREY = "#9a9a9a"
HEIGHT = 3.0  # in
PLOT_HEIGHT = 3.2  # in, of a row in a notebook's figure
CUT = 0.002  # of the finite limit-state values, the smallest, may lie below the axis
PAIRED = 3  # parameters, of which each pair has a panel
PERCENT = f"{100 * CONFIDENCE:g} %"


class Span(NamedTuple):
    """The simulations ``first`` to ``last`` of a level, their limit state ``threshold``, and that of the next level.

    ``reached`` is the probability of the level itself, None where its chains are not trusted: no level follows then.
    """

    number: int
    first: int
    last: int
    threshold: float | None
    following: float | None
    reached: float | None


def level_spans(result: RareResult) -> list[Span]:
    """The levels by the numbers of their simulations, counted from 1: a chain's seed was flown at the level before."""
    spans: list[Span] = []
    levels = result.simulation.levels
    first, seeds, reached = 1, 0, 1.0
    for index, level in enumerate(levels):
        is_last = index + 1 == len(levels)
        last = result.simulation.evaluations if is_last else first + level.samples - seeds - 1
        following: float | None = 0.0 if is_last else levels[index + 1].threshold
        trusted = level.probability is not None
        spans.append(
            Span(index + 1, first, last, level.threshold, following if trusted else None, reached if trusted else None)
        )
        fraction = level.probability or 0.0
        first, seeds = last + 1, round(fraction * level.samples)
        reached *= fraction
    return spans


def limit_state_figure(result: RareResult) -> Widths:
    """The limit state of every simulation over its number."""
    words = f"Limit state of {result.flights} simulations in {len(result.simulation.levels)} levels"
    return both_widths("limit-state", words, lambda figure: draw_limit_state(figure.subplots(), result), HEIGHT)


def draw_limit_state(axes: Axes, result: RareResult) -> None:
    """Simulations by number, failures in colour, and the thresholds of levels."""
    factor = display_factor(result.margin_unit)
    values = factor * result.flown.values
    numbers = np.arange(1, values.size + 1)
    finite = np.isfinite(values)
    low, high = limits_of(values)
    failed = values >= 0.0
    size = max(1.2, min(4.0, 60.0 / values.size**0.5))
    style: LineStyle = {"linestyle": "", "markersize": size, "markeredgewidth": 0.0, "rasterized": values.size > 1500}
    axes.plot(numbers[~failed], values[~failed], marker="o", color=GREY, label="no failure", **style)
    hit = failed & finite
    axes.plot(numbers[hit], values[hit], marker="o", color=VERMILION, label="failure", **style)
    if not finite.all():
        top = np.full(int((~finite).sum()), high - 0.02 * (high - low))
        label = "failure without a finite limit state"
        axes.plot(numbers[~finite], top, "^", color=VERMILION, markersize=5, label=label)
    for span in level_spans(result):
        if span.following is not None:
            axes.hlines(factor * span.following, span.first, span.last, color=BLUE, linewidth=1.6)
        axes.axvline(span.last + 0.5, color=FAINT, linewidth=0.7, linestyle=(0, (1, 2)))
        middle = 0.5 * (span.first + span.last)
        axes.annotate(
            f"{span.number}", (middle, 1.0), xycoords=("data", "axes fraction"), xytext=(0, 2),
            textcoords="offset points", ha="center", va="bottom", fontsize=8.5, color=INK,
        )  # fmt: skip
    axes.axhline(0.0, color=INK, linewidth=1.0, linestyle=(0, (4, 2)))
    axes.set_xlim(0.0, values.size + 1.0)
    axes.set_ylim(low, high)
    axes.set_xlabel("simulation")
    axes.set_ylabel(label_with_unit("limit state", result.margin_unit))
    plain_ticks(axes, x=6, y=5)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2, markerscale=2.0, handletextpad=0.2)


def limits_of(values: np.ndarray) -> tuple[float, float]:
    """Ends of an axis that shows all limit-state values but the smallest few, and 0."""
    finite = values[np.isfinite(values)]
    low = min(float(quantiles(finite, [CUT])[0]), 0.0) if finite.size else -1.0
    high = max(float(finite.max()), 0.0) if finite.size else 1.0
    margin = 0.06 * (high - low) or 1.0
    return low - margin, high + margin


def exceedance_panel(result: RareResult) -> Panel:
    """How probable it is that the limit state is above a value."""
    words = "Probability that the limit state exceeds a value"
    return panel(
        "Exceedance probability", "exceedance", words, lambda axes: draw_exceedance(axes, result), HEIGHT, width=4.5
    )


def draw_exceedance(axes: Axes, result: RareResult) -> None:
    """The first level's empirical curve, the thresholds of levels, the failure with its interval."""
    spans = level_spans(result)
    factor = display_factor(result.margin_unit)
    first = np.sort(factor * result.flown.values[: spans[0].last])
    fraction = 1.0 - np.arange(first.size) / first.size
    seen = np.isfinite(first)
    axes.step(first[seen], fraction[seen], where="pre", color=GREY, linewidth=1.4, label="level 1: Monte Carlo")
    known = [
        (span.threshold, span.reached) for span in spans if span.threshold is not None and span.reached is not None
    ]
    thresholds, reached = [factor * one for one, _ in known], [other for _, other in known]
    low, high = result.interval
    if result.probability is not None:
        thresholds, reached = [*thresholds, 0.0], [*reached, result.probability]
    axes.plot(thresholds, reached, color=BLUE, marker="o", markersize=4, label="thresholds of levels")
    if low > 0.0:
        axes.plot([0.0, 0.0], [low, high], color=VERMILION, linewidth=2.4, label=f"failure, {PERCENT}")
    else:
        axes.plot([0.0], [high], "v", color=VERMILION, label=f"failure, below at {PERCENT}")
    axes.axvline(0.0, color=INK, linewidth=1.0, linestyle=(0, (4, 2)), zorder=1)
    log_axis(axes, "y")
    axes.set_ylim(0.5 * min([high, *reached, 1.0 / first.size] + ([low] if low > 0.0 else [])), 1.5)
    axes.set_xlim(*limits_of(factor * result.flown.values))
    plain_ticks(axes, x=5)
    axes.set_xlabel(label_with_unit("limit state", result.margin_unit))
    axes.set_title("probability of more", loc="left", fontsize=8.5)
    axes.legend(loc="lower left")


def log_axis(axes: Axes, which: str) -> None:
    """A logarithmic axis with whole decades marked."""
    getattr(axes, f"set_{which}scale")("log")
    axis = axes.xaxis if which == "x" else axes.yaxis
    axis.set_major_locator(LogLocator(numticks=7))
    axis.set_minor_locator(NullLocator())
    axis.set_major_formatter(FuncFormatter(log_tick))


def influence(result: RareResult) -> dict[str, float]:
    """How far failures lie from the first level's samples in each dispersed parameter, the largest first.

    In standard deviations of the first level: the larger of the shift of the mean and of that of the mean distance
    from the median, which sees failures at both ends.
    """
    count = level_spans(result)[0].last
    failed = result.flown.values >= 0.0
    influences: dict[str, float] = {}
    if not failed.any():
        return influences
    for name in result.space.names:
        column = result.flown.draws[name]
        start = column[:count]
        middle, spread = float(quantiles(start, (0.5,))[0]), float(np.std(start))
        if spread == 0.0:
            continue
        shift = abs(float(np.mean(column[failed]) - np.mean(start)))
        apart = float(np.mean(np.abs(column[failed] - middle)) - np.mean(np.abs(start - middle)))
        influences[name] = max(shift, apart) / spread
    return dict(sorted(influences.items(), key=lambda item: -item[1]))


def design_point_panels(result: RareResult) -> list[Panel]:
    """Failures and design points beside the first level's samples, over pairs of the most influential parameters."""
    names = list(influence(result))[:PAIRED]
    pairs = [(one, other) for index, one in enumerate(names) for other in names[index + 1 :]]

    return [
        panel(
            f"{other} over {one}",
            f"design-{index}",
            f"Samples, failures and design points over {one} and {other}",
            partial(draw_design_points, result=result, one=one, other=other),
            HEIGHT,
        )
        for index, (one, other) in enumerate(pairs)
    ]


def draw_design_points(axes: Axes, result: RareResult, one: str, other: str) -> None:
    """One pair: level 1 in grey, failures in colour, design points with their numbers."""
    units = [result.units.get(name) for name in (one, other)]
    factors = [display_factor(unit) for unit in units]
    x, y = (factor * result.flown.draws[name] for factor, name in zip(factors, (one, other), strict=True))
    count = level_spans(result)[0].last
    failed = result.flown.values >= 0.0
    points: LineStyle = {"linestyle": "", "markeredgewidth": 0.0, "rasterized": x.size > 1500}
    axes.plot(x[:count], y[:count], marker="o", markersize=2.6, color=GREY, label="level 1", **points)
    axes.plot(x[failed], y[failed], marker="o", markersize=2.4, color=VERMILION, label="failures", **points)
    entries = result.failures
    at = [(factors[0] * entry["draws"][one], factors[1] * entry["draws"][other]) for entry in entries]
    if at:
        axes.plot(*zip(*at, strict=True), "D", markersize=5, color=BLUE, markeredgecolor="white", label="design points")
    for entry, point in zip(entries, at, strict=True):
        axes.annotate(str(entry["trial"]), point, xytext=(5, 4), textcoords="offset points", fontsize=8.5, color=INK)
    plain_ticks(axes, x=4, y=5)
    axes.set_xlabel(label_with_unit(one, units[0]))
    axes.set_title(label_with_unit(other, units[1]), loc="left", fontsize=8.5)
    axes.legend(
        loc="upper center", bbox_to_anchor=(0.45, -0.22), ncols=3, handletextpad=0.0, columnspacing=0.6,
        borderaxespad=0.0, fontsize=8.0,
    )  # fmt: skip


class Equivalent(NamedTuple):
    """A way to estimate the probability: its simulations, and the interval that they give."""

    label: str
    simulations: float
    low: float
    high: float


def equivalents(result: RareResult) -> list[Equivalent]:
    """This study, Monte Carlo with as many simulations, and with as many as give the same coefficient of variation.

    Of Monte Carlo it is Clopper and Pearson's interval of the expected number of failures, as a whole number.
    """
    low, high = result.interval
    estimates = [Equivalent("this study", result.flights, low, high)]
    if result.probability is None:
        return estimates
    for label, trials in (
        ("Monte Carlo, as many", float(result.flights)),
        ("Monte Carlo, same c.o.v.", result.brute_force or 0.0),
    ):
        if trials >= 1.0:
            low, high = success_interval(round(result.probability * trials), round(trials))
            estimates.append(Equivalent(label, round(trials), low, high))
    return estimates


def interval_figure(result: RareResult) -> Widths:
    """The interval of this study and those of Monte Carlo, over a logarithmic axis."""
    rows = equivalents(result)

    def draw(figure: Figure) -> None:
        draw_intervals(figure.subplots(), rows, result.probability, is_slim(figure))

    return both_widths("interval", f"{PERCENT} intervals of the probability", draw, 0.8 + 0.36 * len(rows),
                       0.8 + 0.5 * len(rows))  # fmt: skip


def draw_intervals(axes: Axes, rows: list[Equivalent], probability: float | None, slim: bool) -> None:
    """A lane for each; an interval that begins at 0 goes on to the left, with an arrow."""
    positive = [end for row in rows for end in (row.low, row.high, probability or 0.0) if end > 0.0]
    left = 0.3 * min(positive)
    for index, row in enumerate(rows):
        colour = VERMILION if index == 0 else GREY
        axes.plot([max(row.low, left), row.high], [index, index], color=colour, linewidth=2.6)
        if row.low <= 0.0:
            axes.plot(left * 1.02, index, "<", color=colour, markersize=6, clip_on=False)
        label = f"{row.label}: {number(row.simulations, 3)} simulations"
        if slim:
            axes.annotate(label, (0.01, index - 0.28), xycoords=("axes fraction", "data"), fontsize=8.5, va="bottom")
    if probability is not None:
        axes.axvline(probability, color=INK, linewidth=1.0, linestyle=(0, (4, 2)))
    names = [f"{row.label} ({number(row.simulations, 3)})" for row in rows]
    log_axis(axes, "x")
    axes.set_xlim(left, 2.0 * max(positive))
    label_lanes(axes, [""] * len(rows) if slim else names, -0.8 if slim else -0.6)
    axes.set_xlabel(f"probability of failure, {PERCENT} interval")


def rare_plot(result: RareResult) -> Figure:
    """Limit state over simulations, exceedance probability; failures over the two most influential parameters."""
    names = list(influence(result))[:2]
    with house_style():
        figure = new_figure(2.0 * PLOT_HEIGHT, WIDTH)
        grid = figure.add_gridspec(2, 2)
        draw_limit_state(figure.add_subplot(grid[0, :]), result)
        if len(names) == 2:
            draw_exceedance(figure.add_subplot(grid[1, 0]), result)
            draw_design_points(figure.add_subplot(grid[1, 1]), result, *names)
        else:
            draw_exceedance(figure.add_subplot(grid[1, :]), result)
    return figure
