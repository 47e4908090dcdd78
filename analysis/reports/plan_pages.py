"""The pages of planned trajectories: a hover transfer, and the propellant bound of a landing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..design.trajectories.landing_study import LandingStudy
from ..design.trajectories.path import PlannedPath
from ..design.transfers.hover_study import Curve, HoverStudy
from .common.page import write_page
from .common.panels import HALF_WIDTH, Panel, Widths, both_widths, far, is_slim, panel, swatch
from .common.quantities import number
from .common.style import FAINT, INK, LineStyle, Look, look, plain_ticks

OTHERS = ("finite switches", "turn in free fall")
NAMES = ("simplified programme", "true optimum", "point-mass bound")


def write_hover_page(study: HoverStudy, path: Path) -> None:
    """Write one self-contained HTML page; the same study gives the same bytes. It needs the study's curves."""
    assert study.durations is not None
    assert study.distances is not None
    plans = zip(NAMES, (study.path, study.optimum, study.bound), strict=True)
    series = [Series(name, plan, look(index)) for index, (name, plan) in enumerate(plans) if plan is not None]
    own = Point(NAMES[0], study.programme.duration, study.programme.propellant_fraction, look(0))
    compared = [Point(one.name, one.path.duration, one.path.propellant_fraction, one.look) for one in series[1:]]
    here = Point(NAMES[0], study.transfer.distance, own.propellant, look(0))
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
        track=[path_panel(series, displayed, ("along", "up"))],
        over_time=time_panels(series, "Pitch from the horizontal, deg"),
        curves=[
            curve_panel("Propellant over t7", "durations", study.durations, "t7, s", [own, *compared]),
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
ARROWS = 14  # along a path
ARROW = 0.8  # in, at full throttle


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
    """Pitch, called so, and throttle against time."""
    words = "; ".join(f"{one.name} {number(one.path.duration)} s" for one in series)
    label, description = "Throttle, share of the largest thrust", f"Throttle over time: {words}"
    draw = partial(_draw_throttle, series=series)
    return [
        panel(pitch, "pitch", f"{pitch} over time: {words}", partial(_draw_pitch, series=series), width=HALF_WIDTH),
        panel(label, "throttle", description, draw, width=HALF_WIDTH),
    ]


def curve_panel(label: str, name: str, curve: Curve, quantity: str, points: Sequence[Point]) -> Panel:
    """Propellant over one quantity, and where the plans lie."""

    def draw(axes: Axes) -> None:
        axes.plot(curve.at, curve.propellant, color=INK)
        for point in points:
            axes.plot(point.at, point.propellant, linestyle="", marker=point.look.marker, color=point.look.colour)
        axes.set_xlabel(quantity)
        axes.set_ylabel("propellant fraction")
        plain_ticks(axes, x=6, y=5)

    known = curve.propellant[np.isfinite(curve.propellant)]
    words = f"{label}: {number(float(known.min()))} to {number(float(known.max()))}"
    return panel(label, name, words, draw, width=HALF_WIDTH)


def path_panel(series: Sequence[Series], shown: Sequence[np.ndarray], names: tuple[str, str]) -> Panel:
    """The paths to one scale; ``shown`` are places and thrust angles in what is drawn, a row each: along (m), up (m),
    angle (rad). Arrows are thrust along the first one.
    """
    spans = [max(float(np.ptp(rows[axis])) for rows in shown) for axis in (0, 1)]
    upright = min(max(LOWEST, HALF_WIDTH * spans[1] / max(spans[0], 1.0)), HIGHEST)

    def draw(axes: Axes) -> None:
        _draw_paths(axes, series, shown, names, "one scale")
        axes.set_aspect("equal", adjustable="datalim")

    return panel("Path", "path", _path_words(series), draw, upright, HALF_WIDTH)


def path_widths(series: Sequence[Series], shown: Sequence[np.ndarray], names: tuple[str, str]) -> Widths:
    """Likewise, each axis to its own scale, as wide as the page."""

    def draw(figure: Figure) -> None:
        _draw_paths(figure.subplots(), series, shown, names, "different scales", 5 if is_slim(figure) else 7)

    return both_widths("path", _path_words(series), draw, LOW)


def _path_words(series: Sequence[Series]) -> str:
    return f"Path of {', '.join(one.name for one in series)}, with thrust as arrows"


def _draw_paths(
    axes: Axes,
    series: Sequence[Series],
    shown: Sequence[np.ndarray],
    names: tuple[str, str],
    scaled: str,
    intervals: int = 5,
) -> None:
    scales = [far(np.concatenate([rows[axis] for rows in shown])) for axis in (0, 1)]
    for one, rows in zip(series, shown, strict=True):
        along, up = scales[0][0] * rows[0], scales[1][0] * rows[1]
        axes.plot(along, up, color=one.look.colour, linestyle=one.look.dashes)
    axes.plot(scales[0][0] * shown[0][0, -1], scales[1][0] * shown[0][1, -1], "o", markersize=6, color=INK)
    _draw_arrows(axes, series[0], shown[0], (scales[0][0], scales[1][0]))
    axes.set_xlabel(f"{names[0]}, {scales[0][1]}")
    axes.set_ylabel(f"{names[1]}, {scales[1][1]}")
    axes.margins(0.14, 0.08)
    plain_ticks(axes, x=intervals, y=6)
    axes.set_title(f"axes to {scaled}", loc="right", fontsize=8.0, color=FAINT)


def _draw_arrows(axes: Axes, one: Series, rows: np.ndarray, scale: tuple[float, float]) -> None:
    """Thrust at even times, its angle as it is whatever the scales; an engine at its least has a short arrow."""
    path = one.path
    times = (np.arange(ARROWS) + 0.5) * path.duration / ARROWS
    interval = np.minimum(np.searchsorted(path.time, times, side="right") - 1, path.throttle.size - 1)
    angle, throttle = rows[2][interval], path.throttle[interval]
    burning = np.isfinite(angle)
    at = [np.interp(times, path.time, factor * row)[burning] for factor, row in zip(scale, rows[:2], strict=True)]
    length = np.maximum(throttle, 0.25)[burning]
    axes.quiver(
        *at, length * np.cos(angle[burning]), length * np.sin(angle[burning]), angles="uv", units="inches",
        scale_units="inches", scale=1.0 / ARROW, width=0.018, headwidth=4.5, headlength=5.5, color=FAINT, zorder=3,
    )  # fmt: skip


def _draw_pitch(axes: Axes, series: Sequence[Series]) -> None:
    for one in series:
        axes.plot(one.path.middle, np.degrees(one.path.pitch), color=one.look.colour, linestyle=one.look.dashes)
    axes.set_ylabel("deg")
    _finish(axes, series)


def _draw_throttle(axes: Axes, series: Sequence[Series]) -> None:
    for one in series:
        style: LineStyle = {"color": one.look.colour, "linestyle": one.look.dashes, "linewidth": 1.3}
        axes.stairs(one.path.throttle, one.path.time, baseline=None, **style)
    axes.set_ylim(-0.04, 1.08)
    _finish(axes, series)


def _finish(axes: Axes, series: Sequence[Series]) -> None:
    axes.set_xlabel("time, s")
    longest = max(one.path.duration for one in series)
    axes.set_xlim(0.0, longest * 1.01 if math.isfinite(longest) else None)
    plain_ticks(axes, x=6, y=5)
