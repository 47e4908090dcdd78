"""The figures of a worst case: the search, the random trials with the worst, the search box."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...worst.margin import MOST
from ...worst.outcome import WorstResult
from ..kit.panels import Panel, Widths, both_widths, is_slim, panel
from ..kit.quantities import number
from ..kit.style import BLUE, FAINT, INK, VERMILION, plain_ticks

GREY = "#9a9a9a"
HEIGHT = 3.0  # in
CUT = 0.02  # of the simulations, those farthest from the worst may lie outside of an axis
LANE, SLIM_LANE = 0.34, 0.52  # in


class Objective(NamedTuple):
    """The objective as a page shows it: ``values`` (simulations,), nan where there is none, which ``failed``.

    ``rising`` says that a larger value is worse; a margin is worse where it is smaller. ``failed`` are simulations
    that did not come to their end, and unstable loops.
    """

    label: str
    values: np.ndarray
    failed: np.ndarray
    rising: bool

    def limits(self) -> tuple[float, float]:
        """Ends of an axis with the worst value on it, and all but a few of the others."""
        found = self.values[np.isfinite(self.values)]
        if not found.size:
            return -1.0, 1.0
        level = np.quantile(found, CUT if self.rising else 1.0 - CUT)
        worst = found.max() if self.rising else found.min()
        low, high = float(min(level, worst)), float(max(level, worst))
        margin = 0.08 * (high - low) or 0.05 * abs(high) or 1.0
        return low - margin, high + margin

    def best_so_far(self) -> np.ndarray:
        """The worst value up to each simulation; nan before the first."""
        if self.rising:
            return np.fmax.accumulate(self.values)
        return np.fmin.accumulate(self.values)


def objective_of(result: WorstResult) -> Objective:
    """The objective of all simulations in the order in which they were flown."""
    rising = result.badness.size(-1.0) < 0.0
    sizes = np.array([result.badness.size(float(value)) for value in result.flown.values])
    failed = ~np.isfinite(sizes)
    shown = np.where(failed | (np.abs(sizes) >= MOST), np.nan, sizes)
    return Objective(result.badness.text, shown, failed, rising)


def search_figure(result: WorstResult) -> Widths:
    """The objective over simulations, the worst so far, the phases of the search."""
    words = f"{result.badness.text} of {result.flights} simulations of the search"
    return both_widths("search", words, lambda figure: draw_search(figure.subplots(), result), HEIGHT)


def draw_search(axes: Axes, result: WorstResult) -> None:
    """Every simulation as a point, the worst so far as a line, phases by their numbers."""
    objective = objective_of(result)
    numbers = np.arange(1, objective.values.size + 1)
    low, high = objective.limits()
    image = numbers.size > 1500
    axes.plot(
        numbers, objective.values, "o", color=GREY, markersize=2.6, markeredgewidth=0.0, rasterized=image,
        label="simulation",
    )  # fmt: skip
    axes.step(numbers, objective.best_so_far(), where="post", color=BLUE, linewidth=1.6, label="worst so far")
    worst = result.places[0]
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
    axes.set_xlabel("simulation")
    axes.set_title(objective.label, loc="left", fontsize=8.5, pad=18)
    plain_ticks(axes, x=6, y=5)
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=4, handletextpad=0.2, columnspacing=1.0)


def trials_panel(result: WorstResult) -> Panel:
    """The random trials of the campaign, and where the worst case lies."""
    words = f"{result.badness.text}: {result.random_trials} random trials and the worst case"
    return panel(
        "Worst case against random trials", "trials", words, lambda axes: draw_trials(axes, result), HEIGHT, width=4.5
    )


def draw_trials(axes: Axes, result: WorstResult) -> None:
    """Histogram of the random trials, marks at the worst of them and at the worst case."""
    objective = objective_of(result)
    trials = objective.values[: result.random_trials]
    seen = trials[np.isfinite(trials)]
    bins = max(8, min(40, round(2.0 * seen.size ** (1.0 / 3.0))))
    axes.hist(seen, bins=bins, color=GREY, label=f"{result.random_trials} random trials")
    marks = ((result.random, INK, "worst random trial"), (result.places[0], VERMILION, "worst case"))
    for place, colour, label in marks:
        value = objective.values[place]
        if np.isfinite(value):
            style = (0, (4, 2)) if colour == INK else "-"
            axes.axvline(value, color=colour, linewidth=1.8, linestyle=style, label=f"{label}: {number(float(value))}")
    axes.set_xlabel(objective.label)
    axes.set_ylabel("trials")
    plain_ticks(axes, x=5, y=5, whole_y=True)
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.02), ncols=1, borderaxespad=0.0)


class Lane(NamedTuple):
    """A dispersed parameter in the box: its ends, and its values at the worst case and the worst random trial."""

    name: str
    low: float
    high: float
    worst: float
    random: float

    def at(self, value: float) -> float:
        """A value as a fraction of the box."""
        return (value - self.low) / (self.high - self.low)


def box_lanes(result: WorstResult) -> list[Lane]:
    """A lane for every dispersed parameter."""
    worst, random = (result.flown.draws, result.flown.draws)
    place = result.places[0]
    return [
        Lane(name, low, high, float(worst[name][place]), float(random[name][result.random]))
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
        offset = -0.3 if slim else -0.22
        for x, text, side in ((0.0, lane.low, "left"), (1.0, lane.high, "right")):
            axes.annotate(
                number(text, 6), (x, index + offset), ha=side, va="bottom", fontsize=8.0, color=FAINT,
                annotation_clip=False,
            )  # fmt: skip
        if slim:
            axes.annotate(lane.name, (0.5, index + offset), ha="center", va="bottom", fontsize=8.5)
    axes.set_yticks(range(len(lanes)), [""] * len(lanes) if slim else [lane.name for lane in lanes])
    axes.set_ylim(len(lanes) - 0.4, -0.9)
    axes.set_xlim(-0.02, 1.02)
    axes.set_xticks([0.0, 0.5, 1.0], ["0", "0.5", "1"])
    axes.grid(visible=False)
    axes.tick_params(axis="y", length=0, labelsize=9)
    axes.set_xlabel("fraction of the search box")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderaxespad=0.0)
