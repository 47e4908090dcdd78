"""Figure of lunar landings: one in full over a sample of its campaign."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from perilune.analysis.campaigns.definition.campaign import Variant
from perilune.analysis.campaigns.definition.checks import variant_names
from perilune.analysis.campaigns.definition.plan import BatchPlan
from perilune.analysis.documents.chart.axes import linear_axis
from perilune.analysis.documents.chart.equal import Ends, to_scale
from perilune.analysis.documents.chart.layout import BROAD
from perilune.analysis.documents.chart.lines import line
from perilune.analysis.documents.chart.panel import POINTS, chart_panel, wide_figure
from perilune.analysis.documents.chart.plot import plot_charts
from perilune.analysis.documents.chart.symbols import arrow, mark, marker
from perilune.analysis.documents.chart.ticks import axis_ends
from perilune.analysis.documents.common.colours import BLUE, INK, VERMILION
from perilune.analysis.documents.common.panels import HALF_WIDTH, PANEL_HEIGHT, FigurePanel
from perilune.analysis.documents.interactive.charts import NO_BOX, Chart, Drawing
from perilune.analysis.documents.of.simulation.trajectory_chart import View, view_chart
from perilune.analysis.runtime.flight.results import FlightResult
from perilune.analysis.runtime.flight.simulation import Simulation

HEIGHT, PLOT_WIDTH = 2.6, 5.2  # in
WORDS = "A landing over others"
SAMPLE = "#b9c9d6"
TARGET = marker("o", 6.5, INK, fill="#ffffff", width=1.4)
ARROW_TIMES = 20.0  # s between thrust arrows
CROWDED = 6e3  # m from the site, below which arrows would overlap
THIN = 10  # every n-th sample of flights in the background is drawn
ARROW_SCALE = 7.0  # pt of arrow per m/s2


def fly_landings(plan: BatchPlan, variant: Variant, trials: Iterable[int]) -> list[FlightResult]:
    """Simulate some trials of a campaign with every signal; the results equal those of the batch."""
    prepared = plan.prepare(variant)
    varied = variant_names(plan, prepared).varied
    landings = []
    with Simulation(prepared, varied=varied, faults=plan.list_faults()) as simulation:
        for trial in trials:
            simulation.set_faults(plan.faults_of(trial))
            landings.append(_copy(simulation.fly(plan.parameters(prepared, trial))))
    return landings


def _copy(result: FlightResult) -> FlightResult:
    """Return a copy of a result whose arrays the next simulation overwrites."""
    return replace(
        result, time=result.time.copy(), signals={name: values.copy() for name, values in result.signals.items()}
    )


def vector(result: FlightResult, name: str) -> np.ndarray:
    """Return elements 1 to 3 of a signal, [3, rows]."""
    return np.stack([result[f"{name}[{index}]"] for index in (1, 2, 3)])


def landing_charts(
    landing: FlightResult, sample: list[FlightResult], width: float, height: float, *, fluid: bool
) -> list[Chart]:
    """Return side view with thrust arrows, plan view, speed and thrust over time, with the sample in the background.

    The side view is laid out for a figure of this size (pt), as in `view_chart`.
    """
    return [
        _side_view(landing, sample, width, height, fluid=fluid),
        _plan_view(landing, sample),
        *_histories(landing, sample),
    ]


def landing_figure(landing: FlightResult, sample: list[FlightResult]) -> Figure:
    """Return the charts in one figure, for the documentation."""
    side, plan, *histories = landing_charts(landing, sample, POINTS * PLOT_WIDTH, POINTS * HEIGHT, fluid=False)
    charts = [side, _to_scale(plan, PLOT_WIDTH, HEIGHT, fluid=False), *histories]
    return plot_charts(charts, HEIGHT, PLOT_WIDTH, columns=2, titles=[chart.title for chart in charts])


def landing_panels(landing: FlightResult, sample: list[FlightResult]) -> tuple[Drawing, list[FigurePanel]]:
    """Return the side view as a panel of full width, and panels of the other charts."""
    side, plan, *histories = landing_charts(landing, sample, BROAD, POINTS * HEIGHT, fluid=True)
    panels = [
        chart_panel(chart.title, f"landing-{index}", f"{WORDS}: {chart.title}", chart, width=HALF_WIDTH)
        for index, chart in enumerate([_to_scale(plan, HALF_WIDTH, PANEL_HEIGHT), *histories])
    ]
    return wide_figure("landing-side", f"{WORDS}: {side.title}", side, HEIGHT, title=side.title), panels


def _to_scale(plan: Chart, width: float, height: float, *, fluid: bool = True) -> Chart:
    def chart_of(x: Ends, y: Ends) -> Chart:
        return replace(plan, x=linear_axis(x, 4, label=plan.x.label), y=linear_axis(y, 5))

    size = POINTS * width, POINTS * height
    return to_scale(chart_of, plan.x.ends, plan.y.ends, *size, title="" if fluid else plan.title, fluid=fluid)


def _histories(landing: FlightResult, sample: list[FlightResult]) -> list[Chart]:
    charts = []
    for title, history in HISTORIES.items():
        quantity, unit = title.rsplit(", ", 1)
        others = [line(*_thin(history(other)), SAMPLE, width=0.6) for other in sample]
        landed = line(*history(landing), BLUE, width=1.8, name=quantity, unit=unit)
        ends = [axis_ends(np.concatenate([getattr(each, key) for each in (*others, landed)])) for key in ("x", "y")]
        x, y = linear_axis(ends[0], 5, label="time, s"), linear_axis(ends[1], 5)
        charts.append(Chart(NO_BOX, x, y, title=title, curves=[*others, landed]))
    return charts


def _thin(curve: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    return curve[0][::THIN], curve[1][::THIN]


def _speed(result: FlightResult) -> tuple[np.ndarray, np.ndarray]:
    return result.time, np.linalg.norm(vector(result, "plant.velocity"), axis=0)


def _acceleration(result: FlightResult) -> tuple[np.ndarray, np.ndarray]:
    """Return the commanded acceleration while thrusting, without the last row, which has no command."""
    return result.time[:-1], result["guidance.thrust_acceleration"][:-1]


def _elevation(result: FlightResult) -> tuple[np.ndarray, np.ndarray]:
    direction = vector(result, "guidance.thrust_direction")[:, :-1]
    return result.time[:-1], np.degrees(np.arctan2(direction[2], np.hypot(direction[0], direction[1])))


HISTORIES = {
    "speed, m/s": _speed,
    "thrust acceleration, m/s²": _acceleration,
    "thrust above the horizon, deg": _elevation,
}


def _side(result: FlightResult) -> np.ndarray:
    """Return downrange from the site and altitude (m), [2, rows]."""
    x, y, z = vector(result, "plant.position")
    return np.stack([-np.hypot(x, y), z])


def _side_view(landing: FlightResult, sample: list[FlightResult], width: float, height: float, *, fluid: bool) -> Chart:
    path = _side(landing)
    names = ("downrange from the site", "altitude")
    view = View("Side view", "side", [path], ["landing"], landing.time, names, has_ground=True)
    chart, ordinate, _ = view_chart(view, width, height, fluid=fluid)
    others = [line(*_thin(tuple(_side(other) / 1e3)), SAMPLE, width=0.6) for other in sample]
    rows = np.searchsorted(landing.time, np.arange(0.0, landing.time[-1], ARROW_TIMES) - 1e-9)
    thrust = landing["guidance.thrust_acceleration"] * vector(landing, "guidance.thrust_direction")
    x, y, _ = vector(landing, "plant.position")
    inward = -(thrust[0] * x + thrust[1] * y) / np.maximum(np.hypot(x, y), 1.0)
    arrows = [
        arrow(tuple(path[:, row] / 1e3), float(np.arctan2(thrust[2, row], inward[row])),
              ARROW_SCALE * float(np.hypot(inward[row], thrust[2, row])), VERMILION)
        for row in rows if path[0, row] < -CROWDED
    ]  # fmt: skip
    curves = [*others, *arrows, *chart.curves, mark(0.0, 2.0, TARGET)]
    return replace(chart, title=f"{ordinate}; arrows: thrust", curves=curves)


def _plan_view(landing: FlightResult, sample: list[FlightResult]) -> Chart:
    def plan(result: FlightResult) -> tuple[np.ndarray, np.ndarray]:
        x, y, _ = vector(result, "plant.position") / 1e3
        return -y, x

    others = [line(*_thin(plan(other)), SAMPLE, width=0.6) for other in sample]
    landed = replace(line(*plan(landing), BLUE, width=1.8, name="north", unit="km"), time=landing.time)
    ends = [axis_ends(np.concatenate([getattr(each, key) for each in (*others, landed)])) for key in ("x", "y")]
    x, y = linear_axis(ends[0], 4, label="east, km"), linear_axis(ends[1], 5)
    return Chart(NO_BOX, x, y, title="plan: north, km", curves=[*others, landed, mark(0.0, 0.0, TARGET)])
