"""The pages of planned trajectories: a hover transfer, and the propellant bound of a landing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..design.trajectories.landing_study import LandingStudy
from ..design.trajectories.path import PlannedPath
from ..design.transfers.hover_study import Curve, HoverStudy
from ..design.transfers.programme import Programme
from .chart.axes import linear_axis
from .chart.equal import Ends, to_scale
from .chart.lines import line
from .chart.panel import POINTS, chart_panel, wide_figure
from .chart.symbols import arrow, mark, marker
from .chart.ticks import axis_ends
from .common.colours import FAINT, INK, Look, look
from .common.page import write_page
from .common.panels import HALF_WIDTH, Panel, far, swatch
from .common.quantities import number
from .interactive import charts
from .interactive.charts import NO_BOX, Axis, Chart, Drawing, Note
from .programme_sketch import sketch_chart

OTHERS = ("finite switches", "turn in free fall")
NAMES = ("simplified programme", "true optimum", "point-mass bound")


def write_hover_page(study: HoverStudy, path: Path) -> None:
    """Write one self-contained HTML page; the same study gives the same bytes. It needs the study's curves."""
    assert study.durations is not None
    assert study.distances is not None
    plans = zip(NAMES, (study.path, study.optimum, study.bound), strict=True)
    series = [Series(name, plan, look(index)) for index, (name, plan) in enumerate(plans) if plan is not None]
    point = Point(NAMES[0], study.programme.duration, study.programme.propellant_fraction, look(0))
    compared = [Point(one.name, one.path.duration, one.path.propellant_fraction, one.look) for one in series[1:]]
    here = Point(NAMES[0], study.transfer.distance, point.propellant, look(0))
    sketch = sketch_chart(study.programme)
    displayed = [np.stack([*one.path.position.T, np.append(one.path.pitch, one.path.pitch[-1])]) for one in series]
    write_page(
        path,
        Path(__file__).with_name("hover_transfer.html"),
        title="Hover transfer",
        study=study,
        programme=study.programme,
        degrees=math.degrees,
        times=list(zip(("t2", "t5", "w", "tp", "t7"), study.programme.times, strict=True)),
        looks=[(swatch(one.look), one.name) for one in series],
        rows=[(swatch(one.look), one.name, one.path) for one in series],
        others=[(name, plan) for name, plan in zip(OTHERS, (study.finite, study.free_fall), strict=True) if plan],
        missing=[name for name, plan in zip(NAMES[1:], (study.optimum, study.bound), strict=True) if plan is None],
        sketch=wide_figure("programme", _sketch_words(study.programme), sketch, SKETCH, title=sketch.title),
        track=[path_panel(series, displayed, ("along", "up"))],
        over_time=time_panels(series, "Pitch from the horizontal, deg"),
        curves=[
            curve_panel("Propellant over t7", "durations", study.durations, "t7, s", [point, *compared]),
            curve_panel("Least propellant over distance", "distances", study.distances, "distance, m", [here]),
        ],
    )


def write_landing_page(study: LandingStudy, path: Path) -> None:
    """Write one self-contained HTML page; the same study gives the same bytes."""
    series = [Series("bound", study.bound, look(0))]
    radius = study.landing.radius
    x, y = study.bound.position[:, 0], study.bound.position[:, 1] + radius
    central = np.arctan2(x, y)
    turned = study.bound.pitch + (central[1:] + central[:-1]) / 2.0  # from the local horizontal
    displayed = np.stack([radius * central, np.hypot(x, y) - radius, np.append(turned, turned[-1])])
    write_page(
        path,
        Path(__file__).with_name("landing_bound.html"),
        title="Bound of braking and landing",
        study=study,
        direct=None if study.direct is None else study.direct.propellant_fraction * study.vehicle.mass,
        climb=math.degrees(study.landing.climb),
        burns=study.bound.burns(),
        track=path_widths(series, [displayed], ("range from the site", "altitude")),
        over_time=time_panels(series, "Angle of thrust above the site's horizontal, deg"),
    )


LOWEST, HIGHEST = 3.0, 6.5  # in, of a path to one scale
LOW = 3.8  # in, of one to two
SKETCH = 3.4  # in
ARROWS = 14  # along a path
ARROW = 0.8  # in, at full throttle
MARK = 6.0  # pt
MARGINS = (0.14, 0.08)  # of the ranges of a path, at the ends of the axes


class Series(NamedTuple):
    """A plan with its name and its look."""

    name: str
    path: PlannedPath
    look: Look


class Point(NamedTuple):
    """One plan among those of a curve: where it lies, its propellant fraction, its look."""

    name: str
    at: float
    propellant: float
    look: Look


def time_panels(series: Sequence[Series], pitch: str) -> list[Panel]:
    """Return pitch, called so, and throttle against time."""
    words = "; ".join(f"{one.name} {number(one.path.duration)} s" for one in series)
    label, description = "Throttle, share of the largest thrust", f"Throttle over time: {words}"
    return [
        chart_panel(pitch, "pitch", f"{pitch} over time: {words}", pitch_chart(series), width=HALF_WIDTH),
        chart_panel(label, "throttle", description, throttle_chart(series), width=HALF_WIDTH),
    ]


def pitch_chart(series: Sequence[Series]) -> Chart:
    """Return the angle of thrust of each plan."""
    curves = [
        line(one.path.middle, np.degrees(one.path.pitch), one.look.colour, dashes=one.look.lengths, name=one.name,
             unit="deg")
        for one in series
    ]  # fmt: skip
    ends = axis_ends(np.concatenate([curve.displayed for curve in curves]))
    return Chart(NO_BOX, _time_axis(series), linear_axis(ends, 5, label="deg"), curves=curves)


