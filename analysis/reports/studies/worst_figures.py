"""The figures of a worst case: the search, the random trials with the worst, the search box."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...campaigns.verdicts.order_statistics import quantiles
from ...studies.worst.objective import MOST
from ...studies.worst.outcome import WorstResult
from ..chart.axes import lane_axis, linear_axis, ticked_axis
from ..chart.legend import Legend
from ..chart.lines import line
from ..chart.marks import instant, outline, rectangle
from ..chart.panel import chart_panel, wide_figure
from ..chart.symbols import mark, marker, marks
from ..chart.ticks import axis_ends
from ..common.colours import BLUE, FAINT, GRID, INK, VERMILION, Look
from ..common.panels import HALF_WIDTH, Panel, mark_swatch, swatch
from ..common.quantities import display_factor, label_with_unit, number
from ..interactive.charts import NO_BOX, Chart, Drawing, Note, Rule
from .rare_figures import DASHED, DOTTED, GREY, HEIGHT, number_above

CUT = 0.02  # of the simulations, those farthest from the worst may lie outside of an axis
LANE = 0.52  # in


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


def point_values(study: WorstResult) -> np.ndarray:
    """The objective (points,) of every point of the search, the larger the worse; fresh noise is left out.

    Each point flies the realisations of the noise in a row; where noise does not matter, one after the random trials.
    """
    count = 1 if study.over is None else study.over.count
    later = 1 if study.noise_matters is False else count
    fresh = 0 if study.fresh is None else study.fresh.values.size
    flown = study.flown.values[: study.flown.values.size - fresh]
    split = study.random_trials * count
    columns = []
    for values, size in ((flown[:split], count), (flown[split:], later)):
        rows = values.reshape(-1, size)
        columns.append(rows[:, 0] if study.over is None or size == 1 else study.over.objective(rows))
    return np.concatenate(columns)


def objective_of(study: WorstResult) -> Objective:
    """The objective of all points in the order in which they were flown, angles in degrees."""
    values = point_values(study)
    displayed = select_values(study, values)
    label = label_with_unit(study.badness.text, study.unit)
    random = int(np.argmax(values[: study.random_trials]))
    failed = ~np.isfinite([study.badness.size(float(value)) for value in values])
    rising = study.badness.size(-1.0) < 0.0  # of a margin the smaller number is worse
    return Objective(label, displayed, failed, rising, int(np.argmax(values)), random)


def select_values(study: WorstResult, values: np.ndarray) -> np.ndarray:
    """What values of the objective stand for, in the unit that is shown; nan where there is no such number."""
    sizes = np.array([study.badness.size(float(value)) for value in values])
    known = np.isfinite(sizes) & (np.abs(sizes) < MOST)
    return np.where(known, sizes * display_factor(study.unit), np.nan)


def search_figure(study: WorstResult) -> Drawing:
    """Return the objective over the points of the search, the worst so far, the phases."""
    words = f"{study.badness.text} at {objective_of(study).values.size} points of the search"
    return wide_figure("search", words, search_chart(study), HEIGHT)


def search_chart(study: WorstResult) -> Chart:
    """Return every point as a dot, the worst so far as a line, phases by their numbers."""
    objective = objective_of(study)
    numbers = np.arange(1.0, objective.values.size + 1.0)
    low, high = objective.limits()
    curves = [
        marks(numbers, objective.values, marker("o", 2.6, GREY, width=0.0), name="point"),
        line(numbers, objective.worst_so_far(), BLUE, width=1.6, steps=True, name="worst so far"),
    ]
    worst = objective.worst
    if np.isfinite(objective.values[worst]):
        diamond = marker("D", 6.0, VERMILION)
        curves.append(marks(numbers[[worst]], objective.values[[worst]], diamond, name="worst case"))
    if objective.failed.any():
        edge = high - 0.03 * (high - low) if objective.rising else low + 0.03 * (high - low)
        at = numbers[objective.failed]
        name = "failed" if objective.rising else "unstable, or not studied"
        triangle = marker("^" if objective.rising else "v", 6.0, VERMILION)
        curves.append(marks(at, np.full(at.size, edge), triangle, name=name))
    rules, notes, begin = [], [], 0
    for index, phase in enumerate(study.phases):
        end = begin + phase.evaluations
        rules.append(instant(end + 0.5, FAINT, 0.7, DOTTED))
        notes.append(number_above(str(index + 1), 0.5 * (begin + end + 1)))
        begin = end
    return Chart(
        NO_BOX,
        linear_axis((0.0, numbers.size + 1.0), 6, label="point of the search"),
        linear_axis((low, high), 5, label=objective.label),
        curves=curves,
        rules=rules,
        notes=notes,
    )


class Level(NamedTuple):
    """An abscissa that a chart marks if it is finite, as displayed: dashed unless it is the search's."""

    at: float
    colour: str
    name: str

    @property
    def dashes(self) -> tuple[float, ...]:
        """Dashes of the line."""
        return () if self.colour == VERMILION else DASHED


