"""Figure of altitude over distance and thrust over time for the descent laws: `python -m docs.figures.laws.descent`.

The main braking of `lunar_landing` from the centre of its box of initial states, without sensor errors.
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

SYSTEM = "lunar_landing"
LAWS = {
    "exact analytic": "analytic_exact_guidance",
    "ZEM/ZEV": "zem_zev_guidance",
    "fractional": "fractional_guidance",
    "Apollo": "apollo_guidance",
    "powered explicit": "powered_guidance",
}
EVERY = 10  # communication points
ALONG = [f"plant.position[{i}]" for i in (1, 2)]


def simulate_laws() -> dict[str, FlightResult]:
    """Simulate the landing with each law; return the results."""
    return {name: simulate(SYSTEM, parameters=["ideal.ssv"], use={"guidance": fmu}) for name, fmu in LAWS.items()}


def descent_figure(flights: Mapping[str, FlightResult]) -> Figure:
    """Return the figure of these results, by the name of the law."""
    figure = new_figure(3.2, 8.6)
    path, thrust = figure.subplots(1, 2)
    for index, (name, flight) in enumerate(flights.items()):
        style = look(index)
        distance = np.hypot(*(flight[signal] for signal in ALONG))[::EVERY] / 1e3
        line = {"color": style.colour, "linestyle": style.dashes}
        path.plot(distance, flight["plant.altitude"][::EVERY] / 1e3, label=name, **line)
        thrust.plot(flight.time[::EVERY], flight["allocation.thrust"][::EVERY], **line)
    path.set(xlabel="distance from the site, km", ylabel="altitude, km")
    path.invert_xaxis()
    thrust.set(xlabel="time, s", ylabel="thrust, N")
    path.legend(loc="lower left")
    return figure


def draw_descent_laws(flights: Mapping[str, FlightResult], folder: Path = IMAGES) -> Path:
    """Write the figure of the descent laws."""
    with house_style():
        return write_picture(descent_figure(flights), folder / "descent_laws.svg")


if __name__ == "__main__":
    print(draw_descent_laws(simulate_laws()))
    exit_process(0)