def throttle_chart(series: Sequence[Series]) -> Chart:
    """Return the throttle of each plan, which holds over an interval."""
    curves = [
        line(one.path.time, np.append(one.path.throttle, one.path.throttle[-1]), one.look.colour,
             dashes=one.look.lengths, name=one.name, steps=True)
        for one in series
    ]  # fmt: skip
    return Chart(NO_BOX, _time_axis(series), linear_axis((-0.04, 1.08), 5), curves=curves)


def _time_axis(series: Sequence[Series]) -> Axis:
    return linear_axis((0.0, 1.01 * max(one.path.duration for one in series)), 6, label="time, s")


def curve_panel(label: str, name: str, curve: Curve, quantity: str, points: Sequence[Point]) -> Panel:
    """Return propellant over one quantity, and where the plans lie."""
    known = curve.propellant[np.isfinite(curve.propellant)]
    words = f"{label}: {number(float(known.min()))} to {number(float(known.max()))}"
    return chart_panel(label, name, words, curve_chart(curve, quantity, points), width=HALF_WIDTH)


def curve_chart(curve: Curve, quantity: str, points: Sequence[Point]) -> Chart:
    """Return propellant over one quantity, with a mark for each plan."""
    abscissas = np.append(curve.at, [point.at for point in points])
    ordinates = np.append(curve.propellant, [point.propellant for point in points])
    marks = [mark(one.at, one.propellant, marker(one.look.marker, MARK, one.look.colour)) for one in points]
    return Chart(
        NO_BOX,
        linear_axis(axis_ends(abscissas), 6, label=quantity),
        linear_axis(axis_ends(ordinates), 5, label="propellant fraction"),
        curves=[line(curve.at, curve.propellant, INK), *marks],
    )


def path_panel(series: Sequence[Series], shown: Sequence[np.ndarray], names: tuple[str, str]) -> Panel:
    """Return the paths to one scale; ``shown`` are positions and thrust angles in what is drawn, a row each: along (m),
    up (m), angle (rad). Arrows are thrust along the first one.
    """
    spans = [max(float(np.ptp(rows[axis])) for rows in shown) for axis in (0, 1)]
    upright = min(max(LOWEST, HALF_WIDTH * spans[1] / max(spans[0], 1.0)), HIGHEST)
    chart = path_chart(series, shown, names, "one scale", 5)

    def chart_of(x: Ends, y: Ends) -> Chart:
        abscissa, ordinate = (linear_axis(ends, 5, label=axis.label) for ends, axis in ((x, chart.x), (y, chart.y)))
        return replace(chart, x=abscissa, y=ordinate)

    scaled = to_scale(chart_of, chart.x.ends, chart.y.ends, POINTS * HALF_WIDTH, POINTS * upright)
    return chart_panel("Path", "path", _path_words(series), scaled, upright, HALF_WIDTH)


def path_widths(series: Sequence[Series], shown: Sequence[np.ndarray], names: tuple[str, str]) -> Drawing:
    """Return the same, each axis to its own scale, as wide as the page."""
    chart = path_chart(series, shown, names, "different scales", 7)
    return wide_figure("path", _path_words(series), chart, LOW)


def _sketch_words(programme: Programme) -> str:
    burns = " and ".join(f"{number(begin, 4)} to {number(end, 4)} s" for begin, end in programme.burns)
    return f"Tilt of thrust of the {programme.kind} programme over time, full thrust {burns}"


def _path_words(series: Sequence[Series]) -> str:
    return f"Path of {', '.join(one.name for one in series)}, with thrust as arrows"


def path_chart(
    series: Sequence[Series], shown: Sequence[np.ndarray], names: tuple[str, str], scaled: str, intervals: int
) -> Chart:
    """Return the paths as `path_panel` has them, over time; the dot is the end of the first, along which arrows are."""
    scales = [far(np.concatenate([rows[axis] for rows in shown])) for axis in (0, 1)]
    factors = (scales[0][0], scales[1][0])
    paths = [(factors[0] * rows[0], factors[1] * rows[1]) for rows in shown]
    curves = [
        replace(line(*path, one.look.colour, dashes=one.look.lengths, name=one.name), time=one.path.time)
        for one, path in zip(series, paths, strict=True)
    ]
    ends = [axis_ends(np.concatenate([path[axis] for path in paths]), MARGINS[axis]) for axis in (0, 1)]
    texts = [f"{name}, {unit}" for name, (_, unit) in zip(names, scales, strict=True)]
    end = mark(float(paths[0][0][-1]), float(paths[0][1][-1]), marker("o", MARK, INK))
    about = Note(f"axes to {scaled}", (1.0, 1.0), (True, True), (0.0, 4.0), ("right", "bottom"), FAINT, 8.0)
    return Chart(
        NO_BOX,
        linear_axis(ends[0], intervals, label=texts[0]),
        linear_axis(ends[1], 6, label=texts[1]),
        curves=[*curves, end, *_arrows(series[0].path, shown[0], factors)],
        notes=[about],
    )


def _arrows(path: PlannedPath, rows: np.ndarray, factors: tuple[float, float]) -> list[charts.Curve]:
    """Thrust at even times, its angle as it is whatever the scales; an engine at its least has a short arrow."""
    times = (np.arange(ARROWS) + 0.5) * path.duration / ARROWS
    interval = np.minimum(np.searchsorted(path.time, times, side="right") - 1, path.throttle.size - 1)
    angles, throttles = rows[2][interval], np.maximum(path.throttle[interval], 0.25)
    x, y = (np.interp(times, path.time, factor * row) for factor, row in zip(factors, rows[:2], strict=True))
    return [
        arrow((x[row], y[row]), float(angles[row]), POINTS * ARROW * float(throttles[row]), FAINT)
        for row in np.flatnonzero(np.isfinite(angles))
    ]
