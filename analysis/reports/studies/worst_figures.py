"""The figures of a worst case: the search, the random trials with the worst, the search box."""

from __future__ import annotations

import math
from functools import partial
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...campaigns.verdicts.order_statistics import quantiles
from ...studies.worst.objective import MOST
from ...studies.worst.outcome import WorstResult
from ..common.panels import HALF_WIDTH, Panel, Widths, both_widths, is_slim, panel
from ..common.quantities import display_factor, label_with_unit, number
from ..common.style import BLUE, FAINT, INK, VERMILION, WIDTH, house_style, label_lanes, new_figure, plain_ticks

GREY = "#9a9a9a"
HEIGHT = 3.0  # in
PLOT_HEIGHT = 3.2  # in, of a row in a notebook's figure
CUT = 0.02  # of the simulations, those farthest from the worst may lie outside of an axis
LANE, SLIM_LANE = 0.34, 0.52  # in


class Objective(NamedTuple):
    """The objective of all points of a search in their order, as a page shows it.

    ``values`` (points,) are nan where there is none, and ``failed`` says which did not come to their end, or are
    unstable. ``rising`` says that a larger value is worse; a margin is worse where it is smaller. ``worst`` and
    ``random`` are the places of the worst point and of the worst random trial.
    """

    label: str
    values: np.ndarray
    failed: np.ndarray
    rising: bool
    worst: int
    random: int

    def limits(self) -> tuple[float, float]:
        """Ends of an axis with the worst value on it, and all but a few of the others."""
        finite = self.values[np.isfinite(self.values)]
        if not finite.size:
            return -1.0, 1.0
        (level,) = quantiles(finite, [CUT if self.rising else 1.0 - CUT])
        worst = finite.max() if self.rising else finite.min()
        low, high = float(min(level, worst)), float(max(level, worst))
        margin = 0.08 * (high - low) or 0.05 * abs(high) or 1.0
        return low - margin, high + margin

    def worst_so_far(self) -> np.ndarray:
        """The worst value up to each point; nan before the first."""
        return np.fmax.accumulate(self.values) if self.rising else np.fmin.accumulate(self.values)


def point_values(result: WorstResult) -> np.ndarray:
    """The objective (points,) of every point of the search, the larger the worse; fresh noise is left out.

    Each point flies the realisations of the noise in a row; where noise does not matter, one after the random trials.
    """
    count = 1 if result.over is None else result.over.count
    later = 1 if result.noise_matters is False else count
    fresh = 0 if result.fresh is None else result.fresh.values.size
    flown = result.flown.values[: result.flown.values.size - fresh]
    split = result.random_trials * count
    columns = []
    for values, size in ((flown[:split], count), (flown[split:], later)):
        rows = values.reshape(-1, size)
        columns.append(rows[:, 0] if result.over is None or size == 1 else result.over.objective(rows))
    return np.concatenate(columns)


def objective_of(result: WorstResult) -> Objective:
    """The objective of all points in the order in which they were flown, angles in degrees."""
    values = point_values(result)
    displayed = select_values(result, values)
    label = label_with_unit(result.badness.text, result.unit)
    random = int(np.argmax(values[: result.random_trials]))
    failed = ~np.isfinite([result.badness.size(float(value)) for value in values])
    rising = result.badness.size(-1.0) < 0.0  # of a margin the smaller number is worse
    return Objective(label, displayed, failed, rising, int(np.argmax(values)), random)


def select_values(result: WorstResult, values: np.ndarray) -> np.ndarray:
    """What values of the objective stand for, in the unit that is shown; nan where there is no such number."""
    sizes = np.array([result.badness.size(float(value)) for value in values])
    known = np.isfinite(sizes) & (np.abs(sizes) < MOST)
    return np.where(known, sizes * display_factor(result.unit), np.nan)


def search_figure(result: WorstResult) -> Widths:
    """The objective over the points of the search, the worst so far, the phases."""
    objective = objective_of(result)
    words = f"{result.badness.text} at {objective.values.size} points of the search"
    return both_widths("search", words, lambda figure: draw_search(figure.subplots(), result), HEIGHT)