def _rules(levels: Sequence[Level]) -> list[Rule]:
    return [instant(each.at, each.colour, 1.7, each.dashes) for each in levels if math.isfinite(each.at)]


def _legend(first: str, levels: Sequence[Level]) -> Legend:
    """Swatches: of what is ``first`` in grey, and of the levels with their numbers."""
    finite = [each for each in levels if math.isfinite(each.at)]
    return [
        (swatch(Look(GREY, "-", "")), first),
        *(
            (swatch(Look(each.colour, (0, each.dashes) if each.dashes else "-", "")), f"{each.name}: {number(each.at)}")
            for each in finite
        ),
    ]


def trials_panel(study: WorstResult) -> Panel:
    """Return the random trials of the campaign, and where the worst case lies."""
    words = f"{study.badness.text}: {study.random_trials} random trials and the worst case"
    label, chart = "Worst case against random trials", trials_chart(study)
    legend = _legend(f"{study.random_trials} random trials", _trial_levels(objective_of(study)))
    panel = chart_panel(label, "trials", words, chart, HEIGHT, HALF_WIDTH, title=chart.title)
    return panel._replace(legend=legend)


def _trial_levels(objective: Objective) -> list[Level]:
    indices = ((objective.random, INK, "worst random trial"), (objective.worst, VERMILION, "worst case"))
    return [Level(float(objective.values[index]), colour, name) for index, colour, name in indices]


def trials_chart(study: WorstResult) -> Chart:
    """Return the histogram of the random trials, marks at the worst of them and at the worst case."""
    objective = objective_of(study)
    trials = objective.values[: study.random_trials]
    finite = trials[np.isfinite(trials)]
    bins = max(8, min(40, round(2.0 * finite.size ** (1.0 / 3.0))))
    heights, edges = np.histogram(finite, bins)
    levels = _trial_levels(objective)
    return Chart(
        NO_BOX,
        linear_axis(axis_ends(np.array([*edges, *(each.at for each in levels)])), 5, label=objective.label),
        linear_axis((0.0, 1.05 * max(1.0, float(heights.max()))), 5, integer=True),
        title="trials",
        areas=[
            rectangle(float(left), float(right), 0.0, float(height), GREY, 1.0)
            for left, right, height in zip(edges[:-1], edges[1:], heights, strict=True)
            if height
        ],
        rules=_rules(levels),
    )


def fresh_panel(study: WorstResult) -> Panel | None:
    """Return the worst case under fresh noise; None where the noise is not random, or changes nothing."""
    if study.fresh is None or not np.any(study.fresh.values != study.fresh.values[0]):
        return None
    size = study.fresh.values.size
    words = f"{study.badness.text} of the worst case under {size} fresh noise realisations"
    chart, legend = fresh_chart(study), _legend(f"{size} fresh realisations", _fresh_levels(study))
    panel = chart_panel("Worst case under fresh noise", "fresh", words, chart, HEIGHT, HALF_WIDTH, title=chart.title)
    return panel._replace(legend=legend)


