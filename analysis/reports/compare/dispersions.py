"""Miss distances at the end: final values less their targets, with covariance ellipses, and their statistics."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from ...campaigns.compare.comparison import Contender
from ...campaigns.verdicts.order_statistics import quantiles
from ..campaign.recorded_names import LETTERS, AxisNames, axes_of, find_vector, variable_of, vectors
from ..chart.axes import linear_axis
from ..chart.equal import Ends as Pair
from ..chart.equal import to_scale
from ..chart.lines import line
from ..chart.marks import note_above
from ..chart.panel import POINTS, chart_panel
from ..chart.symbols import arrow, mark, marker, marks
from ..common.colours import FAINT, INK, Look
from ..common.panels import PANEL_WIDTH, Panel, far
from ..common.quantities import number
from ..interactive.charts import NO_BOX, Chart, Curve
from .recorded import ALL

TARGET = marker("o", 6.0, INK, fill="#ffffff", width=1.3)
UNITS = {"position": "m", "velocity": "m/s"}


@dataclass(frozen=True)
class Target:
    """A vector per trial; ``name`` is the parameter that says so, empty where none does and it is zero."""

    name: str
    values: np.ndarray


@dataclass(frozen=True)
class Ends:
    """Errors at the end of a contender's flights: final less target, trials by elements along ``axes``, SI."""

    signal: str
    variable: str
    target: str
    errors: np.ndarray
    success: np.ndarray
    axes: AxisNames = LETTERS


def target_of(contender: Contender, variable: str) -> Target:
    """The parameter target_VARIABLE of some component, as drawn where it is drawn; zeros where there is none."""
    count = len(contender.trials.trial)
    known = {
        name: value
        for name, value in contender.stored.document.get("targets", {}).get(contender.name, {}).items()
        if variable_of(contender.stored.document, name) == f"target_{variable}"
    }
    for base, elements in vectors(known).items():
        plotted = contender.stored.draws
        columns = [plotted.get(name, np.full(count, known[name])) for name in elements]
        return Target(base, np.stack(columns, axis=1).astype(float))
    return Target("", np.zeros((count, 3)))


def ends_of(contender: Contender, variable: str) -> Ends | None:
    """Final position or velocity less its target; None where the batch does not keep the final values."""
    vector = find_vector(contender.stored.document, contender.trials.final, variable, UNITS[variable])
    if vector is None:
        return None
    target = target_of(contender, variable)
    finals = np.stack([contender.trials.final[name] for name in vector], axis=1)
    signal, axes = vector[0].removesuffix("[1]"), axes_of(contender.stored.document, vector)
    return Ends(signal, variable, target.name, finals - target.values, contender.trials.success, axes)


SIGMAS = (1.0, 2.0, 3.0)
RADII = (0.5, 0.99)  # fractions of the trials that end within the distances shown
BULK, UNEVEN = 0.9, 6.0  # of the trials of the least dispersed contender; of their extent, what the scale is at most
EDGE, ARROW = 0.9, 10.0  # of the way to the edge, from which on an arrow points out; its length, pt
HEIGHT = 3.1  # in


@dataclass(frozen=True)
class Dispersion:
    """Statistics of the ends of one contender, of the successful trials only; SI.

    ``mean`` and ``std`` are of the three elements, ``axes`` the semi-axes of the horizontal 1-sigma
    ellipse (longer first), ``radii`` the horizontal distances from the target within which half and
    99 % of the trials end, and the largest. None where there are too few trials.
    """

    count: int
    mean: list[float] | None
    std: list[float] | None
    axes: list[float] | None
    radii: list[float] | None


def dispersion(ends: Ends) -> Dispersion:
    """Statistics of a contender's ends."""
    good = ends.errors[ends.success & np.all(np.isfinite(ends.errors), axis=1)]
    if not good.size:
        return Dispersion(0, None, None, None, None)
    miss = np.hypot(good[:, 0], good[:, 1])
    radii = [*quantiles(miss, RADII).tolist(), float(miss.max())]
    mean = good.mean(axis=0).tolist()
    if len(good) < 2:
        return Dispersion(len(good), mean, None, None, radii)
    axes = np.sqrt(np.maximum(np.linalg.eigvalsh(covariance(good)), 0.0))[::-1].tolist()
    return Dispersion(len(good), mean, good.std(axis=0, ddof=1).tolist(), axes, radii)


def covariance(good: np.ndarray) -> np.ndarray:
    """Sample covariance of the two horizontal elements."""
    return np.cov(good[:, :2], rowvar=False)


def ellipse(good: np.ndarray, sigma: float) -> np.ndarray:
    """Points of the ``sigma`` ellipse of the horizontal elements, x and y by rows."""
    variances, directions = np.linalg.eigh(covariance(good))
    angle = np.linspace(0.0, 2.0 * np.pi, 73)
    circle = np.sqrt(np.maximum(variances, 0.0))[:, np.newaxis] * np.stack([np.cos(angle), np.sin(angle)])
    return good[:, :2].mean(axis=0)[:, np.newaxis] + sigma * directions @ circle


