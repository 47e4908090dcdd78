"""A scalar over another: a path, with further positions as marks."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...runtime.flight.results import Result
from ..common.lines import plot_path
from ..common.panels import both_widths, far, is_slim
from ..common.quantities import display_unit, label_with_unit
from ..common.style import BLUE, INK, look, plain_ticks
from .declared import Arc, Path, Point, Signal
from .section import Section, select_rows
from .words import condition_text, sentence

HEIGHT = 3.6  # in
EQUAL_HEIGHT = 4.6  # in, with equal scales
SLIM_HEIGHT = 3.4  # in


def path_section(path: Path, result: Result, name: str) -> Section:
    """The section of a path; ``name`` must differ between the figures of a page."""
    chosen, rows = select_rows(path.rows, result)

    def line(signal: Signal | Arc) -> np.ndarray:
        return np.where(chosen, signal.plot_values(result)[0], np.nan)[rows]

    x, y = line(path.x), line(path.y)
    scales = _scales(path, x, y)

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        plot_path(axes, scales[0] * x, scales[1] * y, path.y.label, result.time[rows])
        axes.plot(scales[0] * x[-1], scales[1] * y[-1], "o", markersize=6, markerfacecolor="white", color=BLUE)
        for index, point in enumerate(path.points, 1):
            _draw_point(axes, point, (scales[0] * line(point.x), scales[1] * line(point.y)), index)
        axes.set_xlabel(_axis(path.x, scales[0]))
        axes.set_ylabel(_axis(path.y, scales[1]))
        if _over_ground(path):
            axes.axhline(0.0, color=INK, linewidth=0.8, zorder=0.9)
        plain_ticks(axes, x=5 if is_slim(figure) else 10, y=6)
        axes.margins(0.05, 0.08)
        if path.equal:
            axes.set_aspect("equal", adjustable="datalim")
        if path.points:
            axes.legend(loc="best")

    beyond = isinstance(path.x, Arc) and bool(np.nanmax(x, initial=0.0) > 0.5 * np.pi * path.x.radius)
    description = f"{path.title}: {path.y.label} over {path.x.label}"
    plot = both_widths(name, description, draw, EQUAL_HEIGHT if path.equal else HEIGHT, SLIM_HEIGHT)
    return Section(title=path.title, plot=plot, notes=[_caption(path, beyond), *path.notes])


def _scales(path: Path, x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Factors of both axes: km where lengths in m are long; the same with equal scales."""
    metres = [signal.unit_name == "m" for signal in (path.x, path.y)]
    if path.equal and all(metres):
        factor, _ = far(np.concatenate([x, y]))
        return factor, factor
    first, second = (far(values)[0] if is_length else 1.0 for values, is_length in zip((x, y), metres, strict=True))
    return first, second


def _over_ground(path: Path) -> bool:
    """Whether the ordinate is the altitude over the sphere of the abscissa."""
    return isinstance(path.x, Arc) and path.y.label.rpartition(".")[2] == "altitude"


def _axis(signal: Signal | Arc, scale: float) -> str:
    return label_with_unit(signal.label, "km" if scale != 1.0 else display_unit(signal.unit_name))


def _draw_point(axes: Axes, point: Point, position: tuple[np.ndarray, np.ndarray], index: int) -> None:
    """All values of a position, the last one larger."""
    points = np.stack(position)
    points = points[:, np.all(np.isfinite(points), axis=0)]
    if not points.size:
        return
    moved = np.concatenate([[True], np.any(np.diff(points, axis=1) != 0.0, axis=0)])
    style = look(index)
    axes.plot(*points[:, moved], linestyle="", marker=style.marker, markersize=4, color=style.colour)
    axes.plot(
        *points[:, -1], linestyle="", marker=style.marker, markersize=9, markerfacecolor="none",
        markeredgewidth=1.6, color=style.colour, label=point.name,
    )  # fmt: skip


def _caption(path: Path, beyond: bool) -> Markup:
    text = Markup("circle: end")
    if path.points:
        names = ", ".join(f"{point.name} ({point.x.label}, {point.y.label})" for point in path.points)
        text = Markup("{}; marks: {}, large: final").format(text, names)
    if path.rows is not None:
        text = Markup("{}; samples where {}").format(text, condition_text(path.rows))
    scale = Markup("equal scales") if path.equal else Markup("not to scale")
    text = Markup("{}; {}").format(text, scale)
    if isinstance(path.x, Arc):
        text = Markup("{}; range: ground range of {} from the origin").format(text, path.x.position.label)
        if beyond:
            text = Markup("{}, along the great circle of the track beyond a quarter of the circumference").format(text)
    if _over_ground(path):
        text = Markup("{}; black line: surface").format(text)
    return sentence(text)