def draw_search(axes: Axes, result: WorstResult) -> None:
    """Every point as a dot, the worst so far as a line, phases by their numbers."""
    objective = objective_of(result)
    numbers = np.arange(1, objective.values.size + 1)
    low, high = objective.limits()
    axes.plot(
        numbers, objective.values, "o", color=GREY, markersize=2.6, markeredgewidth=0.0, rasterized=numbers.size > 1500,
        label="point",
    )  # fmt: skip
    axes.step(numbers, objective.worst_so_far(), where="post", color=BLUE, linewidth=1.6, label="worst so far")
    worst = objective.worst
    if np.isfinite(objective.values[worst]):
        axes.plot(numbers[worst], objective.values[worst], "D", color=VERMILION, markersize=6, label="worst case")
    if objective.failed.any():
        edge = high - 0.03 * (high - low) if objective.rising else low + 0.03 * (high - low)
        at = numbers[objective.failed]
        label = "failed" if objective.rising else "unstable, or not studied"
        axes.plot(at, np.full(at.size, edge), "^" if objective.rising else "v", color=VERMILION, label=label)
    begin = 0
    for index, phase in enumerate(result.phases):
        end = begin + phase.evaluations
        axes.axvline(end + 0.5, color=FAINT, linewidth=0.7, linestyle=(0, (1, 2)))
        axes.annotate(
            str(index + 1), (0.5 * (begin + end + 1), 1.0), xycoords=("data", "axes fraction"), xytext=(0, 2),
            textcoords="offset points", ha="center", va="bottom", fontsize=8.5, color=INK,
        )  # fmt: skip
        begin = end
    axes.set_xlim(0.0, numbers.size + 1.0)
    axes.set_ylim(low, high)
    axes.set_xlabel("point of the search")
    axes.set_title(objective.label, loc="left", fontsize=8.5, pad=18)
    plain_ticks(axes, x=6, y=5)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=4, handletextpad=0.6, columnspacing=1.2)


def trials_panel(result: WorstResult) -> Panel:
    """The random trials of the campaign, and where the worst case lies."""
    words = f"{result.badness.text}: {result.random_trials} random trials and the worst case"
    return panel(
        "Worst case against random trials", "trials", words, partial(draw_trials, result=result), HEIGHT, HALF_WIDTH
    )


def fresh_panel(result: WorstResult) -> Panel | None:
    """The worst case under fresh noise realisations; None where the noise is not random, or changes nothing."""
    if result.fresh is None or not np.any(result.fresh.values != result.fresh.values[0]):
        return None
    words = f"{result.badness.text} of the worst case under {result.fresh.values.size} fresh noise realisations"
    return panel("Worst case under fresh noise", "fresh", words, partial(draw_fresh, result=result), HEIGHT, HALF_WIDTH)


def draw_fresh(axes: Axes, result: WorstResult) -> None:
    """Fraction of fresh realisations up to a value, marks at their quantile, their worst, and the search's value."""
    assert result.fresh is not None
    assert result.over is not None
    ranked = select_values(result, np.sort(result.fresh.values))
    fraction = np.arange(1, ranked.size + 1) / ranked.size
    axes.step(ranked, fraction, where="post", color=GREY, linewidth=1.6, label=f"{ranked.size} fresh realisations")
    middle = () if result.fresh.quantile == 1.0 else ((result.fresh.at_quantile, BLUE, f"their {result.over.name}"),)
    marks = (
        *middle,
        (result.fresh.worst, INK, "worst of them"),
        (result.value, VERMILION, f"{result.over.name} in the search"),
    )
    for value, colour, label in marks:
        _mark(axes, float(select_values(result, np.array([value]))[0]), colour, label, 1.6)
    axes.set_ylim(0.0, 1.03)
    axes.set_xlabel(label_with_unit(result.badness.text, result.unit))
    axes.set_ylabel("fraction of realisations")
    plain_ticks(axes, x=5, y=4)
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.02), ncols=1, borderaxespad=0.0)


