"""The path of whatever has a position: plan and side view, with times along it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from ...flight.results import Result
from ..kit.panels import HALF_WIDTH, Panel, far, panel
from ..kit.quantities import number
from ..kit.signals import position_groups
from ..kit.style import FAINT, INK, Look, house_style, look, new_figure, plain_ticks

HEIGHT = 3.2  # in
MAXIMUM_STRETCH = 4.0  # axes whose ranges differ by less are drawn to one scale


class View(NamedTuple):
    """One side from which paths are seen: heading, a word for it, what a screen reader says, and what draws it."""

    title: str
    name: str
    description: str
    draw: Callable[[Axes], None]


def trajectory_panels(result: Result) -> list[Panel]:
    """The path as it stands on the page; none where nothing has a position."""
    return [
        panel(view.title, f"trajectory-{view.name}", view.description, view.draw, HEIGHT, HALF_WIDTH)
        for view in _views(result)
    ]


def trajectory_plot(result: Result) -> Figure | None:
    """The same in one figure; None where nothing has a position."""
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
    """Plan (elements 1 and 2) and side view (3 over the wider of the two); none where nothing has a position."""
    groups = position_groups(result)
    if not groups or not result.time.size:
        return []
    paths = [group.values(result) for group in groups]
    everything = np.concatenate(paths, axis=1)
    scale, unit = far(everything)
    spans = np.ptp(everything, axis=1)
    across = 0 if spans[0] >= spans[1] else 1
    flat = spans[1 - across] == 0.0
    marks = _marked_rows(result.time)

    def view(title: str, name: str, x: int, y: int) -> View:
        def draw(axes: Axes) -> None:
            for index, (group, path) in enumerate(zip(groups, paths, strict=True)):
                _draw_path(axes, scale * path[[x, y]], look(index), group.label, marks)
            plain_ticks(axes, x=5, y=6)
            axes.set_xlabel(f"position[{x + 1}], {unit}")
            axes.set_ylabel(f"position[{y + 1}], {unit}")
            _scale(axes, spans[x], spans[y])
            _label_times(axes, scale * paths[0][[x, y]], result.time, marks)
            if len(groups) > 1:
                axes.legend(loc="best")

        words = f"{title} of the path of {', '.join(group.component for group in groups)}"
        return View(title, name, words, draw)

    if flat:
        constant = number(float(paths[0][1 - across][0]))
        return [view(f"Side view; position[{2 - across}] stays at {constant} m", "side", across, 2)]
    return [view("Plan", "plan", across, 1 - across), view("Side view", "side", across, 2)]


def _marked_rows(time: np.ndarray) -> np.ndarray:
    """Rows nearest to round times, about eight of them, the end always among them."""
    if time.size == 1 or time[-1] == time[0]:
        return np.array([0])
    round_times = MaxNLocator(8, steps=[1, 2, 5, 10]).tick_values(time[0], time[-1])
    interval = round_times[1] - round_times[0]
    inside = [value for value in round_times if time[0] <= value <= time[-1] - 0.6 * interval]
    return np.append(np.searchsorted(time, np.array(inside) - 1e-9), time.size - 1)


def _draw_path(axes: Axes, path: np.ndarray, style: Look, label: str, marks: np.ndarray) -> None:
    axes.plot(*path, color=style.colour, linestyle=style.dashes, label=label)
    axes.plot(*path[:, marks], linestyle="", marker="o", markersize=3.5, color=style.colour)
    axes.plot(*path[:, -1], marker="o", markersize=6, markerfacecolor="white", color=style.colour)


def _label_times(axes: Axes, path: np.ndarray, time: np.ndarray, marks: np.ndarray) -> None:
    """Times at the marks of a path, beside the line and not on each other."""
    limits = np.array([axes.get_xlim(), axes.get_ylim()])
    extent = np.ptp(limits, axis=1)
    for row in marks[:-1]:
        if np.max(np.abs(path[:, row] - path[:, -1]) / extent) < 0.1:
            continue  # its label would lie on the end's
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
    """One scale for both axes where that leaves something to see, else say that there are two."""
    axes.margins(0.1, 0.12)
    if height > 0.0 and 1.0 / MAXIMUM_STRETCH <= width / height <= MAXIMUM_STRETCH:
        axes.set_aspect("equal", adjustable="datalim")
        axes.set_title("axes to one scale", loc="right", fontsize=8.0, color=FAINT)
    else:
        axes.set_title("axes to different scales", loc="right", fontsize=8.0, color=FAINT)
