"""Figures of final miss distances about the target, with covariance ellipses."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from .....campaigns.verdicts.order_statistics import quantiles
from ....chart.axes import linear_axis
from ....chart.equal import Ends as Pair
from ....chart.equal import to_scale
from ....chart.lines import line
from ....chart.marks import note_above
from ....chart.panel import POINTS
from ....chart.symbols import arrow, mark, marker, marks
from ....common.colours import FAINT, INK, Look
from ....common.panels import PANEL_WIDTH, choose_length_unit
from ....common.quantities import number
from ....interactive.charts import NO_BOX, Chart, Curve
from ....pictures import Figure
from .ends import UNITS, Ends, ellipse, select_ends
from .recorded import ALL

TARGET = marker("o", 6.0, INK, fill="#ffffff", width=1.3)
SIGMAS = (1.0, 2.0, 3.0)
BULK, UNEVEN = 0.9, 6.0  # fraction of the least dispersed variant's trials, and the largest scale over their extent
EDGE, ARROW = 0.9, 10.0  # position of an outward arrow, over the distance to the edge, and its length (pt)
HEIGHT = 3.1  # in


def dispersion_figures(ends: Mapping[str, Ends], styles: Mapping[str, Look], name: str) -> list[Figure]:
    """Return a figure for each variant on one scale."""
    extent = common_extent(ends)
    return [
        _figure(label, points, styles[label], extent, f"{name}-{index}")
        for index, (label, points) in enumerate(ends.items())
    ]


def common_extent(ends: Mapping[str, Ends]) -> float:
    """Return the half-width of all figures about the target.

    It encloses the farthest successful trial and 3-sigma ellipse, but is at most `UNEVEN` times the distance within
    which `BULK` of the successful trials of the least dispersed variant end.
    """
    extents = [extent_of(each) for each in ends.values()]
    limit = UNEVEN * min(bulk for _, bulk in extents)
    return 1.08 * min([max(extent for extent, _ in extents), *([limit] if limit else [])]) or 1.0


def extent_of(ends: Ends) -> tuple[float, float]:
    """Return the largest distance of successful trials and their ellipse from the target, and its quantile `BULK`."""
    good, bad = select_ends(ends)
    away = np.max(np.abs((good if good.size else bad)[:, :2]), axis=1)
    if not away.size:
        return 0.0, 0.0
    around = np.abs(ellipse(good, SIGMAS[-1])).max() if len(good) > 1 else 0.0
    (bulk,) = quantiles(away, (BULK,)).tolist()
    return float(max(away.max(), around)), bulk


def _figure(label: str, ends: Ends, style: Look, extent: float, name: str) -> Figure:
    factor, unit = _scale(ends.variable, extent)
    words = f"Final {ends.variable} of {label} about the target, with covariance ellipses"
    chart_of = partial(dispersion_chart, ends, style.colour, factor, unit)
    chart = _about_target(chart_of, factor * extent, f"{ends.axes[1]}, {unit}")
    return Figure(label, name, words, chart, HEIGHT, is_narrow=True, look=style)


def _scale(variable: str, extent: float) -> tuple[float, str]:
    """Return factor and unit to display final errors up to ``extent``."""
    unit = UNITS[variable]
    return choose_length_unit(np.array([extent])) if unit == "m" else (1.0, unit)


def dispersion_chart(ends: Ends, colour: str, factor: float, unit: str, x_ends: Pair, y_ends: Pair) -> Chart:
    """Return the chart of a variant's final errors about the target, with ellipses of the successful trials.

    ``factor`` converts from SI to ``unit``, the unit of the axes.
    """
    good, bad = (factor * errors for errors in select_ends(ends))
    size = max(1.6, min(4.0, 40.0 / max(1, len(bad)) ** 0.5))
    curves = [marks(bad[:, 0], bad[:, 1], marker("x", size, FAINT, width=0.2 * size), opacity=0.6)]
    size = max(0.8, min(2.6, 40.0 / max(1, len(good)) ** 0.5))
    curves.append(marks(good[:, 0], good[:, 1], marker("o", size, colour, width=0.0), opacity=0.65))
    if len(good) > 1:
        for sigma in SIGMAS:
            x, y = ellipse(good, sigma)
            curves.append(line(x, y, INK, width=0.9))
        curves.append(_mean(good, INK))
    failed, successful = (_outside(points[:, :2], x_ends, y_ends) for points in (bad, good))
    outside, notes = np.concatenate([failed, successful]), []
    if outside.size:
        which = f" ({len(failed)} failed)" if successful.size and failed.size else " (failed)" if failed.size else ""
        farthest = number(float(np.hypot(*outside.T).max()), 3)
        notes.append(f"{len(outside)} outside{which}, farthest {farthest} {unit}")
        curves.append(_arrow_out(outside, colour if successful.size else FAINT, x_ends, y_ends))
    missing = len(ends.errors) - len(good) - len(bad)
    notes += [f"{missing} without an end"] if missing else []
    return _chart(curves, f"{ends.axes[0]}, {unit}", x_ends, y_ends, "; ".join(notes))


def _outside(points: np.ndarray, x_ends: Pair, y_ends: Pair) -> np.ndarray:
    """Return the points, [n, 2], outside axes about the target."""
    return points[np.any(np.abs(points) > [x_ends[1], y_ends[1]], axis=1)]


def _arrow_out(outside: np.ndarray, colour: str, x_ends: Pair, y_ends: Pair) -> Curve:
    """Return an arrow at the edge of the axes towards the farthest point outside."""
    x, y = outside[np.argmax(np.hypot(*outside.T))].tolist()
    inward = EDGE / max(abs(x) / x_ends[1], abs(y) / y_ends[1])
    return arrow((inward * x, inward * y), math.atan2(y, x), ARROW, colour)


def _mean(good: np.ndarray, colour: str) -> Curve:
    x, y = good[:, :2].mean(axis=0)
    return mark(x, y, marker("+", 8.0, colour, width=1.4))


def _chart(curves: Sequence[Curve], label: str, x_ends: Pair, y_ends: Pair, note: str = "") -> Chart:
    return Chart(
        NO_BOX,
        linear_axis(x_ends, 4, label=label),
        linear_axis(y_ends, 4),
        curves=[*curves, mark(0.0, 0.0, TARGET)],
        notes=[note_above(note)] if note else [],
    )


def _about_target(chart_of: Callable[[Pair, Pair], Chart], extent: float, title: str) -> Chart:
    """Return a chart with equal scales that encloses a square about the target; ``extent`` is as displayed."""
    square = (-extent, extent)
    return replace(to_scale(chart_of, square, square, POINTS * PANEL_WIDTH, POINTS * HEIGHT, title=title), title=title)


def overlaid_ends(ends: Mapping[str, Ends], styles: Mapping[str, Look], name: str) -> list[Figure]:
    """Return mean and 3-sigma ellipse of each variant about the target; none for a single variant."""
    if len(ends) < 2:
        return []
    with_ellipse = [(label, each) for label, each in ends.items() if len(select_ends(each)[0]) > 1] or ends.items()
    extent = common_extent(dict(with_ellipse))
    first = next(iter(ends.values()))
    factor, unit = _scale(first.variable, extent)
    ellipses, means = [], []
    for label, each in ends.items():
        good, style = factor * select_ends(each)[0], styles[label]
        x, y = ellipse(good, SIGMAS[-1]) if len(good) > 1 else np.full((2, 1), np.nan)
        ellipses.append(line(x, y, style.colour, dashes=style.lengths))  # one per legend entry, which hides it by index
        if len(good) > 1:
            means.append(_mean(good, style.colour))
    across, title = (f"{axis}, {unit}" for axis in first.axes[:2])
    chart = _about_target(partial(_overlaid_chart, ellipses, means, unit, across), factor * extent, title)
    words = f"Final {first.variable} about the target: 3-sigma ellipses, {ALL}"
    return [Figure(f"final {first.variable}, {ALL}", name, words, chart, HEIGHT, is_narrow=True)]


def _overlaid_chart(
    ellipses: Sequence[Curve], means: Sequence[Curve], unit: str, across: str, x_ends: Pair, y_ends: Pair
) -> Chart:
    """Return the chart of ellipses about the target, with an arrow towards each ellipse that exceeds the axes."""
    outside = [
        (curve.colour, points)
        for curve in ellipses
        if (points := _outside(np.stack([curve.x, curve.displayed], axis=1), x_ends, y_ends)).size
    ]
    note = ""
    if outside:
        farthest = number(max(float(np.hypot(*points.T).max()) for _, points in outside), 3)
        note = f"{len(outside)} of {len(ellipses)} outside, to {farthest} {unit}"
    arrows = [_arrow_out(points, colour, x_ends, y_ends) for colour, points in outside]
    return _chart([*ellipses, *means, *arrows], across, x_ends, y_ends, note)
