"""Figures of a rare failure: limit state over simulations, exceedance probability, design points, intervals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from ....campaigns.verdicts.order_statistics import quantiles
from ....studies.rare.interpretation import Equivalent, equivalents, influence, level_spans
from ....studies.rare.outcome import RareOutcome
from ....studies.rare.uncertainty import CONFIDENCE
from ...cell import LegendEntry
from ...chart import marks as shapes
from ...chart.axes import fine_axis, lane_axis, linear_axis
from ...chart.lines import line
from ...chart.symbols import mark, marker, marks
from ...chart.ticks import axis_ends
from ...common.colours import BLUE, FAINT, INK, VERMILION
from ...common.quantities import display_factor, label_with_unit, number
from ...interactive.charts import NO_BOX, Backing, Chart, ChartNote
from ...pictures import Figure

GREY = "#9a9a9a"
HEIGHT = 3.0  # in
DASHED, DOTTED = (4.0, 2.0), (1.0, 2.0)  # line widths
CUT = 0.002  # fraction of limit-state values that may be below the axis
PAIRED = 3  # number of parameters of which each pair has a panel
BEHIND = Backing("#ffffff", 0.8, 0.8)  # backing of words over a line
PERCENT = f"{100 * CONFIDENCE:g} %"


def limit_figures(study: RareOutcome) -> list[Figure]:
    """Return the figure of the limit state of every simulation over its number."""
    words = f"Limit state of {study.flights} simulations in {len(study.simulation.levels)} levels"
    chart = limit_state_chart(study)
    return [Figure("", "limit-state", words, chart, HEIGHT, is_wide=True, legend=curve_legend(chart))]


def limit_state_chart(study: RareOutcome) -> Chart:
    """Return the chart of limit states by number of simulation, with coloured failures and the thresholds of levels."""
    factor = display_factor(study.margin_unit)
    values = study.flown.values
    numbers = np.arange(1.0, values.size + 1.0)
    finite, failed = np.isfinite(values), values >= 0.0
    low, high = limits_of(factor * values)
    size = max(1.2, min(4.0, 60.0 / values.size**0.5))
    curves = [
        marks(numbers[rows], values[rows], marker("o", size, colour, width=0.0), name=name, unit=study.margin_unit)
        for rows, colour, name in ((finite & ~failed, GREY, "no failure"), (finite & failed, VERMILION, "failure"))
        if np.any(rows)
    ]
    if not finite.all():
        top = np.full(int((~finite).sum()), high - 0.02 * (high - low))
        triangle = marker("^", 5.0, VERMILION)
        curves.append(marks(numbers[~finite], top, triangle, name="failure without a finite limit state"))
    areas, rules, notes = [], [shapes.horizontal_line(0.0, INK, 1.0, DASHED)], []
    for span in level_spans(study):
        if span.following is not None:
            ends, heights = np.array([span.first, span.last]), np.full(2, factor * span.following)
            areas.append(shapes.outline(ends, heights, BLUE, 1.6))
        rules.append(shapes.vertical_line(span.last + 0.5, FAINT, 0.7, DOTTED))
        notes.append(number_above(f"{span.number}", 0.5 * (span.first + span.last)))
    return Chart(
        NO_BOX,
        linear_axis((0.0, values.size + 1.0), 6, label="simulation"),
        linear_axis((low, high), 5, label=label_with_unit("limit state", study.margin_unit)),
        curves=curves,
        areas=areas,
        rules=rules,
        notes=notes,
    )


def curve_legend(chart: Chart) -> list[LegendEntry]:
    """Return legend entries for the named curves of a chart."""
    return [LegendEntry(curve, [curve.name]) for curve in chart.curves if curve.name]


def number_above(text: str, at: float) -> ChartNote:
    """Return a number above the axes at an abscissa."""
    return ChartNote(text, (at, 1.0), (False, True), (0.0, 2.0), ("center", "bottom"), INK, 8.5)


def limits_of(values: np.ndarray) -> tuple[float, float]:
    """Return the ends of an axis that shows 0 and all limit-state values but the few smallest."""
    finite = values[np.isfinite(values)]
    low = min(float(quantiles(finite, [CUT])[0]), 0.0) if finite.size else -1.0
    high = max(float(finite.max()), 0.0) if finite.size else 1.0
    margin = 0.06 * (high - low) or 1.0
    return low - margin, high + margin


def exceedance_figures(study: RareOutcome) -> list[Figure]:
    """Return the figure of the probability that the limit state exceeds a value."""
    words, chart = "Probability that the limit state exceeds a value", exceedance_chart(study)
    return [Figure("Exceedance probability", "exceedance", words, chart, HEIGHT, legend=curve_legend(chart))]


def exceedance_chart(study: RareOutcome) -> Chart:
    """Return the chart of the first level's empirical curve, the levels' thresholds, and the failure with interval."""
    spans = level_spans(study)
    factor = display_factor(study.margin_unit)
    first = np.sort(factor * study.flown.values[: spans[0].last])
    fraction = 1.0 - np.arange(first.size) / first.size
    finite = np.isfinite(first)
    x, y = first[finite], fraction[finite]
    known = [
        (span.threshold, span.reached) for span in spans if span.threshold is not None and span.reached is not None
    ]
    thresholds, reached = [factor * one for one, _ in known], [other for _, other in known]
    low, high = study.interval
    if study.probability is not None:
        thresholds, reached = [*thresholds, 0.0], [*reached, study.probability]
    before, down = np.append(x[:1], x), np.append(y, y[-1:])  # a probability applies down to the previous sample
    empirical = line(before, down, GREY, width=1.4, steps=True, name="level 1: Monte Carlo")
    levels = line(np.array(thresholds), np.array(reached), BLUE, name="thresholds of levels")
    if low > 0.0:
        interval = line(np.zeros(2), np.array([low, high]), VERMILION, width=2.4, name=f"failure, {PERCENT}")
    else:
        below = marker("v", 6.0, VERMILION)
        interval = marks(np.zeros(1), np.array([high]), below, name=f"failure, below at {PERCENT}")
    smallest = min([high, *reached, 1.0 / first.size] + ([low] if low > 0.0 else []))
    return Chart(
        NO_BOX,
        linear_axis(limits_of(factor * study.flown.values), 5, label=label_with_unit("limit state", study.margin_unit)),
        fine_axis((0.5 * smallest, 1.5), 7),
        title="probability of more",
        curves=[empirical, replace(levels, marker=marker("o", 4.0, BLUE)), interval],
        rules=[shapes.vertical_line(0.0, INK, 1.0, DASHED)],
    )


SAMPLE = marker("o", 2.6, GREY, width=0.0)
FAILURE = marker("o", 2.4, VERMILION, width=0.0)
DESIGN = marker("D", 5.0, "#ffffff", fill=BLUE)
DESIGN_LEGEND = [
    LegendEntry(each, [name]) for each, name in ((SAMPLE, "level 1"), (FAILURE, "failures"), (DESIGN, "design points"))
]


def design_figures(study: RareOutcome) -> list[Figure]:
    """Return figures of samples, failures and design points over pairs of the most influential parameters."""
    pairs = combinations(list(influence(study))[:PAIRED], 2)
    return [
        Figure(
            f"{other} over {one}",
            f"design-{index}",
            f"Samples, failures and design points over {one} and {other}",
            design_chart(study, one, other),
            HEIGHT,
            is_narrow=True,
        )
        for index, (one, other) in enumerate(pairs)
    ]


def design_chart(study: RareOutcome, one: str, other: str) -> Chart:
    """Return the chart of one pair: level 1 in grey, failures in colour, design points with their numbers."""
    units = [study.units.get(name) for name in (one, other)]
    factors = [display_factor(unit) for unit in units]
    x, y = (factor * study.flown.draws[name] for factor, name in zip(factors, (one, other), strict=True))
    count = level_spans(study)[0].last
    failed = study.flown.values >= 0.0
    at = np.array([[factor * entry["draws"][name] for factor, name in zip(factors, (one, other), strict=True)]
                   for entry in study.failures]).reshape(-1, 2)  # fmt: skip
    curves = [
        marks(x[:count], y[:count], SAMPLE),
        marks(x[failed], y[failed], FAILURE),
        marks(at[:, 0], at[:, 1], DESIGN),
    ]
    notes = [
        ChartNote(str(entry["trial"]), (place[0], place[1]), (False, False), (5.0, 4.0), ("left", "baseline"), INK, 8.5)
        for entry, place in zip(study.failures, at.tolist(), strict=True)
    ]
    return Chart(
        NO_BOX,
        linear_axis(
            axis_ends(np.concatenate([x[:count], x[failed], at[:, 0]])), 4, label=label_with_unit(one, units[0])
        ),
        linear_axis(axis_ends(np.concatenate([y[:count], y[failed], at[:, 1]])), 5),
        title=label_with_unit(other, units[1]),
        curves=[curve for curve in curves if curve.x.size],
        notes=notes,
    )


def interval_figures(study: RareOutcome) -> list[Figure]:
    """Return the figure of this study's interval, and of the intervals of Monte Carlo campaigns."""
    rows = equivalents(study)
    words, chart = f"{PERCENT} intervals of the probability", interval_chart(rows, study.probability)
    return [Figure("", "interval", words, chart, 0.8 + 0.5 * len(rows), is_wide=True)]


