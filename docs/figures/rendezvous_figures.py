"""Figures docs/images/rendezvous/*.svg: `python -m docs.figures.rendezvous_figures`, after build_fmus.py."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from scipy.spatial.transform import Rotation

from perilune.analysis.documents.common.colours import BLUE, FAINT, INK, ORANGE, SKY, VERMILION, look
from perilune.analysis.documents.common.style import house_style, new_figure, plain_ticks
from perilune.analysis.runtime.flight.results import FlightResult
from perilune.analysis.verbs.run import simulate
from perilune.common.process import exit_process
from perilune.fmus_src.guidance.rendezvous_guidance_jerk_limited import RendezvousGuidanceJerkLimited
from perilune.fmus_src.interfaces.ports.robot import ROTOR_MOMENTUM

from .landing import vector
from .pictures import IMAGES, write_picture

PHASES = ("accelerate", "turn", "approach", "hold")
MOMENTS = (0.0, 1420.0, 1520.0, 4250.0, 5000.0)  # s, their beginnings and the end
INTERVAL = 10.0  # s between the points of smooth curves; the flight has eight a second
WHOLE, TURN = (0.0, 5000.0), (1400.0, 1560.0)  # s
PAIR = 2.0  # largest momentum of a pair of gyros over that of a rotor
REGULAR = 4.0 * np.sqrt(6.0) / 5.0  # no singularities below; docs/theory/rendezvous.md
CAMERA, SPIN = 60.0, 45.0  # m of arrow, and of the spin axis either way


def fly() -> FlightResult:
    """Simulate the approach with the parameters of the figures and the first seed."""
    return simulate("robot_rendezvous", parameters=["best.ssv"])


def draw_rendezvous_figures(flight: FlightResult, folder: Path) -> list[Path]:
    """Write seven figures of a simulation of `robot_rendezvous` to an existing folder and print their paths."""
    paths = [folder / f"{name}.svg" for name in FIGURES]
    for path, draw in zip(paths, FIGURES.values(), strict=True):
        with house_style():
            write_picture(draw(flight), path)
    return paths


def scene_figure(flight: FlightResult) -> Figure:
    """Draw the paths of robot and object in the inertial frame, with camera axes and spin axis at changes of phase."""
    figure = new_figure(6.2, 7.2)
    axes: Any = figure.add_subplot(projection="3d", computed_zorder=False)
    rows, marks = _rows_at(flight, INTERVAL), np.searchsorted(flight.time, MOMENTS)
    robot, target = vector(flight, "robot.position"), vector(flight, "target.position")
    camera = _attitude(flight, "robot", marks).apply([1.0, 0.0, 0.0]).T
    spin = _attitude(flight, "target", _rows_at(flight, 90.0)[1:2]).as_rotvec().T  # 1 deg/s: a quarter of a turn
    for path, colour, label in ((robot, BLUE, "robot"), (target, VERMILION, "object")):
        axes.plot(*path[:, rows], color=colour, label=label)
        axes.plot(*path[:, marks], linestyle="", marker="o", markersize=4, color=colour)
    for row in marks:
        axes.plot(*np.stack([robot[:, row], target[:, row]], axis=1), color=FAINT, linewidth=0.6, linestyle=":")
        ends = target[:, [row]] + SPIN * spin / np.linalg.norm(spin) * np.array([-1.0, 1.0])
        axes.plot(*ends, color=ORANGE, linewidth=1.0, label="spin axis of the object" if row == marks[-1] else None)
    axes.quiver(*robot[:, marks], *(CAMERA * camera), color=INK, linewidth=1.1, arrow_length_ratio=0.2)
    axes.plot([], [], color=INK, linewidth=1.1, label="camera axis e_x of the robot")
    for time, row, text in zip(MOMENTS, marks, ("{} s  ", "{} s  ", "  {} s", "  {} s", "{} s  "), strict=True):
        axes.text(*robot[:, row], text.format(f"{time:g}"), fontsize=8, ha="left" if text[0] == " " else "right")
    axes.set(xlabel="x, m", ylabel="y, m", zlabel="z, m")
    axes.set_aspect("equal")
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        axis.set_pane_color("white")
    axes.view_init(elev=22.0, azim=-60.0)
    axes.legend(loc="upper right", bbox_to_anchor=(1.0, 0.99))
    return figure


def range_figure(flight: FlightResult) -> Figure:
    """Draw range, range error and position error over time."""
    figure = new_figure(6.0)
    panels = figure.subplots(3, 1, sharex=True, height_ratios=[1.0, 1.3, 1.3])
    time = flight.time[rows := _rows_at(flight, INTERVAL)]
    panels[0].plot(time, flight["monitor.range"][rows], color=INK)
    panels[0].set_ylim(bottom=0.0)
    panels[1].plot(time, 1e3 * flight["monitor.range_error"][rows], color=INK)
    for index, error in enumerate(1e3 * vector(flight, "monitor.position_error")[:, rows]):
        panels[2].plot(time, error, color=look(index).colour, label="xyz"[index], linewidth=1.0)
    panels[2].legend(loc="lower right", ncols=3, title="inertial axis", bbox_to_anchor=(0.8, 0.0))
    return _over_time(figure, panels, "range, m", "range error, mm", "position error, mm")


def thrust_figure(flight: FlightResult) -> Figure:
    """Draw the force of the jets in body axes over time, above the force that the plan requires."""
    figure = new_figure(6.0)
    panels = figure.subplots(3, 1, sharex=True, sharey=True)
    rows = _rows_at(flight, INTERVAL)
    planned = flight.provenance["parameters"]["robot.mass"] * vector(flight, "guidance.planned_acceleration")[:, rows]
    planned = _attitude(flight, "robot", rows).apply(planned.T, inverse=True).T
    for axes, force, plan in zip(panels, vector(flight, "robot.jet_force"), planned, strict=True):
        levels = np.flatnonzero(np.diff(force[:-1], prepend=np.nan, append=np.nan))
        axes.step(flight.time[levels], force[levels], where="post", color=SKY, linewidth=0.6, label="jets")
        axes.plot(flight.time[rows], plan, color=VERMILION, label="plan: mass times planned acceleration")
    panels[0].legend(loc="upper left", bbox_to_anchor=(0.3, 1.02), ncols=2)
    return _over_time(figure, panels, *(f"force on body axis {axis}, N" for axis in "xyz"))


def gyros_figure(flight: FlightResult) -> Figure:
    """Draw gimbal angles over the whole simulation and around the turn, unwrapped."""
    figure = new_figure(4.2)
    whole, turn = figure.subplots(1, 2, sharey=True)
    angles = np.degrees(np.unwrap(np.stack([flight[f"robot.gimbal_angles[{i}]"] for i in (1, 2, 3, 4)])))
    for axes, span, interval in ((whole, WHOLE, INTERVAL), (turn, TURN, 0.5)):
        rows = _rows_at(flight, interval, span)
        for index, angle in enumerate(angles[:, rows]):
            style = look(index)
            axes.plot(flight.time[rows], angle, color=style.colour, linestyle=style.dashes, label=f"gyro {index + 1}")
        _over_time(figure, [axes], "gimbal angle, deg", span=span)
    whole.legend(loc="center right", bbox_to_anchor=(0.84, 0.47))
    return figure


def momentum_figure(flight: FlightResult) -> Figure:
    """Draw the momentum envelope of the gyros in three dimensions and projections, with the path of the momentum."""
    figure = new_figure(6.2)
    solid: Any = figure.add_subplot(2, 2, 1, projection="3d")
    path = np.stack([flight[f"robot.gyro_momentum[{i}]"] for i in (1, 2, 3)])[:, _rows_at(flight, 1.0, TURN)]
    path = path / ROTOR_MOMENTUM.start
    across = np.sin(np.linspace(-0.5 * np.pi, 0.5 * np.pi, 31)) * PAIR
    for fixed in np.sin(np.linspace(-0.5 * np.pi, 0.5 * np.pi, 9)) * PAIR:
        along = np.sqrt(PAIR**2 - across**2) + np.sqrt(PAIR**2 - fixed**2)
        for sign in (-1.0, 1.0):
            solid.plot(sign * along, across, np.full_like(across, fixed), color=SKY, linewidth=0.5)
            solid.plot(sign * along, np.full_like(across, fixed), across, color=SKY, linewidth=0.5)
    solid.plot(*path, color=VERMILION)
    solid.set(xlabel="x", ylabel="y", zlabel="z", xticks=(-4, 0, 4), yticks=(-2, 0, 2), zticks=(-2, 0, 2))
    solid.set_aspect("equal")
    for axis in (solid.xaxis, solid.yaxis, solid.zaxis):
        axis.set_pane_color("white")
    angle = np.linspace(0.0, 2.0 * np.pi, 121)
    circle = np.array([np.cos(angle), np.sin(angle)])
    long = np.array([PAIR * circle[0] + PAIR * np.sign(circle[0]), PAIR * circle[1]])
    square = PAIR * np.array([[-1.0, 1.0, 1.0, -1.0, -1.0], [-1.0, -1.0, 1.0, 1.0, -1.0]])
    for number, (first, second, outline) in enumerate(((0, 1, long), (0, 2, long), (1, 2, square)), start=2):
        axes = figure.add_subplot(2, 2, number)
        axes.plot(*outline, color=SKY, label="region")
        axes.plot(*(REGULAR * circle), color=INK, linewidth=0.8, linestyle=(0, (3, 2)), label="regular within")
        axes.plot(path[first], path[second], color=VERMILION, label="turn")
        axes.set(xlabel=f"momentum {'xyz'[first]}", ylabel=f"momentum {'xyz'[second]}", aspect="equal")
        plain_ticks(axes, x=5, y=5)
    figure.axes[-1].legend(loc="center left", bbox_to_anchor=(1.02, 0.5))
    return figure


def turn_figure(flight: FlightResult) -> Figure:
    """Draw planned attitude, angular velocity and acceleration of the turn, as components and magnitudes.

    The magnitudes of the time-optimal turn are shown for comparison.
    """
    figure = new_figure(6.0)
    panels = figure.subplots(3, 1, sharex=True)
    rows = _rows_at(flight, 0.5, TURN)
    attitude = np.stack([flight[f"guidance.planned_quaternion[{i}]"][rows] for i in (1, 2, 3, 4)])
    rates, accelerations = (
        vector(flight, f"guidance.planned_angular_{name}")[:, rows] for name in ("velocity", "acceleration")
    )
    quickest = _quickest_turn(flight.time[rows])
    plans = (attitude[1:] / (1.0 + attitude[0]), np.degrees(rates), np.degrees(accelerations))
    for axes, components, size in zip(panels, plans, quickest, strict=True):
        for index, component in enumerate(components):
            axes.plot(flight.time[rows], component, color=look(index).colour, label="xyz"[index], linewidth=1.0)
        axes.plot(flight.time[rows], np.linalg.norm(components, axis=0), color=INK, label="size")
        axes.plot(flight.time[rows], size, color=INK, linestyle=(0, (3, 2)), linewidth=0.9, label="size, least time")
    panels[0].legend(loc="lower left", ncols=5)
    labels = ("Rodrigues parameters", "angular velocity, deg/s", "angular acceleration, deg/s²")
    return _over_time(figure, panels, *labels, span=TURN)


def plan_figure(flight: FlightResult) -> Figure:
    """Draw planned position and velocity of the object relative to the robot, and the robot's acceleration."""
    figure = new_figure(6.0)
    panels = figure.subplots(3, 1, sharex=True)
    rows = _rows_at(flight, INTERVAL)
    relative, velocity, acceleration = (
        vector(flight, f"guidance.planned_{name}")[:, rows]
        for name in ("relative_position", "velocity", "acceleration")
    )
    relative_velocity = vector(flight, "target.velocity")[:, rows] - velocity
    for axes, components in zip(panels, (relative, relative_velocity, 1e6 * acceleration), strict=True):
        for index, component in enumerate(components):
            axes.plot(flight.time[rows], component, color=look(index).colour, label="xyz"[index], linewidth=1.0)
        axes.plot(flight.time[rows], np.linalg.norm(components, axis=0), color=INK, label="size")
    panels[0].legend(loc="upper right", ncols=4)
    return _over_time(figure, panels, "relative position, m", "relative velocity, m/s", "acceleration, µm/s²")