def _fresh_levels(study: WorstResult) -> list[Level]:
    """The realisations' quantile, their worst, and the value of the search."""
    assert study.fresh is not None
    assert study.over is not None
    middle = () if study.fresh.quantile == 1.0 else ((study.fresh.at_quantile, BLUE, f"their {study.over.name}"),)
    levels = (
        *middle,
        (study.fresh.worst, INK, "worst of them"),
        (study.value, VERMILION, f"{study.over.name} in the search"),
    )
    return [Level(float(select_values(study, np.array([at]))[0]), colour, name) for at, colour, name in levels]


def fresh_chart(study: WorstResult) -> Chart:
    """Return the fraction of fresh realisations up to a value, marks at the levels of `_fresh_levels`."""
    assert study.fresh is not None
    ranked = select_values(study, np.sort(study.fresh.values))
    fraction = np.arange(1.0, ranked.size + 1.0) / ranked.size
    levels = _fresh_levels(study)
    ends = axis_ends(np.array([*ranked, *(each.at for each in levels)]))
    return Chart(
        NO_BOX,
        linear_axis(ends, 5, label=label_with_unit(study.badness.text, study.unit)),
        linear_axis((0.0, 1.03), 4),
        title="fraction of realisations",
        curves=[line(ranked, fraction, GREY, width=1.6, steps=True)],
        rules=_rules(levels),
    )


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


def box_lanes(study: WorstResult) -> list[Lane]:
    """A lane for every dispersed parameter."""
    plotted, (worst, random) = study.flown.draws, study.places
    return [
        Lane(name, study.units.get(name, ""), low, high, float(plotted[name][worst]), float(plotted[name][random]))
        for name, (low, high) in study.space.ranges(study.sigmas).items()
    ]


def box_figure(study: WorstResult) -> Drawing:
    """Return where in the search box the worst case lies, a lane for each dispersed parameter."""
    lanes = box_lanes(study)
    words = f"The worst case within the search box of {len(lanes)} parameters"
    return wide_figure("box", words, box_chart(lanes), 0.7 + LANE * len(lanes))


RANDOM, WORST = marker("o", 7.0, INK, fill="#ffffff"), marker("D", 6.0, VERMILION)
BOX_LEGEND = [(mark_swatch(each), name) for each, name in ((RANDOM, "worst random trial"), (WORST, "worst case"))]


def box_chart(lanes: Sequence[Lane]) -> Chart:
    """Return positions as fractions of the box; the ends' values stand at the ends."""
    curves, areas, notes = [], [], []
    for index, lane in enumerate(lanes):
        areas.append(outline(np.array([0.0, 1.0]), np.full(2, float(index)), GRID, 5.0))
        curves.append(mark(lane.at(lane.random), index, RANDOM, beyond=True))
        curves.append(mark(lane.at(lane.worst), index, WORST, beyond=True))
        factor = display_factor(lane.unit)
        texts = [(0.0, number(factor * lane.low, 6), "left"), (1.0, number(factor * lane.high, 6), "right")]
        for x, text, side in texts:
            notes.append(Note(text, (x, index - 0.3), (False, False), (0.0, 0.0), (side, "bottom"), FAINT, 8.0))
        at, centred = (0.5, index - 0.3), ("center", "bottom")
        notes.append(Note(lane.label, at, (False, False), (0.0, 0.0), centred, INK, 8.5))
    return Chart(
        NO_BOX,
        replace(ticked_axis((-0.02, 1.02), [0.0, 0.5, 1.0], label="fraction of the search box"), grid=False),
        lane_axis([""] * len(lanes), (len(lanes) - 0.4, -0.9)),
        curves=curves,
        areas=areas,
        notes=notes,
    )


def worst_charts(study: WorstResult) -> list[Chart]:
    """Return the search over simulations, and the random trials with the worst case."""
    trials = trials_chart(study)
    levels = (f"{each.name} {number(each.at)}" for each in _trial_levels(objective_of(study)))
    return [search_chart(study), replace(trials, title=f"trials; {', '.join(levels)}")]
