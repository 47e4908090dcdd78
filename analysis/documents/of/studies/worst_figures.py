"""Figures of a worst case: the search, the random trials with the worst case, the search box."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ....studies.worst.outcome import WorstOutcome
from ...cell import LegendEntry
from ...chart.axes import lane_axis, linear_axis, ticked_axis
from ...chart.lines import line
from ...chart.marks import outline, rectangle, vertical_line
from ...chart.symbols import mark, marker, marks
from ...chart.ticks import axis_ends
from ...common.colours import BLUE, FAINT, GRID, INK, VERMILION, Look
from ...common.quantities import display_factor, label_with_unit, number
from ...interactive.charts import NO_BOX, Chart, ChartNote, Rule
from ...pictures import Figure
from .rare_figures import DASHED, DOTTED, GREY, HEIGHT, curve_legend, number_above
from .worst_points import Lane, ObjectiveValues, box_lanes, objective_of, select_values

LANE = 0.52  # in


def search_figures(study: WorstOutcome) -> list[Figure]:
    """Return the figure of the objective over the points of the search, with the worst value so far and the phases."""
    chart = search_chart(study)
    words = f"{study.badness.text} at {objective_of(study).values.size} points of the search"
    return [Figure("", "search", words, chart, HEIGHT, is_wide=True, legend=curve_legend(chart))]


def search_chart(study: WorstOutcome) -> Chart:
    """Return the chart of all points as dots, with the worst value so far as a line, and numbered phases."""
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
        rules.append(vertical_line(end + 0.5, FAINT, 0.7, DOTTED))
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


class MarkedAbscissa(NamedTuple):
    """An abscissa, as displayed, that a chart marks with a line if finite: dashed unless it is the search's result."""

    at: float
    colour: str
    name: str

    @property
    def dashes(self) -> tuple[float, ...]:
        """The dashes of its line."""
        return () if self.colour == VERMILION else DASHED


def _rules(levels: Sequence[MarkedAbscissa]) -> list[Rule]:
    return [vertical_line(each.at, each.colour, 1.7, each.dashes) for each in levels if math.isfinite(each.at)]


def _legend(first: str, levels: Sequence[MarkedAbscissa]) -> list[LegendEntry]:
    """Return legend entries: ``first`` in grey, then the marked levels with their numbers."""
    finite = [each for each in levels if math.isfinite(each.at)]
    return [
        LegendEntry(Look(GREY, "-", ""), [first]),
        *(
            LegendEntry(
                Look(each.colour, (0, each.dashes) if each.dashes else "-", ""), [f"{each.name}: {number(each.at)}"]
            )
            for each in finite
        ),
    ]


def random_figures(study: WorstOutcome) -> list[Figure]:
    """Return figures of the random trials with the worst case and, if new noise changes it, of its new realisations."""
    words = f"{study.badness.text}: {study.random_trials} random trials and the worst case"
    legend = _legend(f"{study.random_trials} random trials", _trial_levels(objective_of(study)))
    figures = [Figure("Worst case against random trials", "trials", words, trials_chart(study), HEIGHT, legend=legend)]
    if study.fresh is not None and np.any(study.fresh.values != study.fresh.values[0]):
        size = study.fresh.values.size
        words = f"{study.badness.text} of the worst case under {size} fresh noise realisations"
        legend = _legend(f"{size} fresh realisations", _fresh_levels(study))
        figures.append(
            Figure("Worst case under fresh noise", "fresh", words, fresh_chart(study), HEIGHT, legend=legend)
        )
    return figures


def _trial_levels(objective: ObjectiveValues) -> list[MarkedAbscissa]:
    indices = ((objective.random, INK, "worst random trial"), (objective.worst, VERMILION, "worst case"))
    return [MarkedAbscissa(float(objective.values[index]), colour, name) for index, colour, name in indices]


def trials_chart(study: WorstOutcome) -> Chart:
    """Return the chart of the random trials as a histogram, with marks at the worst of them and at the worst case."""
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


def _fresh_levels(study: WorstOutcome) -> list[MarkedAbscissa]:
    """Return the quantile and the worst of the realisations, and the value of the search."""
    assert study.fresh is not None
    assert study.over is not None
    middle = () if study.fresh.quantile == 1.0 else ((study.fresh.at_quantile, BLUE, f"their {study.over.name}"),)
    levels = (
        *middle,
        (study.fresh.worst, INK, "worst of them"),
        (study.value, VERMILION, f"{study.over.name} in the search"),
    )
    return [MarkedAbscissa(float(select_values(study, np.array([at]))[0]), colour, name) for at, colour, name in levels]


def fresh_chart(study: WorstOutcome) -> Chart:
    """Return the chart of the fraction of new realisations up to a value, with marks at `_fresh_levels`."""
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


RANDOM, WORST = marker("o", 7.0, INK, fill="#ffffff"), marker("D", 6.0, VERMILION)
BOX_LEGEND = [LegendEntry(RANDOM, ["worst random trial"]), LegendEntry(WORST, ["worst case"])]


def box_figures(study: WorstOutcome) -> list[Figure]:
    """Return the figure of the worst case's position in the search box, with a lane for each dispersed parameter."""
    lanes = box_lanes(study)
    words = f"The worst case within the search box of {len(lanes)} parameters"
    height = 0.7 + LANE * len(lanes)
    return [Figure("", "box", words, box_chart(lanes), height, is_wide=True, legend=BOX_LEGEND)]


def box_chart(lanes: Sequence[Lane]) -> Chart:
    """Return the chart of positions as fractions of the box, with the values of its ends as labels."""
    curves, areas, notes = [], [], []
    for index, lane in enumerate(lanes):
        areas.append(outline(np.array([0.0, 1.0]), np.full(2, float(index)), GRID, 5.0))
        curves.append(mark(lane.at(lane.random), index, RANDOM, beyond=True))
        curves.append(mark(lane.at(lane.worst), index, WORST, beyond=True))
        factor = display_factor(lane.unit)
        texts = [(0.0, number(factor * lane.low, 6), "left"), (1.0, number(factor * lane.high, 6), "right")]
        for x, text, side in texts:
            notes.append(ChartNote(text, (x, index - 0.3), (False, False), (0.0, 0.0), (side, "bottom"), FAINT, 8.0))
        at, centred = (0.5, index - 0.3), ("center", "bottom")
        notes.append(ChartNote(lane.label, at, (False, False), (0.0, 0.0), centred, INK, 8.5))
    return Chart(
        NO_BOX,
        replace(ticked_axis((-0.02, 1.02), [0.0, 0.5, 1.0], label="fraction of the search box"), grid=False),
        lane_axis([""] * len(lanes), (len(lanes) - 0.4, -0.9)),
        curves=curves,
        areas=areas,
        notes=notes,
    )
