"""Trajectories of components with a position: ground track or plan view, and altitude or side view, with times."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ..runtime.flight.results import Result
from .common.lines import plot_path
from .common.panels import HALF_WIDTH, Panel, far, panel
from .common.quantities import number
from .common.round_body import altitude_over, radius_of, track_angles
from .common.signals import SignalGroup, position_groups
from .common.style import FAINT, GRID, INK, house_style, look, new_figure, plain_ticks

HEIGHT = 3.2  # in
MAXIMUM_RATIO = 4.0  # of the ranges of both axes, up to which their scales are equal
FAR = 0.35  # rad along the ground, beyond which the ground track replaces the plan view on the tangent plane
GROUND = 0.05  # of the height: depth of the grey ground


class View(NamedTuple):
    """A view of the trajectories: heading, identifier, description for screen readers, plotting function."""

    title: str
    name: str
    description: str
    draw: Callable[[Axes], None]


def trajectory_panels(result: Result) -> list[Panel]:
    """The views for the page; none where no component has a position."""
    return [
        panel(view.title, f"trajectory-{view.name}", view.description, view.draw, HEIGHT, HALF_WIDTH)
        for view in _views(result)
    ]


def trajectory_reading(result: Result) -> str:
    """The caption of the panels."""
    caption = "Dots: elapsed time; circle: end of the flight."
    groups = position_groups(result)
    radius = _radius(groups, [group.values(result) for group in groups], result) if result.time.size else None
    if radius is None:
        return f"{caption} Elements of the position in the frame of the component."
    return (
        f"{caption} Grey: ground. Altitude and downrange are relative to a sphere of {radius / 1e3:.1f} km radius, "
        "fitted to the recorded altitude. Downrange increases in the direction of flight and is 0 at the origin of the "
        "position's frame; position[k] are elements in that frame."
    )


def trajectory_plot(result: Result) -> Figure | None:
    """All views in one figure; None where no component has a position."""
    views = _views(result)
    if not views:
        return None
    with house_style():
        figure = new_figure(HEIGHT, HALF_WIDTH * len(views))
        for axes, view in zip(figure.subplots(1, len(views), squeeze=False)[0], views, strict=True):
            view.draw(axes)
            axes.set_title(view.title, loc="left")
    return figure


def _views(result: Result) -> list[View]:
    """Horizontal and vertical view; none where no component has a position.

    Over a round body the vertical view is altitude over downrange, else both are elements of the position.
    """
    groups = position_groups(result)
    if not groups or not result.time.size:
        return []
    paths = [group.values(result) for group in groups]
    labels = [group.label for group in groups]
    components = ", ".join(group.component for group in groups)
    radius = _radius(groups, paths, result)
    if radius is None:
        return _flat_views(paths, labels, result.time, components)
    arcs = [np.stack([radius * angle for angle in track_angles(path, radius)]) for path in paths]
    heights = [np.stack([arc[0], altitude_over(path, radius)]) for arc, path in zip(arcs, paths, strict=True)]
    downrange = "downrange from the origin"
    side = View("Altitude vs. downrange", "side", f"Altitude vs. downrange of {components}",
                _plot_of(heights, labels, result.time, (downrange, "altitude"), ground=True))  # fmt: skip
    if np.nanmax(np.abs(arcs[0][0])) > FAR * radius:
        draw = _plot_of(arcs, labels, result.time, (downrange, "crossrange"))
        return [View("Ground track", "plan", f"Ground track of {components}", draw), side]
    return [*_flat_views(paths, labels, result.time, components)[:-1], side]


def _radius(groups: Sequence[SignalGroup], paths: Sequence[np.ndarray], result: Result) -> float | None:
    """The radius (m) of the body, from the first component that has a position and its altitude; None without one."""
    for group, path in zip(groups, paths, strict=True):
        altitude = f"{group.component}.altitude"
        if result.units.get(altitude) == "m" and (radius := radius_of(path, result[altitude])) is not None:
            return radius
    return None


def _flat_views(paths: Sequence[np.ndarray], labels: Sequence[str], time: np.ndarray, components: str) -> list[View]:
    """Plan view (elements 1 and 2) and side view (3 over the wider of the two); in a plane the side view alone."""
    spans = np.ptp(np.concatenate(paths, axis=1), axis=1)
    across = 0 if spans[0] >= spans[1] else 1

    def view(title: str, name: str, x: int, y: int) -> View:
        names = (f"position[{x + 1}]", f"position[{y + 1}]")
        draw = _plot_of([path[[x, y]] for path in paths], labels, time, names)
        return View(title, name, f"{title} of {components}", draw)

    if spans[1 - across] == 0.0:
        constant = number(float(paths[0][1 - across][0]))
        return [view(f"Side view; position[{2 - across}] = {constant} m", "side", across, 2)]
    return [view("Plan view", "plan", across, 1 - across), view("Side view", "side", across, 2)]


def _plot_of(
    paths: Sequence[np.ndarray],
    labels: Sequence[str],
    time: np.ndarray,
    names: tuple[str, str],
    *,
    ground: bool = False,
) -> Callable[[Axes], None]:
    """A function that plots paths, rows of abscissa and ordinate in m; with ``ground``, the ground at 0, too."""
    everything = np.concatenate(paths, axis=1)
    width, height = np.ptp(everything, axis=1)
    if ground:
        height = max(height, float(np.nanmax(everything[1])))
    if _is_legible_to_scale(width, height):
        (scale, unit) = far(everything)
        scales, units = (scale, scale), (unit, unit)
    else:
        scales, units = zip(*map(far, everything), strict=True)
    scaled = [np.array(scales)[:, None] * path for path in paths]
    marks = _mark_rows(time)

    def draw(axes: Axes) -> None:
        for index, (path, label) in enumerate(zip(scaled, labels, strict=True)):
            style = look(index)
            plot_path(axes, path[0], path[1], label, time, index, label=label)
            axes.plot(*path[:, marks], linestyle="", marker="o", markersize=3.5, color=style.colour)
            axes.plot(*path[:, -1], marker="o", markersize=6, markerfacecolor="white", color=style.colour)
        if ground:
            axes.axhspan(-GROUND * scales[1] * height, 0.0, facecolor=GRID, edgecolor="none", zorder=0.8)
            axes.axhline(0.0, color=INK, linewidth=0.8, zorder=0.9)
        plain_ticks(axes, x=5, y=6)
        axes.set_xlabel(f"{names[0]}, {units[0]}")
        axes.set_ylabel(f"{names[1]}, {units[1]}")
        _scale(axes, width, height)
        _label_times(axes, scaled[0], time, marks)
        if len(paths) > 1:
            axes.legend(loc="best")

    return draw


def _is_legible_to_scale(width: float, height: float) -> bool:
    """Whether equal scales of both axes leave the path legible."""
    return height > 0.0 and 1.0 / MAXIMUM_RATIO <= width / height <= MAXIMUM_RATIO


def _mark_rows(time: np.ndarray) -> np.ndarray:
    """Rows nearest to about eight round times, and the last row."""
    if time.size == 1 or time[-1] == time[0]:
        return np.array([0])
    round_times = MaxNLocator(8, steps=[1, 2, 5, 10]).tick_values(time[0], time[-1])
    interval = round_times[1] - round_times[0]
    inside = [value for value in round_times if time[0] <= value <= time[-1] - 0.6 * interval]
    return np.append(np.searchsorted(time, np.array(inside) - 1e-9), time.size - 1)


def _label_times(axes: Axes, path: np.ndarray, time: np.ndarray, marks: np.ndarray) -> None:
    """Label the marks of a path with their times, next to the line and without overlap."""
    limits = np.array([axes.get_xlim(), axes.get_ylim()])
    extent = np.ptp(limits, axis=1)
    for row in marks[:-1]:
        if np.max(np.abs(path[:, row] - path[:, -1]) / extent) < 0.1:
            continue  # its label would overlap that of the end
        left, right = path[:, max(0, row - 1)], path[:, row + 1]
        rising = (right[0] - left[0]) * (right[1] - left[1]) > 0.0  # then there is room above on the left
        side = -1 if rising else 1
        _write_time(axes, time[row], path[:, row], (5 * side, 4), color=FAINT)
    side = 1 if path[0, -1] < limits[0].mean() else -1
    below = path[1, marks[max(0, marks.size - 2)]] >= path[1, -1]
    _write_time(axes, time[-1], path[:, -1], (8 * side, -13 if below else 6), color=INK, fontweight="bold")


def _write_time(axes: Axes, time: float, point: np.ndarray, offset: tuple[int, int], **style: Any) -> None:
    axes.annotate(
        f"{number(float(time), 4)} s", (point[0], point[1]), xytext=offset, textcoords="offset points",
        ha="left" if offset[0] > 0 else "right", fontsize=8.0, **style,
    )  # fmt: skip


def _scale(axes: Axes, width: float, height: float) -> None:
    """Equal scales of both axes where the path stays legible; a note says which."""
    axes.margins(0.1, 0.12)
    equal = _is_legible_to_scale(width, height)
    if equal:
        axes.set_aspect("equal", adjustable="datalim")
    axes.set_title("equal scales" if equal else "not to scale", loc="right", fontsize=8.0, color=FAINT)
