"""Pictures of the systems' pages, from one simulation each: `python -m docs.figures.system_figures`."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from perilune.analysis.documents.common.colours import FAINT, look
from perilune.analysis.documents.common.style import house_style, new_figure, plain_ticks
from perilune.analysis.runtime.flight.results import FlightResult
from perilune.analysis.verbs.run import simulate
from perilune.common.process import exit_process

from .pictures import IMAGES, write_picture

Curve = tuple[np.ndarray, np.ndarray]
POINTS = 400  # of a curve


@dataclass(frozen=True)
class Panel:
    """Axes with curves by label, each computed from a result; ``band`` are limits drawn as dashed lines."""

    xlabel: str
    ylabel: str
    curves: Mapping[str, Callable[[FlightResult], Curve]]
    band: Sequence[float] = ()


@dataclass(frozen=True)
class SystemPicture:
    """Panels of a system's picture, row by row, and the options of its simulation."""

    panels: Sequence[Panel]
    options: Mapping[str, Any] = field(default_factory=dict)
    rows: int = 1


def over_time(signal: str, factor: float = 1.0, less: str | None = None) -> Callable[[FlightResult], Curve]:
    """Return a curve of a signal over time, minus the signal ``less`` if stated, multiplied by ``factor``."""

    def curve(flight: FlightResult) -> Curve:
        values = flight[signal] if less is None else flight[signal] - flight[less]
        return flight.time, factor * values

    return curve


def before_last(signal: str, factor: float = 1.0) -> Callable[[FlightResult], Curve]:
    """Return a curve of a command over time, multiplied by ``factor``, without the last sample, which has no effect."""
    return lambda flight: (flight.time[:-1], factor * flight[signal][:-1])


def after_first(signal: str) -> Callable[[FlightResult], Curve]:
    """Return a curve over time of a signal that refers to the last step, without the start, which has none."""
    return lambda flight: (flight.time[1:], flight[signal][1:])


def curve_over_signal(x: str, y: str, factor: float = 1e-3) -> Callable[[FlightResult], Curve]:
    """Return a curve of one signal over another, both multiplied by ``factor``."""
    return lambda flight: (factor * flight[x], factor * flight[y])


def size_over_time(vector: str, factor: float = 1.0) -> Callable[[FlightResult], Curve]:
    """Return a curve of the magnitude of a vector over time, multiplied by ``factor``."""
    return lambda flight: (flight.time, factor * np.linalg.norm(flight[vector], axis=1))


def settled_curve(signal: str, factor: float) -> Callable[[FlightResult], Curve]:
    """Return a curve over time, multiplied by ``factor``, from ten minutes after a satellite points to nadir."""

    def curve(flight: FlightResult) -> Curve:
        rows = (flight["modes.mode"] == 2) & (flight["modes.time_in_mode"] > 600.0)
        return flight.time[rows], factor * flight[signal][rows]

    return curve


