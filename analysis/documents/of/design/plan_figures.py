"""Figures of planned trajectories: path, attitude and throttle over time, propellant over duration and distance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ....design.trajectories.landing_study import LandingStudy
from ....design.trajectories.path import PlannedPath
from ....design.transfers.hover_study import HoverStudy, PropellantCurve
from ...chart.axes import linear_axis
from ...chart.equal import Ends, to_scale
from ...chart.lines import line
from ...chart.symbols import arrow, mark, marker
from ...chart.ticks import axis_ends
from ...common.colours import FAINT, INK, Look, look
from ...common.panels import HALF_WIDTH, PANEL_HEIGHT, choose_length_unit
from ...common.quantities import number
from ...interactive import charts
from ...interactive.charts import NO_BOX, Axis, Chart, ChartNote
from ...pictures import Figure

POINTS = 72.0  # points per inch
NAMES = ("simplified programme", "true optimum", "point-mass bound")
LOWEST, HIGHEST = 3.0, 6.5  # in, least and largest height of a path with equal scales
LOW = 3.8  # in, height of a path with different scales
ARROWS = 14  # along a path
ARROW = 0.8  # in, at full throttle
MARK = 6.0  # pt
MARGINS = (0.14, 0.08)  # margins at the ends of the axes, over the ranges of a path


class Series(NamedTuple):
    """A plan with its name and its look."""

    name: str
    path: PlannedPath
    look: Look


class PlanPoint(NamedTuple):
    """A plan marked on a curve: abscissa, propellant fraction, look."""

    at: float
    propellant: float
    look: Look


def plan_series(study: HoverStudy) -> list[Series]:
    """Return the computed plans of a transfer; the first is the programme."""
    plans = zip(NAMES, (study.path, study.optimum, study.bound), strict=True)
    return [Series(name, plan, look(index)) for index, (name, plan) in enumerate(plans) if plan is not None]


def bound_series(study: LandingStudy) -> list[Series]:
    """Return the bound of a landing as the only plan."""
    return [Series("bound", study.bound, look(0))]


def time_figures(series: Sequence[Series], pitch: str) -> list[Figure]:
    """Return figures of the thrust angle, named ``pitch``, and of the throttle over time."""
    words = "; ".join(f"{one.name} {number(one.path.duration)} s" for one in series)
    throttle = "Throttle, fraction of the largest thrust"
    return [
        Figure(pitch, "pitch", f"{pitch} over time: {words}", pitch_chart(series), PANEL_HEIGHT),
        Figure(throttle, "throttle", f"Throttle over time: {words}", throttle_chart(series), PANEL_HEIGHT),
    ]


def pitch_chart(series: Sequence[Series]) -> Chart:
    """Return the chart of the thrust angle (deg) of each plan over time (s)."""
    curves = [
        line(one.path.middle, np.degrees(one.path.pitch), one.look.colour, dashes=one.look.lengths, name=one.name,
             unit="deg")
        for one in series
    ]  # fmt: skip
    ends = axis_ends(np.concatenate([curve.displayed for curve in curves]))
    return Chart(NO_BOX, _time_axis(series), linear_axis(ends, 5, label="deg"), curves=curves)


def throttle_chart(series: Sequence[Series]) -> Chart:
    """Return the chart of the throttle of each plan over time (s), constant within an interval."""
    curves = [
        line(one.path.time, np.append(one.path.throttle, one.path.throttle[-1]), one.look.colour,
             dashes=one.look.lengths, name=one.name, steps=True)
        for one in series
    ]  # fmt: skip
    return Chart(NO_BOX, _time_axis(series), linear_axis((-0.04, 1.08), 5), curves=curves)


def _time_axis(series: Sequence[Series]) -> Axis:
    return linear_axis((0.0, 1.01 * max(one.path.duration for one in series)), 6, label="time, s")


def curve_figures(study: HoverStudy, series: Sequence[Series]) -> list[Figure]:
    """Return figures of propellant over duration and over distance, with a mark for each plan. Raises `PlanError`."""
    complete = study.with_curves()
    assert complete.durations is not None
    assert complete.distances is not None
    points = [PlanPoint(one.path.duration, one.path.propellant_fraction, one.look) for one in series]
    points[0] = points[0]._replace(propellant=study.programme.propellant_fraction)
    here = points[0]._replace(at=study.transfer.distance)
    return [
        _curve_figure("Propellant over t7", "durations", complete.durations, "t7, s", points),
        _curve_figure("Least propellant over distance", "distances", complete.distances, "distance, m", [here]),
    ]


def _curve_figure(label: str, name: str, curve: PropellantCurve, quantity: str, points: Sequence[PlanPoint]) -> Figure:
    known = curve.propellant[np.isfinite(curve.propellant)]
    words = f"{label}: {number(float(known.min()))} to {number(float(known.max()))}"
    return Figure(label, name, words, curve_chart(curve, quantity, points), PANEL_HEIGHT)


def curve_chart(curve: PropellantCurve, quantity: str, points: Sequence[PlanPoint]) -> Chart:
    """Return the chart of propellant over one quantity, with a mark for each plan."""
    abscissas = np.append(curve.at, [point.at for point in points])
    ordinates = np.append(curve.propellant, [point.propellant for point in points])
    marks = [mark(one.at, one.propellant, marker(one.look.marker, MARK, one.look.colour)) for one in points]
    return Chart(
        NO_BOX,
        linear_axis(axis_ends(abscissas), 6, label=quantity),
        linear_axis(axis_ends(ordinates), 5, label="propellant fraction"),
        curves=[line(curve.at, curve.propellant, INK), *marks],
    )


def path_figure(series: Sequence[Series]) -> list[Figure]:
    """Return the figure of the paths, height over distance on equal scales, with thrust arrows along the first path."""
    rows = [np.stack([*one.path.position.T, np.append(one.path.pitch, one.path.pitch[-1])]) for one in series]
    spans = [max(float(np.ptp(each[axis])) for each in rows) for axis in (0, 1)]
    upright = min(max(LOWEST, HALF_WIDTH * spans[1] / max(spans[0], 1.0)), HIGHEST)
    chart = path_chart(series, rows, ("along", "up"), "one scale", 5)

    def chart_of(x: Ends, y: Ends) -> Chart:
        abscissa, ordinate = (linear_axis(ends, 5, label=axis.label) for ends, axis in ((x, chart.x), (y, chart.y)))
        return replace(chart, x=abscissa, y=ordinate)

    scaled = to_scale(chart_of, chart.x.ends, chart.y.ends, POINTS * HALF_WIDTH, POINTS * upright)
    return [Figure("Path", "path", _path_words(series), scaled, upright)]


def bound_figure(study: LandingStudy, series: Sequence[Series]) -> list[Figure]:
    """Return the figure of a landing's altitude over range, each axis with a separate scale, as wide as the page."""
    path, radius = study.bound, study.landing.radius
    x, y = path.position[:, 0], path.position[:, 1] + radius
    central = np.arctan2(x, y)
    pitch = path.pitch + (central[1:] + central[:-1]) / 2.0  # relative to the local horizontal
    rows = np.stack([radius * central, np.hypot(x, y) - radius, np.append(pitch, pitch[-1])])
    chart = path_chart(series, [rows], ("range from the site", "altitude"), "different scales", 7)
    return [Figure("Path", "path", _path_words(series), chart, LOW, is_wide=True)]


