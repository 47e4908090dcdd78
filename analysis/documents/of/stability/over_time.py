"""Margins over the time of flight: a loop's margins at several operating points, with the required margins."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from ....stability.loops.margin_values import UNLIMITED, UNSTABLE, MarginQuantity
from ....stability.loops.readings import decibels
from ....stability.results.report import LoopReport, StabilityStudy
from ...cell import LegendEntry
from ...chart.axes import linear_axis
from ...chart.lines import line
from ...chart.marks import horizontal_band, horizontal_line
from ...chart.symbols import marker, marks
from ...chart.ticks import axis_ends
from ...common.colours import COLOURS, INK, VERMILION, Look, look
from ...common.panels import PANEL_HEIGHT
from ...common.quantities import number
from ...interactive import charts
from ...interactive.charts import NO_BOX, Chart, Curve
from ...model import Node, Note
from ...pictures import Figure, Figures
from .charts.frequency import FORBIDDEN, WHITE
from .shared import combine_loop_names
from .study_cells import numeral

QUANTITIES = (MarginQuantity.GAIN, MarginQuantity.PHASE, MarginQuantity.MODULUS)
SAME = 1e-3  # relative difference up to which margins share a line
SIZE, LARGE = 4.5, 7.0  # pt, sizes of marks in the figure and at its edges
BEYOND = 1.15  # end of an axis over the largest decisive margin


@dataclass(frozen=True)
class MarginHistory:
    """Loops with equal margins over time; each loop has a report per time (s), ascending.

    For each quantity, ``upper`` contains the nearest margins for increasing gain or lag, and ``lower`` (negative) the
    nearest margins for decreasing gain or lead, NaN if there is none. ``sizes`` are the sizes of the nearer margin, or
    `UNSTABLE` and `UNLIMITED`.
    """

    loops: tuple[tuple[LoopReport, ...], ...]
    times: np.ndarray
    upper: dict[MarginQuantity, np.ndarray]
    lower: dict[MarginQuantity, np.ndarray]
    sizes: dict[MarginQuantity, np.ndarray]


def _sides(loop: LoopReport, quantity: MarginQuantity) -> tuple[float, float]:
    """Return the nearest margin for increasing gain or lag, and the nearest for decreasing gain or lead.

    Both are in the quantity's unit, NaN if there is none.
    """
    if loop.margins.unstable:
        return math.nan, math.nan
    if quantity is MarginQuantity.MODULUS:
        return loop.robust.modulus_margin, math.nan
    if quantity is MarginQuantity.GAIN:
        signed = [float(decibels(crossing.value)) for crossing in loop.classical.gain]
    else:
        signed = [math.degrees(crossing.value) for crossing in loop.classical.phase]
    return (
        min((value for value in signed if value >= 0.0), default=math.nan),
        max((value for value in signed if value < 0.0), default=math.nan),
    )


def margin_histories(report: StabilityStudy) -> list[MarginHistory]:
    """Return the loops studied at several times with the same settings."""
    points = {point.name: point for point in report.points}
    flights: dict[tuple[str, str], list[LoopReport]] = {}
    for loop in report.loops:
        settings = repr(sorted((name, str(value)) for name, value in points[loop.point].settings.items()))
        flights.setdefault((loop.name, settings), []).append(loop)
    histories: list[MarginHistory] = []
    for loops in flights.values():
        ordered = tuple(sorted(loops, key=lambda loop: points[loop.point].time))
        times = np.array([points[loop.point].time for loop in ordered])
        if np.unique(times).size < 2:
            continue
        sizes = {key: np.array([loop.margins.size(key) for loop in ordered]) for key in QUANTITIES}
        sides = {key: np.array([_sides(loop, key) for loop in ordered]) for key in QUANTITIES}
        upper, lower = ({key: pairs[:, side] for key, pairs in sides.items()} for side in (0, 1))
        one = MarginHistory((ordered,), times, upper, lower, sizes)
        same = next((index for index, other in enumerate(histories) if _alike(one, other)), None)
        if same is None:
            histories.append(one)
        else:
            other = histories[same]
            histories[same] = replace(other, loops=(*other.loops, ordered))
    return histories


def _alike(one: MarginHistory, other: MarginHistory) -> bool:
    if not np.array_equal(one.times, other.times) or _requirements(one) != _requirements(other):
        return False
    pairs = [(a[key], b[key]) for key in QUANTITIES for a, b in ((one.upper, other.upper), (one.lower, other.lower))]
    return all(np.allclose(*pair, rtol=SAME, atol=0.0, equal_nan=True) for pair in pairs)


def _requirements(course: MarginHistory) -> set[tuple[MarginQuantity, float]]:
    return {(item.quantity, item.limit) for loops in course.loops for loop in loops for item in loop.requirements}


def course_look(index: int) -> Look:
    """Return the look of the index-th course; vermilion is reserved for limits."""
    return look(index + (index >= COLOURS.index(VERMILION)))


def over_time_chart(histories: Sequence[MarginHistory], quantity: MarginQuantity) -> Chart:
    """Return the chart of one margin of all loops over time, with forbidden values shaded.

    Margins for decreasing gain or lead are negative. The mark of the nearer margin of each loop is filled, the mark of
    the other margin is hollow. A cross at 0 is an unstable loop, a triangle at the top is a loop without a crossover.
    """
    limits = sorted({limit for course in histories for key, limit in _requirements(course) if key is quantity})
    is_below = any(np.any(np.isclose(-course.lower[quantity], course.sizes[quantity])) for course in histories)
    every = np.concatenate([course.sizes[quantity] for course in histories])
    top = BEYOND * max([1e-6, *every[np.isfinite(every)].tolist(), *limits])
    unit = "" if quantity.unit == "1" else quantity.unit
    areas, rules, notes = [], [horizontal_line(0.0, INK, 0.8)], []
    for limit in limits:
        areas.append(horizontal_band(-limit if is_below else 0.0, limit, FORBIDDEN, 1.0))
        rules += [horizontal_line(edge, VERMILION, 1.2) for edge in ((limit, -limit) if is_below else (limit,))]
        words = f"required {number(limit)} {unit}".strip()
        at, colour = (1.0, limit), VERMILION.lower()
        notes.append(charts.ChartNote(words, at, (True, False), (-2.0, -3.0), ("right", "top"), colour, 8.0))
    times = np.concatenate([history.times for history in histories])
    return Chart(
        NO_BOX,
        linear_axis(axis_ends(times), 5, label="time of flight, s"),
        linear_axis((-top if is_below else 0.0, top), 5),
        title=unit or "1",
        curves=[
            replace(curve, name=_names(history))
            for index, history in enumerate(histories)
            for curve in _margin_curves(history, quantity, course_look(index), top)
        ],
        areas=areas,
        rules=rules,
        notes=notes,
    )


def _margin_curves(course: MarginHistory, quantity: MarginQuantity, style: Look, top: float) -> list[Curve]:
    sizes = course.sizes[quantity]
    lines, dots = [], []
    hollow, full = (marker(style.marker, SIZE, style.colour, fill=fill) for fill in (WHITE, style.colour))
    for margins in (course.upper[quantity], course.lower[quantity]):
        if np.any(np.isfinite(margins)):
            joined = line(course.times, margins, style.colour, dashes=style.lengths)
            lines.append(replace(joined, marker=hollow))
        nearer = np.isclose(abs(margins), sizes)
        if np.any(nearer):
            dots.append(marks(course.times[nearer], margins[nearer], full))
    cross, triangle = (
        marker(kind, LARGE, colour, width=1.8) for kind, colour in (("x", VERMILION), ("^", style.colour))
    )
    for kind, height, mark in ((UNSTABLE, 0.0, cross), (UNLIMITED, top, triangle)):
        here = course.times[sizes == kind]
        if here.size:
            dots.append(marks(here, np.full(here.size, height), mark, beyond=True))
    return lines + dots


def over_time_nodes(histories: Sequence[MarginHistory], report: StabilityStudy) -> list[Node]:
    """Return figures of the margins over the time of flight, and the operating points at which they were studied."""
    studied = {loop.point for history in histories for loops in history.loops for loop in loops}
    points = sorted((point for point in report.points if point.name in studied), key=lambda point: point.time)
    times = [part for point in points for part in (", ", f"{point.name} at ", numeral(point.time), " s")]
    return [
        Figures(
            lambda: [_figure(histories, key, f"over-time-{index + 1}") for index, key in enumerate(QUANTITIES)],
            [LegendEntry(course_look(index), [_names(history)]) for index, history in enumerate(histories)],
        ),
        Note([
            "Below 0: lower gain margins, phase leads; the nearer margin of each loop is filled, the other hollow. "
            "Shaded: less than required. Cross at 0: unstable, no margin; triangle at the top: no crossover, margin "
            "unlimited. Each mark is one operating point, linearised there; times between them were not studied; the "
            "table of operating points says for how long each linearisation is valid. Points: ",
            *times[1:],
            ".",
        ]),
    ]  # fmt: skip


def _names(course: MarginHistory) -> str:
    return combine_loop_names([loops[0] for loops in course.loops])


def _figure(histories: Sequence[MarginHistory], quantity: MarginQuantity, name: str) -> Figure:
    minimum = min(size for history in histories for size in history.sizes[quantity].tolist())
    loops = sum(len(history.loops) for history in histories)
    words = f"{quantity.capitalize()} of {loops} loops over the time of flight, minimum "
    infinite = {math.inf: "unlimited", -math.inf: "that of an unstable loop"}
    words += infinite.get(minimum) or number(minimum, 3)
    chart = over_time_chart(histories, quantity)
    return Figure(quantity.capitalize(), name, words, chart, PANEL_HEIGHT, is_narrow=True)
