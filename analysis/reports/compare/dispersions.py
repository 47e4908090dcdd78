"""Miss distances at the end: final values less their targets, with covariance ellipses, and their statistics."""

from __future__ import annotations

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
from ..chart.symbols import mark, marker, marks
from ..common.colours import FAINT, INK, Look
from ..common.panels import PANEL_WIDTH, Panel, far
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
UNEVEN = 4.0  # scales that differ by more are shown a second time, each contender to its own
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


def dispersion_panels(
    ends: Mapping[str, Ends], styles: Mapping[str, Look], unit: str, name: str
) -> tuple[list[Panel], list[Panel]]:
    """Panels to one scale; and, where these differ much, each to its own."""
    reaches = {label: reach_of(points) for label, points in ends.items()}
    maximum = max(reaches.values())
    uneven = maximum > UNEVEN * min(reaches.values())
    numbered = [(i, *item) for i, item in enumerate(ends.items())]
    common = [_panel(label, points, styles[label], maximum, unit, f"{name}-{i}") for i, label, points in numbered]
    own = [
        _panel(label, points, styles[label], reaches[label], unit, f"{name}-own-{i}")
        for i, label, points in numbered
        if uneven
    ]
    return common, own


def select_ends(ends: Ends) -> tuple[np.ndarray, np.ndarray]:
    """Horizontal errors of successful and of failed trials; those that are not finite left out."""
    finite = np.all(np.isfinite(ends.errors), axis=1)
    return ends.errors[finite & ends.success], ends.errors[finite & ~ends.success]


def reach_of(ends: Ends) -> float:
    """How far from the target a contender's panel goes: its successful trials and 3-sigma ellipse, if any."""
    good, bad = select_ends(ends)
    points = good if good.size else bad
    values = [np.abs(points[:, :2]).ravel()]
    if len(good) > 1:
        values.append(np.abs(ellipse(good, SIGMAS[-1])).ravel())
    largest = float(np.max(np.concatenate(values), initial=0.0))
    return 1.08 * largest or 1.0


def _panel(label: str, ends: Ends, style: Look, reach: float, unit: str, name: str) -> Panel:
    factor, displayed = far(np.array([reach])) if unit == "m" else (1.0, unit)
    description = f"Final {ends.variable} of {label} about the target, with covariance ellipses"
    chart_of = partial(dispersion_chart, ends, style.colour, factor, displayed)
    title = f"{ends.axes[1]}, {displayed}"
    chart = _about_target(chart_of, factor * reach, title)
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
    limit = np.array([x_ends[1], y_ends[1]])
    outside = int(np.sum(np.any(np.abs(bad[:, :2]) > limit, axis=1)))
    missing = len(ends.errors) - len(good) - len(bad)
    notes = [f"{outside} failed outside"] if outside else []
    notes += [f"{missing} without an end"] if missing else []
    return _chart(curves, f"{ends.axes[0]}, {unit}", x_ends, y_ends, ", ".join(notes))


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


def _about_target(chart_of: Callable[[Pair, Pair], Chart], reach: float, title: str) -> Chart:
    """Return a chart to scale that contains a square about the target, ``reach`` as displayed; ``title`` above it."""
    square = (-reach, reach)
    return to_scale(chart_of, square, square, POINTS * PANEL_WIDTH, POINTS * HEIGHT, title=title)


def overlaid_ends(ends: Mapping[str, Ends], styles: Mapping[str, Look], unit: str, name: str) -> list[Panel]:
    """Mean and 3-sigma ellipse of each contender about the target; none of a single one."""
    if len(ends) < 2:
        return []
    with_ellipse = [each for each in ends.values() if len(select_ends(each)[0]) > 1] or ends.values()
    reach = max(map(reach_of, with_ellipse))
    factor, displayed = far(np.array([reach])) if unit == "m" else (1.0, unit)
    ellipses, means = [], []
    for label, each in ends.items():
        good, style = factor * select_ends(each)[0], styles[label]
        x, y = ellipse(good, SIGMAS[-1]) if len(good) > 1 else np.full((2, 1), np.nan)
        ellipses.append(line(x, y, style.colour, dashes=style.lengths))  # by index, as the legend hides them
        if len(good) > 1:
            means.append(_mean(good, style.colour))
    first = next(iter(ends.values()))
    what, (across, title) = first.variable, (f"{axis}, {displayed}" for axis in first.axes[:2])
    chart = _about_target(partial(_chart, [*ellipses, *means], across), factor * reach, title)
    description = f"Final {what} about the target: 3-sigma ellipses, {ALL}"
    return [chart_panel(f"final {what}, {ALL}", name, description, chart, HEIGHT, title=title)]