def _path_words(series: Sequence[Series]) -> str:
    return f"Path of {', '.join(one.name for one in series)}, with thrust as arrows"


def path_chart(
    series: Sequence[Series], shown: Sequence[np.ndarray], names: tuple[str, str], scaled: str, intervals: int
) -> Chart:
    """Return the chart of the paths; a dot marks the end of the first, along which thrust arrows are drawn.

    ``shown`` are positions and thrust angles of the drawn paths, a row each: abscissa and ordinate (m), angle (rad).
    """
    scales = [choose_length_unit(np.concatenate([rows[axis] for rows in shown])) for axis in (0, 1)]
    factors = (scales[0][0], scales[1][0])
    paths = [(factors[0] * rows[0], factors[1] * rows[1]) for rows in shown]
    curves = [
        replace(line(*path, one.look.colour, dashes=one.look.lengths, name=one.name), time=one.path.time)
        for one, path in zip(series, paths, strict=True)
    ]
    ends = [axis_ends(np.concatenate([path[axis] for path in paths]), MARGINS[axis]) for axis in (0, 1)]
    texts = [f"{name}, {unit}" for name, (_, unit) in zip(names, scales, strict=True)]
    end = mark(float(paths[0][0][-1]), float(paths[0][1][-1]), marker("o", MARK, INK))
    about = ChartNote(f"axes to {scaled}", (1.0, 1.0), (True, True), (0.0, 4.0), ("right", "bottom"), FAINT, 8.0)
    return Chart(
        NO_BOX,
        linear_axis(ends[0], intervals, label=texts[0]),
        linear_axis(ends[1], 6, label=texts[1]),
        curves=[*curves, end, *_arrows(series[0].path, shown[0], factors)],
        notes=[about],
    )


def _arrows(path: PlannedPath, rows: np.ndarray, factors: tuple[float, float]) -> list[charts.Curve]:
    """Return thrust arrows at equal intervals of time, at true angles on any scale.

    Lengths are proportional to the throttle, with a minimum that keeps arrows at low throttle visible.
    """
    times = (np.arange(ARROWS) + 0.5) * path.duration / ARROWS
    interval = np.minimum(np.searchsorted(path.time, times, side="right") - 1, path.throttle.size - 1)
    angles, throttles = rows[2][interval], np.maximum(path.throttle[interval], 0.25)
    x, y = (np.interp(times, path.time, factor * row) for factor, row in zip(factors, rows[:2], strict=True))
    return [
        arrow((x[row], y[row]), float(angles[row]), POINTS * ARROW * float(throttles[row]), FAINT)
        for row in np.flatnonzero(np.isfinite(angles))
    ]
