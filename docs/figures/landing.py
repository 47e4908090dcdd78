"""The figure of lunar landings: one in full over a sample of its campaign."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from perilune.analysis.campaigns.definition.campaign import Variant
from perilune.analysis.campaigns.definition.checks import variant_names
from perilune.analysis.campaigns.definition.plan import BatchPlan
from perilune.analysis.reports.common.style import (
    BLUE,
    FAINT,
    INK,
    VERMILION,
    WIDTH,
    house_style,
    new_figure,
    plain_ticks,
)
from perilune.analysis.runtime.flight.results import Result
from perilune.analysis.runtime.flight.simulation import Simulation

HEIGHT, SLIM_HEIGHT = 5.3, 7.0  # in
SAMPLE = "#b9c9d6"
ARROW_TIMES = 20.0  # s between thrust arrows
CROWDED = 6.0  # km from the site, nearer than which arrows would lie on each other
THIN = 10  # of the samples of flights in the background, one in so many is drawn
ARROW_SCALE = 2.2  # km of arrow per m/s2


def fly_landings(plan: BatchPlan, variant: Variant, trials: Iterable[int]) -> list[Result]:
    """Some trials of a campaign with every signal; the same flights as in its batch."""
    prepared = plan.prepare(variant)
    varied = variant_names(plan, prepared).varied
    landings = []
    with Simulation(prepared, varied=varied, faults=plan.list_faults()) as simulation:
        for trial in trials:
            simulation.set_faults(plan.faults_of(trial))
            landings.append(_copy(simulation.fly(plan.parameters(prepared, trial))))
    return landings


def _copy(result: Result) -> Result:
    """A flight that the next one does not overwrite."""
    return replace(
        result, time=result.time.copy(), signals={name: values.copy() for name, values in result.signals.items()}
    )


def vector(result: Result, name: str) -> np.ndarray:
    """Elements 1 to 3 of a signal, elements by rows."""
    return np.stack([result[f"{name}[{index}]"] for index in (1, 2, 3)])


def landing_figure(landing: Result, sample: list[Result], height: float = HEIGHT, width: float = WIDTH) -> Figure:
    """As wide as a page or as a telephone, see `draw_landing`; sizes in inches."""
    with house_style():
        figure = new_figure(height, width)
        draw_landing(figure, landing, sample)
        return figure


def draw_landing(figure: Figure, landing: Result, sample: list[Result]) -> None:
    """Side view with thrust arrows, to scale where there is room; plan, speed and thrust over other flights."""
    slim = figure.get_figwidth() < WIDTH
    top, bottom = figure.subfigures(2, 1, height_ratios=[2.05, 5.2 if slim else 3.2], squeeze=False).flatten()
    _side_view(top.subplots(), landing, sample, to_scale=not slim)
    panels = bottom.subplots(*((2, 2) if slim else (1, 4)), width_ratios=[1.0, 1.0] if slim else [1.62, 1.0, 1.0, 1.0])
    plan, *others = panels.flatten()
    _plan_view(plan, landing, sample)
    for axes, (title, history) in zip(others, HISTORIES.items(), strict=True):
        for other in sample:
            time, values = history(other)
            axes.plot(time[::THIN], values[::THIN], color=SAMPLE, linewidth=0.6)
        axes.plot(*history(landing), color=BLUE, linewidth=1.8)
        axes.set_title(title, loc="left")
        axes.set_xlabel("time, s")
        axes.margins(x=0.03)
        plain_ticks(axes, x=3 if slim else 5, y=5)


def _speed(result: Result) -> tuple[np.ndarray, np.ndarray]:
    return result.time, np.linalg.norm(vector(result, "plant.velocity"), axis=0)


def _acceleration(result: Result) -> tuple[np.ndarray, np.ndarray]:
    """Commanded while thrusting; the last row has no command any more."""
    return result.time[:-1], result["guidance.thrust_acceleration"][:-1]


def _elevation(result: Result) -> tuple[np.ndarray, np.ndarray]:
    direction = vector(result, "guidance.thrust_direction")[:, :-1]
    return result.time[:-1], np.degrees(np.arctan2(direction[2], np.hypot(direction[0], direction[1])))


HISTORIES = {
    "speed, m/s": _speed,
    "thrust acceleration, m/s²": _acceleration,
    "thrust above the horizon, deg": _elevation,
}


def _side_view(axes: Axes, landing: Result, sample: list[Result], *, to_scale: bool) -> None:
    for other in sample:
        x, y, z = vector(other, "plant.position")[:, ::THIN] / 1e3
        axes.plot(np.hypot(x, y), z, color=SAMPLE, linewidth=0.6)
    x, y, z = vector(landing, "plant.position") / 1e3
    distance = np.hypot(x, y)
    axes.plot(distance, z, color=BLUE, linewidth=1.8)
    rows = np.searchsorted(landing.time, np.arange(0.0, landing.time[-1], ARROW_TIMES) - 1e-9)
    rows = rows[distance[rows] > CROWDED]
    thrust = landing["guidance.thrust_acceleration"] * vector(landing, "guidance.thrust_direction")
    outward = (thrust[0] * x + thrust[1] * y) / np.maximum(distance, 1e-9)
    axes.quiver(
        distance[rows], z[rows], ARROW_SCALE * outward[rows], ARROW_SCALE * thrust[2, rows], color=VERMILION,
        angles="xy", scale_units="xy", scale=1.0, width=0.0016, headwidth=5.0, headlength=6.0, zorder=3,
    )  # fmt: skip
    for row in rows if to_scale else rows[::2]:
        axes.annotate(
            f"{landing.time[row]:g} s", (distance[row], z[row]), xytext=(0, -10), textcoords="offset points",
            ha="center", fontsize=7 if to_scale else 8, color=FAINT,
        )  # fmt: skip
    axes.plot(distance[rows], z[rows], linestyle="", marker="o", markersize=3, color=BLUE)
    _target(axes, 0.0, 2.0)
    axes.annotate(
        "target, 2 km above the site", (0.0, 2.8), xytext=(-1.5, 11.0), fontsize=8,
        arrowprops={"arrowstyle": "-", "color": FAINT, "linewidth": 0.7, "relpos": (0.083, 0.0), "shrinkA": 1.0},
    )  # fmt: skip
    axes.axhspan(-1.2, 0.0, color="#d9d6d0", linewidth=0)
    axes.set_xlim(-3.0, 118.0)
    axes.set_ylim(-1.2, 16.0)
    if to_scale:
        axes.set_aspect("equal")
    axes.grid(visible=False)
    plain_ticks(axes, x=12 if to_scale else 6, y=3)
    axes.set_xlabel("distance from the site along the ground, km")
    axes.set_ylabel("altitude, km")
    scale = "equal scales" if to_scale else "not to scale"
    axes.set_title(f"Side view, {scale}; arrows: thrust", loc="left")


def _plan_view(axes: Axes, landing: Result, sample: list[Result]) -> None:
    for other in sample:
        x, y, _ = vector(other, "plant.position")[:, ::THIN] / 1e3
        axes.plot(-y, x, color=SAMPLE, linewidth=0.6)
    x, y, _ = vector(landing, "plant.position") / 1e3
    axes.plot(-y, x, color=BLUE, linewidth=1.8)
    _target(axes, 0.0, 0.0)
    axes.set_aspect("equal", anchor="W")
    axes.margins(0.06)
    plain_ticks(axes, x=4, y=5)
    axes.set_title("Plan: north, km", loc="left")
    axes.set_xlabel("east, km")


def _target(axes: Axes, x: float, y: float) -> None:
    axes.plot(
        x, y, marker="o", markersize=7, markerfacecolor="white", markeredgecolor=INK, markeredgewidth=1.4, zorder=4
    )