def draw_trials(axes: Axes, result: WorstResult) -> None:
    """Histogram of the random trials, marks at the worst of them and at the worst case."""
    objective = objective_of(result)
    trials = objective.values[: result.random_trials]
    seen = trials[np.isfinite(trials)]
    bins = max(8, min(40, round(2.0 * seen.size ** (1.0 / 3.0))))
    axes.hist(seen, bins=bins, color=GREY, label=f"{result.random_trials} random trials")
    marks = ((objective.random, INK, "worst random trial"), (objective.worst, VERMILION, "worst case"))
    for place, colour, label in marks:
        _mark(axes, float(objective.values[place]), colour, label, 1.8)
    axes.set_xlabel(objective.label)
    axes.set_ylabel("trials")
    plain_ticks(axes, x=5, y=5, whole_y=True)
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.02), ncols=1, borderaxespad=0.0)


def _mark(axes: Axes, value: float, colour: str, label: str, width: float) -> None:
    """A value as a line, dashed unless it is the search's; none where it is not finite."""
    if math.isfinite(value):
        style = "-" if colour == VERMILION else (0, (4, 2))
        axes.axvline(value, color=colour, linewidth=width, linestyle=style, label=f"{label}: {number(value)}")


class Lane(NamedTuple):
    """A dispersed parameter in the box: its ends, and its values at the worst case and the worst random trial."""

    name: str
    unit: str
    low: float
    high: float
    worst: float
    random: float

    @property
    def label(self) -> str:
        return label_with_unit(self.name, self.unit)

    def at(self, value: float) -> float:
        """A value as a fraction of the box."""
        return (value - self.low) / (self.high - self.low)


def box_lanes(result: WorstResult) -> list[Lane]:
    """A lane for every dispersed parameter."""
    plotted, (worst, random) = result.flown.draws, result.places
    return [
        Lane(name, result.units.get(name, ""), low, high, float(plotted[name][worst]), float(plotted[name][random]))
        for name, (low, high) in result.space.ranges(result.sigmas).items()
    ]


def box_figure(result: WorstResult) -> Widths:
    """Where in the search box the worst case lies, a lane for each dispersed parameter."""
    lanes = box_lanes(result)

    def draw(figure: Figure) -> None:
        draw_box(figure.subplots(), lanes, is_slim(figure))

    words = f"The worst case within the search box of {len(lanes)} parameters"
    return both_widths("box", words, draw, 0.9 + LANE * len(lanes), 0.9 + SLIM_LANE * len(lanes))


def draw_box(axes: Axes, lanes: list[Lane], slim: bool) -> None:
    """Positions as fractions of the box; the ends' values stand at the ends."""
    for index, lane in enumerate(lanes):
        axes.plot([0.0, 1.0], [index, index], color="#dddddd", linewidth=5.0, solid_capstyle="butt", zorder=1)
        label = "worst random trial" if index == 0 else None
        axes.plot(lane.at(lane.random), index, "o", markersize=7, markerfacecolor="white", markeredgecolor=INK,
                  label=label, clip_on=False)  # fmt: skip
        label = "worst case" if index == 0 else None
        axes.plot(lane.at(lane.worst), index, "D", markersize=6, color=VERMILION, label=label, clip_on=False, zorder=4)
        offset = -0.3 if slim else -0.26
        for x, text, side in ((0.0, lane.low, "left"), (1.0, lane.high, "right")):
            axes.annotate(
                number(text * display_factor(lane.unit), 6), (x, index + offset), ha=side, va="bottom", fontsize=8.0,
                color=FAINT, annotation_clip=False,
            )  # fmt: skip
        if slim:
            axes.annotate(lane.label, (0.5, index + offset), ha="center", va="bottom", fontsize=8.5)
    label_lanes(axes, ["" if slim else lane.label for lane in lanes], -0.9)
    axes.set_xlim(-0.02, 1.02)
    axes.set_xticks([0.0, 0.5, 1.0], ["0", "0.5", "1"])
    axes.grid(visible=False)
    axes.set_xlabel("fraction of the search box")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderaxespad=0.0)


def worst_plot(result: WorstResult) -> Figure:
    """The search over simulations, and the random trials with the worst case."""
    with house_style():
        figure = new_figure(PLOT_HEIGHT, WIDTH)
        left, right = figure.subplots(1, 2, width_ratios=(1.4, 1.0))
        draw_search(left, result)
        draw_trials(right, result)
    return figure