def interval_chart(rows: Sequence[Equivalent], probability: float | None) -> Chart:
    """Return the chart of intervals, a named lane for each; an interval from 0 ends at the left edge with an arrow."""
    positive = [end for row in rows for end in (row.low, row.high, probability or 0.0) if end > 0.0]
    left = 0.3 * min(positive)
    curves, notes = [], []
    for lane, row in enumerate(rows):
        colour = VERMILION if lane == 0 else GREY
        curves.append(line(np.array([max(row.low, left), row.high]), np.full(2, float(lane)), colour, width=2.6))
        if row.low <= 0.0:
            curves.append(mark(left * 1.02, lane, marker("<", 6.0, colour), beyond=True))
        label = f"{row.label}: {number(row.simulations, 3)} simulations"
        at, align = (0.01, lane - 0.28), ("left", "bottom")
        notes.append(ChartNote(label, at, (True, False), (0.0, 0.0), align, INK, 8.5, backing=BEHIND))
    return Chart(
        NO_BOX,
        fine_axis((left, 2.0 * max(positive)), label=f"probability of failure, {PERCENT} interval"),
        lane_axis([""] * len(rows), (len(rows) - 0.4, -0.8)),
        curves=curves,
        rules=[] if probability is None else [shapes.vertical_line(probability, INK, 1.0, DASHED)],
        notes=notes,
    )
