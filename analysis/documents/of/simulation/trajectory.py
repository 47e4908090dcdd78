"""Trajectories of components with a position: ground track or plan view, and altitude or side view, with times."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ....runtime.flight.results import FlightResult
from ...cell import LegendEntry
from ...chart.panel import POINTS
from ...common.colours import FAINT
from ...common.panels import HALF_WIDTH
from ...common.quantities import number
from ...common.round_body import altitude_over, radius_of, track_angles
from ...common.signals import SignalGroup, position_groups
from ...interactive.charts import ChartNote
from ...interactive.measures import TICK_SIZE
from ...pictures import Figure
from .figures.section import legend_of
from .trajectory_chart import View, view_chart

if TYPE_CHECKING:
    from matplotlib.figure import Figure as Drawing

HEIGHT = 3.2  # in
PLOT_WIDTH = 6.8  # in, of a view in a separate figure
INDICES = ("position[1]", "position[2]", "position[3]")
FAR = 0.35  # rad along the ground, beyond which the ground track replaces the plan view on the tangent plane


def trajectory_figures(result: FlightResult) -> list[Figure]:
    """Return the figures of the views for a page; no figures without a position."""
    components = ", ".join(group.component for group in position_groups(result))
    figures = []
    for view in _views(result):
        name, description = f"trajectory-{view.name}", f"{view.title} of {components}"
        chart, ordinate, scales = view_chart(view, POINTS * HALF_WIDTH, POINTS * HEIGHT)
        note = ChartNote(scales, (1.0, 1.0), (True, True), (0.0, 4.0), ("right", "baseline"), FAINT, TICK_SIZE)
        chart = replace(chart, notes=[*chart.notes, note], title=ordinate)
        figures.append(Figure(view.title, name, description, chart, HEIGHT))
    return figures


def trajectory_plot(result: FlightResult) -> Drawing | None:
    """Return all views in one figure, below each other; None if there is no position."""
    views = _views(result)
    if not views:
        return None
    from ...chart.plot import plot_charts  # which imports matplotlib

    charts, titles = [], []
    for view in views:
        chart, ordinate, scales = view_chart(view, POINTS * PLOT_WIDTH, POINTS * HEIGHT, fluid=False)
        charts.append(chart)
        titles.append(f"{view.title}: {ordinate}, {scales}")
    legend = views[0].labels if len(views[0].labels) > 1 else []
    return plot_charts(charts, HEIGHT, PLOT_WIDTH, titles=titles, legends=[legend] * len(views))


def trajectory_legend(result: FlightResult) -> list[LegendEntry]:
    """Return the legend with the components' lines and names; empty for a single component."""
    return legend_of(tuple(group.label for group in position_groups(result)))


def trajectory_reading(result: FlightResult) -> str:
    """Return the caption that explains the panels."""
    caption = "Dots: elapsed time; circle: end of the flight."
    groups = position_groups(result)
    radius = _radius(groups, [group.values(result) for group in groups], result) if result.time.size else None
    if radius is None:
        return f"{caption} Elements of the position in the frame of the component."
    axes = _axes(groups)
    elements = f"{', '.join(axes)} are" if axes != INDICES else "position[k] are"
    return (
        f"{caption} Grey: ground. Altitude and downrange are relative to a sphere of {radius / 1e3:.1f} km radius, "
        "fitted to the recorded altitude. Downrange increases in the direction of flight and is 0 at the origin of the "
        f"position's frame; {elements} elements in that frame."
    )


def _views(result: FlightResult) -> list[View]:
    """Return the horizontal and the vertical view; none if there is no position.

    Over a round body the vertical view is altitude over downrange; otherwise both are elements of the position.
    """
    groups = position_groups(result)
    if not groups or not result.time.size:
        return []
    paths = [group.values(result) for group in groups]
    labels = [group.label for group in groups]
    radius = _radius(groups, paths, result)
    if radius is None:
        return _flat_views(paths, groups, result.time)
    arcs = [np.stack([radius * angle for angle in track_angles(path, radius)]) for path in paths]
    heights = [np.stack([arc[0], altitude_over(path, radius)]) for arc, path in zip(arcs, paths, strict=True)]
    downrange, title = "downrange from the origin", "Altitude vs. downrange"
    side = View(title, "side", heights, labels, result.time, (downrange, "altitude"), has_ground=True)
    if np.nanmax(np.abs(arcs[0][0])) > FAR * radius:
        return [View("Ground track", "plan", arcs, labels, result.time, (downrange, "crossrange")), side]
    return [*_flat_views(paths, groups, result.time)[:-1], side]


def _radius(groups: Sequence[SignalGroup], paths: Sequence[np.ndarray], result: FlightResult) -> float | None:
    """Return the radius (m) of the body from the first component with position and altitude; None if there is none."""
    for group, path in zip(groups, paths, strict=True):
        altitude = f"{group.component}.altitude"
        if result.units.get(altitude) == "m" and (radius := radius_of(path, result[altitude])) is not None:
            return radius
    return None


def _axes(groups: Sequence[SignalGroup]) -> tuple[str, ...]:
    """Return the names of the elements of positions: axes if all positions have the same, else indices."""
    named = {group.labels if group.is_named else () for group in groups}
    return named.pop() if len(named) == 1 and () not in named else INDICES


def _flat_views(paths: Sequence[np.ndarray], groups: Sequence[SignalGroup], time: np.ndarray) -> list[View]:
    """Return the plan view, unless the motion is in a plane, and the side view.

    The plan view shows elements 1 and 2 of the position, the side view element 3 over the wider of these.
    """
    axes, labels = _axes(groups), [group.label for group in groups]
    spans = np.ptp(np.concatenate(paths, axis=1), axis=1)
    across = 0 if spans[0] >= spans[1] else 1

    def view(title: str, name: str, x: int, y: int) -> View:
        return View(title, name, [path[[x, y]] for path in paths], labels, time, (axes[x], axes[y]))

    if spans[1 - across] == 0.0:
        constant = number(float(paths[0][1 - across][0]))
        return [view(f"Side view; {axes[1 - across]} = {constant} m", "side", across, 2)]
    return [view("Plan view", "plan", across, 1 - across), view("Side view", "side", across, 2)]