DEG = 180.0 / np.pi
ARCSEC = 3600.0 * DEG
RPM = 30.0 / np.pi
TIME = "time, s"
NORTH = "distance north of the site"
ANGLES = ("roll", "yaw", "pitch")
PICTURES = {
    "lunar_landing": SystemPicture(
        (
            Panel(
                "distance north of the site, km",
                "altitude, km",
                {"": curve_over_signal("plant.position[1]", "plant.altitude")},
            ),
            Panel(TIME, "speed, m/s", {"": size_over_time("plant.velocity")}),
            Panel(TIME, "thrust acceleration, m/s²", {"": over_time("guidance.thrust_acceleration")}),
        )
    ),
    "lunar_descent_2d": SystemPicture(
        (
            Panel(TIME, "altitude, km", {"": over_time("plant.altitude", 1e-3)}),
            Panel(TIME, "speed, m/s", {"": over_time("plant.speed")}),
            Panel(TIME, "flight-path angle, deg", {"": over_time("plant.path_angle", DEG)}),
            Panel(TIME, "central angle, deg", {"": over_time("plant.central_angle", DEG)}),
            Panel(TIME, "thrust angle, deg", {"": before_last("guidance.thrust_angle", DEG)}),
            Panel(TIME, "thrust, kN", {"": before_last("guidance.thrust", 1e-3)}),
            Panel(TIME, "mass, kg", {"": over_time("plant.mass")}),
            Panel(TIME, "load factor", {"": after_first("plant.load_factor")}),
        ),
        rows=2,
    ),
    "hover_transfer": SystemPicture(
        (
            Panel(
                "distance north of the site, m",
                "altitude, m",
                {"": curve_over_signal("plant.position[1]", "plant.altitude", 1.0)},
            ),
            Panel(TIME, "tilt, deg", {"": over_time("plant.tilt", DEG)}),
            Panel(TIME, "speed, m/s", {"": size_over_time("plant.velocity")}),
        )
    ),
    "landing_mission": SystemPicture(
        (
            Panel(TIME, "altitude, km", {"": over_time("plant.altitude", 1e-3)}),
            Panel(TIME, "speed, m/s", {"": size_over_time("plant.velocity")}),
            Panel(TIME, "mass, kg", {"": over_time("plant.mass")}),
        )
    ),
    "orbital_attitude": SystemPicture(
        (
            Panel(
                TIME,
                "angle to the orbital frame, deg",
                {name: over_time(f"plant.angles[{k}]", DEG) for k, name in enumerate(ANGLES, 1)},
                band=(-0.5, 0.5),
            ),
            Panel(
                TIME,
                "yaw estimation error, deg",
                {"": over_time("observer.estimated_angles[2]", DEG, less="plant.angles[2]")},
            ),
        ),
        {"parameters": ["noisy.ssv"], "stop_time": 150.0},
    ),
    "satellite_pointing": SystemPicture(
        (
            Panel(TIME, "angle to the target, deg", {"": over_time("monitor.pointing_error", DEG)}),
            Panel(
                TIME,
                "attitude error, arcsec",
                {axis: over_time(f"monitor.attitude_error[{k}]", ARCSEC) for k, axis in enumerate("xyz", 1)},
                band=(-10.0, 10.0),
            ),
            Panel(
                TIME,
                "wheel speed, rpm",
                {f"wheel {k}": over_time(f"satellite.wheel_speeds[{k}]", RPM) for k in (1, 2, 3, 4)},
            ),
        ),
    ),
    "earth_pointing": SystemPicture(
        (
            Panel(TIME, "angular velocity, deg/s", {"": size_over_time("satellite.angular_velocity", DEG)}),
            Panel(
                TIME, "angle of the boresight, arcsec", {"": settled_curve("monitor.half_cone", ARCSEC)}, band=(180.0,)
            ),
            Panel(
                TIME,
                "momentum of the wheels, N m s",
                {axis: over_time(f"satellite.wheel_momentum[{k}]") for k, axis in enumerate("xyz", 1)},
                band=(-0.02, 0.02),
            ),
        ),
    ),
    "flexible_slew": SystemPicture(
        (
            Panel(TIME, "angle to the target, deg", {"": over_time("monitor.pointing_error", DEG)}),
            Panel(
                TIME,
                "attitude error, arcsec",
                {axis: over_time(f"monitor.attitude_error[{k}]", ARCSEC) for k, axis in enumerate("xyz", 1)},
            ),
            Panel(
                TIME,
                "modal displacements, m √kg",
                {f"mode {k}": over_time(f"satellite.mode_displacements[{k}]") for k in (1, 2, 3)},
            ),
        ),
    ),
    "entry_attitude": SystemPicture(
        (
            Panel(
                TIME,
                "bank, deg",
                {"bank": over_time("plant.bank", DEG), "target": over_time("programme.target_bank", DEG)},
            ),
            Panel(TIME, "angle of attack, deg", {"": over_time("plant.attack", DEG)}, band=(-23.0, -17.0)),
            Panel(TIME, "sideslip, deg", {"": over_time("plant.sideslip", DEG)}, band=(-3.0, 3.0)),
        )
    ),
}


def system_figure(picture: SystemPicture, flight: FlightResult) -> Figure:
    """Return a picture's panels as a figure."""
    columns = len(picture.panels) // picture.rows
    figure = new_figure(2.5 * picture.rows, 3.4 * columns * 0.88)
    panels = figure.subplots(picture.rows, columns, squeeze=False).flatten()
    for axes, panel in zip(panels, picture.panels, strict=True):
        _draw(axes, panel, flight)
    return figure


def _draw(axes: Axes, panel: Panel, flight: FlightResult) -> None:
    for index, (label, curve) in enumerate(panel.curves.items()):
        x, y = curve(flight)
        rows = np.unique(np.linspace(0, len(x) - 1, POINTS).astype(int))
        style = look(index)
        axes.plot(x[rows], y[rows], color=style.colour, linestyle=style.dashes, linewidth=1.3, label=label)
    for limit in panel.band:
        axes.axhline(limit, color=FAINT, linewidth=0.8, linestyle=(0, (3, 2)))
    axes.set(xlabel=panel.xlabel, ylabel=panel.ylabel)
    plain_ticks(axes, x=5, y=5)
    if len(panel.curves) > 1:
        axes.legend(loc="best", fontsize=7.5)


def draw_system_figures(folder: Path = IMAGES) -> list[Path]:
    """Simulate every system and write its picture."""
    paths = []
    with house_style():
        for system, picture in PICTURES.items():
            flight = simulate(system, **picture.options)
            paths.append(write_picture(system_figure(picture, flight), folder / f"{system}.svg"))
    return paths


if __name__ == "__main__":
    print(*draw_system_figures(), sep="\n")
    exit_process(0)