def dispersion_panels(ends: Mapping[str, Ends], styles: Mapping[str, Look], unit: str, name: str) -> list[Panel]:
    """Panels to one scale."""
    extent = common_extent(ends)
    return [
        _panel(label, points, styles[label], extent, unit, f"{name}-{index}")
        for index, (label, points) in enumerate(ends.items())
    ]


def common_extent(ends: Mapping[str, Ends]) -> float:
    """How far from the target all panels go: as the farthest successful trial or 3-sigma ellipse of a contender, at
    most `UNEVEN` times the distance within which `BULK` of the successful trials of the least dispersed one end.
    """
    extents = [extent_of(each) for each in ends.values()]
    limit = UNEVEN * min(bulk for _, bulk in extents)
    return 1.08 * min([max(extent for extent, _ in extents), *([limit] if limit else [])]) or 1.0


def select_ends(ends: Ends) -> tuple[np.ndarray, np.ndarray]:
    """Horizontal errors of successful and of failed trials; those that are not finite left out."""
    finite = np.all(np.isfinite(ends.errors), axis=1)
    return ends.errors[finite & ends.success], ends.errors[finite & ~ends.success]


def extent_of(ends: Ends) -> tuple[float, float]:
    """How far from the target successful trials and the 3-sigma ellipse go, and how far `BULK` of the trials."""
    good, bad = select_ends(ends)
    away = np.max(np.abs((good if good.size else bad)[:, :2]), axis=1)
    if not away.size:
        return 0.0, 0.0
    around = np.abs(ellipse(good, SIGMAS[-1])).max() if len(good) > 1 else 0.0
    (bulk,) = quantiles(away, (BULK,)).tolist()
    return float(max(away.max(), around)), bulk


def _panel(label: str, ends: Ends, style: Look, extent: float, unit: str, name: str) -> Panel:
    factor, displayed = far(np.array([extent])) if unit == "m" else (1.0, unit)
    description = f"Final {ends.variable} of {label} about the target, with covariance ellipses"
    chart_of = partial(dispersion_chart, ends, style.colour, factor, displayed)
    title = f"{ends.axes[1]}, {displayed}"
    chart = _about_target(chart_of, factor * extent, title)
    return chart_panel(label, name, description, chart, HEIGHT, title=title)


def dispersion_chart(ends: Ends, colour: str, factor: float, unit: str, x_ends: Pair, y_ends: Pair) -> Chart:
    """Return where a contender's trials end about the target, with the ellipses of the successful ones.

    ``factor`` from SI to the displayed ``unit``, in which the ends of the axes are.
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
    """The points, [n, 2], beyond the ends of axes about the target."""
    return points[np.any(np.abs(points) > [x_ends[1], y_ends[1]], axis=1)]


def _arrow_out(outside: np.ndarray, colour: str, x_ends: Pair, y_ends: Pair) -> Curve:
    """An arrow at the edge of the axes in the direction of the farthest point outside."""
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
    """Return a chart to scale that contains a square about the target, ``extent`` as displayed; ``title`` above it."""
    square = (-extent, extent)
    return to_scale(chart_of, square, square, POINTS * PANEL_WIDTH, POINTS * HEIGHT, title=title)


def overlaid_ends(ends: Mapping[str, Ends], styles: Mapping[str, Look], unit: str, name: str) -> list[Panel]:
    """Mean and 3-sigma ellipse of each contender about the target; none of a single one."""
    if len(ends) < 2:
        return []
    with_ellipse = [(label, each) for label, each in ends.items() if len(select_ends(each)[0]) > 1] or ends.items()
    extent = common_extent(dict(with_ellipse))
    factor, displayed = far(np.array([extent])) if unit == "m" else (1.0, unit)
    ellipses, means = [], []
    for label, each in ends.items():
        good, style = factor * select_ends(each)[0], styles[label]
        x, y = ellipse(good, SIGMAS[-1]) if len(good) > 1 else np.full((2, 1), np.nan)
        ellipses.append(line(x, y, style.colour, dashes=style.lengths))  # by index, as the legend hides them
        if len(good) > 1:
            means.append(_mean(good, style.colour))
    first = next(iter(ends.values()))
    what, (across, title) = first.variable, (f"{axis}, {displayed}" for axis in first.axes[:2])
    chart = _about_target(partial(_overlaid_chart, ellipses, means, displayed, across), factor * extent, title)
    description = f"Final {what} about the target: 3-sigma ellipses, {ALL}"
    return [chart_panel(f"final {what}, {ALL}", name, description, chart, HEIGHT, title=title)]


def _overlaid_chart(
    ellipses: Sequence[Curve], means: Sequence[Curve], unit: str, across: str, x_ends: Pair, y_ends: Pair
) -> Chart:
    """Return ellipses about the target, with an arrow to each that leaves the frame."""
    outside = [
        (curve.colour, points)
        for curve in ellipses
        if (points := _outside(np.stack([curve.x, curve.displayed], axis=1), x_ends, y_ends)).size
    ]
    note = ""
    if outside:
        farthest = number(max(float(np.hypot(*points.T).max()) for _, points in outside), 3)
        note = f"{len(outside)} of {len(ellipses)} reach outside, farthest {farthest} {unit}"
    arrows = [_arrow_out(points, colour, x_ends, y_ends) for colour, points in outside]
    return _chart([*ellipses, *means, *arrows], across, x_ends, y_ends, note)
