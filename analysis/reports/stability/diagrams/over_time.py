"""Margins over the time of flight: a loop's margins at several operating points, with the margins that are required."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from ....loops.margin_values import UNLIMITED, UNSTABLE, Quantity
from ....stability.results.loop import LoopReport
from ....stability.results.report import StabilityReport
from ...kit.style import VERMILION, look, plain_ticks
from .limits import LIMIT

QUANTITIES = (Quantity.GAIN, Quantity.PHASE, Quantity.MODULUS)
SAME = 1e-3  # relative: margins that differ by less are one line


@dataclass(frozen=True)
class Course:
    """Loops with the same margins over time: each one's reports, ascending in time (s); ``sizes`` by quantity."""

    loops: tuple[tuple[LoopReport, ...], ...]
    times: np.ndarray
    sizes: dict[Quantity, np.ndarray]


def courses(report: StabilityReport) -> list[Course]:
    """Loops that are studied at several times of the same flight: with the same settings, at different times."""
    points = {point.name: point for point in report.points}
    flights: dict[tuple[str, str], list[LoopReport]] = {}
    for loop in report.loops:
        settings = repr(sorted((name, str(value)) for name, value in points[loop.point].settings.items()))
        flights.setdefault((loop.name, settings), []).append(loop)
    found: list[Course] = []
    for loops in flights.values():
        ordered = tuple(sorted(loops, key=lambda loop: points[loop.point].time))
        times = np.array([points[loop.point].time for loop in ordered])
        if np.unique(times).size < 2:
            continue
        sizes = {key: np.array([loop.margins.size(key) for loop in ordered]) for key in QUANTITIES}
        one = Course((ordered,), times, sizes)
        same = next((index for index, other in enumerate(found) if _alike(one, other)), None)
        if same is None:
            found.append(one)
        else:
            other = found[same]
            found[same] = Course((*other.loops, ordered), other.times, other.sizes)
    return found


def _alike(one: Course, other: Course) -> bool:
    if not np.array_equal(one.times, other.times) or _required(one) != _required(other):
        return False
    return all(np.allclose(one.sizes[key], other.sizes[key], rtol=SAME, atol=0.0) for key in QUANTITIES)


def _required(course: Course) -> set[tuple[Quantity, float]]:
    return {(item.quantity, item.limit) for loops in course.loops for loop in loops for item in loop.requirements}


def draw_over_time(found: Sequence[Course], quantity: Quantity, axes: Axes) -> None:
    """One margin of all loops over time; the least that is required dashed.

    A cross at the bottom is an unstable loop, a triangle at the top one without a crossover; lines join finite margins.
    """
    limits = {limit for course in found for key, limit in _required(course) if key is quantity}
    every = np.concatenate([course.sizes[quantity] for course in found])
    finite = every[np.isfinite(every)]
    top = 1.12 * max([1e-6, *finite.tolist(), *limits])
    for index, course in enumerate(found):
        colour, dashes, marker = look(index)
        sizes = course.sizes[quantity]
        drawn = np.where(np.isfinite(sizes), sizes, np.nan)
        axes.plot(course.times, drawn, color=colour, linestyle=dashes, marker=marker, markersize=4.5)
        at_edge: Any = {"linestyle": "", "clip_on": False, "zorder": 5, "markersize": 7, "markeredgewidth": 1.8}
        for kind, mark, height, edge in ((UNSTABLE, "x", 0.0, VERMILION), (UNLIMITED, "^", top, colour)):
            here = course.times[sizes == kind]
            if here.size:
                axes.plot(here, np.full(here.size, height), **{**at_edge, "marker": mark, "color": edge})
    for limit in sorted(limits):
        axes.axhline(limit, **{**LIMIT, "linewidth": 1.4})
    axes.set_ylim(0.0, top)
    plain_ticks(axes, x=5, y=5)
    unit = "" if quantity.unit == "1" else f", {quantity.unit}"
    axes.set_title(f"{quantity}{unit}", loc="left", fontsize=8.5)
    axes.set_xlabel("time of flight, s")
