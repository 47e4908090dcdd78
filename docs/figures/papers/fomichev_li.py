"""Figure 5 of Fomichev and Li 2017: velocity error over position error of three methods.

`python -m docs.figures.papers.fomichev_li` draws it from the centre of the box of initial states, with the differences
on which the paper's claim rests: the relative difference of the velocity errors of two methods at equal position error,
the largest in ranges of the position error.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from perilune.analysis.documents.common.colours import look
from perilune.analysis.documents.common.style import house_style, new_figure
from perilune.analysis.runtime.flight.results import FlightResult
from perilune.analysis.verbs.run import simulate
from perilune.common.process import exit_process

from ..pictures import IMAGES, write_picture

SYSTEM = "lunar_terminal_guidance"
METHODS = {
    "analytic": "analytic_guidance",
    "A*": "astar_guidance",
    "modified A*": "astar_modified_guidance",
}
TARGET = np.array([0.0, 0.0, 2000.0])  # m, to be reached at rest
RANGES = ((100.0, 9e4), (10.0, 100.0), (1.0, 10.0))  # m
POINTS = 200  # of a curve
NEAREST = 1.0  # m; below, a cycle moves the vehicle by much of the remaining distance
Curve = tuple[np.ndarray, np.ndarray]  # position errors (m), descending, and velocity errors (m/s)


def simulate_methods() -> dict[str, Curve]:
    """Simulate each method; return its errors over the landing."""
    return {
        method: _errors(simulate(SYSTEM, parameters=["paper.ssv"], use={"guidance": fmu}))
        for method, fmu in METHODS.items()
    }


def _errors(flight: FlightResult) -> Curve:
    return (
        np.linalg.norm(flight["plant.position"] - TARGET, axis=1),
        np.linalg.norm(flight["plant.velocity"], axis=1),
    )


def largest_difference(curve: Curve, other: Curve, nearest: float, farthest: float) -> float:
    """Return the largest relative difference of velocity errors at equal position errors (m) within a range."""
    distance = np.geomspace(nearest, farthest, POINTS)
    velocity, reference = (np.interp(distance, x[::-1], y[::-1]) for x, y in (curve, other))
    return float(np.max(np.abs(velocity / reference - 1.0)))


def portrait_figure(curves: Mapping[str, Curve]) -> Figure:
    """Draw velocity error over position error, and the difference of each method from A*."""
    figure = new_figure(3.2, 8.6)
    portrait, difference = figure.subplots(1, 2)
    reference = curves["A*"]
    for index, (method, (distance, velocity)) in enumerate(curves.items()):
        style = look(index)
        at = np.geomspace(NEAREST, distance[0], POINTS)
        errors = np.interp(at, distance[::-1], velocity[::-1])
        others = np.interp(at, reference[0][::-1], reference[1][::-1])
        portrait.loglog(at, errors, label=method, color=style.colour, linestyle=style.dashes)
        difference.semilogx(at, 100.0 * (errors / others - 1.0), color=style.colour, linestyle=style.dashes)
    portrait.set(xlabel="position error, m", ylabel="velocity error, m/s")
    difference.set(xlabel="position error, m", ylabel="velocity error less that of A*, %")
    for axis in (portrait.xaxis, portrait.yaxis, difference.xaxis):
        axis.set_major_formatter("{x:g}")
    portrait.legend(loc="upper left")
    return figure


def draw_terminal_comparison(curves: Mapping[str, Curve], folder: Path = IMAGES) -> Path:
    """Write the figure of the comparison."""
    with house_style():
        return write_picture(portrait_figure(curves), folder / "terminal_comparison.svg")


if __name__ == "__main__":
    flown = simulate_methods()
    print(draw_terminal_comparison(flown))
    for method in ("modified A*", "analytic"):
        print(f"velocity error, {method} against A*, at the same position error:")
        for near, far in RANGES:
            difference = largest_difference(flown[method], flown["A*"], near, far)
            print(f"  {near:g} to {far:g} m: at most {100.0 * difference:.2f} %")
    exit_process(0)