def _quickest_turn(times: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the magnitudes of attitude and motion in the time-optimal turn at these times (s).

    They are Rodrigues parameters, angular velocity (deg/s) and angular acceleration (deg/s2), [n] each.
    """
    guidance: Any = RendezvousGuidanceJerkLimited(attitude_period=0.0)
    guidance.initialize()
    motions = [guidance.turn_motion(float(time) - MOMENTS[1]) for time in times]
    angle, rate, acceleration = np.array([motion.elements() for motion in motions]).T
    return np.tan(0.25 * angle), np.degrees(rate), np.degrees(np.abs(acceleration))


def _rows_at(flight: FlightResult, interval: float, span: tuple[float, float] = WHOLE) -> np.ndarray:
    return np.searchsorted(flight.time, np.arange(span[0], span[1] + 0.5 * interval, interval) - 1e-9)


def _attitude(flight: FlightResult, component: str, rows: np.ndarray) -> Rotation:
    """Return the rotations from body to inertial axes at these rows."""
    elements = [flight[f"{component}.quaternion[{index}]"][rows] for index in (1, 2, 3, 4)]
    return Rotation.from_quat(np.stack(elements, axis=1), scalar_first=True)


def _over_time(figure: Figure, panels: Any, *labels: str, span: tuple[float, float] = WHOLE) -> Figure:
    """Label the time axis of all panels, mark the phases in each, and name them above the first."""
    for axes, label in zip(panels, labels, strict=True):
        axes.set_ylabel(label)
        axes.set_xlim(*span)
        plain_ticks(axes, x=10, y=5)
        for boundary in MOMENTS[1:-1]:
            axes.axvline(boundary, color=FAINT, linewidth=0.7, linestyle=(0, (3, 2)))
    for phase, begin, end in zip(PHASES, MOMENTS, MOMENTS[1:], strict=False):
        if span[0] <= (middle := 0.5 * (begin + end)) <= span[1]:
            above = panels[0].get_xaxis_transform()
            panels[0].text(middle, 1.03, phase, transform=above, ha="center", fontsize=8.0, color=FAINT)
    panels[-1].set_xlabel("time, s")
    return figure


FIGURES = {
    "scene": scene_figure,
    "turn": turn_figure,
    "plan": plan_figure,
    "range": range_figure,
    "thrust": thrust_figure,
    "momentum": momentum_figure,
    "gyros": gyros_figure,
}

if __name__ == "__main__":
    print(*draw_rendezvous_figures(fly(), IMAGES / "rendezvous"), sep="\n")
    exit_process(0)
