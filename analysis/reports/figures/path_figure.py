"""A scalar over another: a path, with the positions that stand beside it."""

from __future__ import annotations

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...runtime.flight.results import Result
from ..common.panels import both_widths, far, is_slim
from ..common.quantities import labelled, shown_unit
from ..common.style import BLUE, INK, look, plain_ticks
from .declaration.figures import Path, Point
from .declaration.values import Arc, Signal
from .section import Section, choice, chosen_rows, nothing_chosen, sentence, trimmed

HEIGHT = 3.6  # in
EQUAL_HEIGHT = 4.6  # in, where both axes have one scale
SLIM_HEIGHT = 3.4  # in


def path_section(path: Path, result: Result, name: str) -> Section:
    """The figure of a path; ``name`` must differ between the figures of a page."""
    chosen = chosen_rows(path.rows, result)
    if path.rows is not None and not chosen.any():
        return nothing_chosen(path.title, path.rows)
    rows = trimmed(chosen)

    def line(signal: Signal | Arc) -> np.ndarray:
        return np.where(chosen, signal.shown(result)[0], np.nan)[rows]

    x, y = line(path.x), line(path.y)
    scales = _scales(path, x, y)

    def draw(figure: Figure) -> None:
        axes = figure.subplots()
        axes.plot(scales[0] * x, scales[1] * y, color=BLUE, marker="." if x.size == 1 else "")
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
    what = f"{path.title}: {path.y.label} over {path.x.label}"
    drawn = both_widths(name, what, draw, EQUAL_HEIGHT if path.equal else HEIGHT, SLIM_HEIGHT)
    return Section(title=path.title, drawn=drawn, notes=_reading(path, beyond))


def _scales(path: Path, x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Factors of both axes: km where lengths in m are long; equal axes have one."""
    metres = [signal.unit_name == "m" for signal in (path.x, path.y)]
    if path.equal and all(metres):
        factor, _ = far(np.concatenate([x, y]))
        return factor, factor
    first, second = (far(values)[0] if is_length else 1.0 for values, is_length in zip((x, y), metres, strict=True))
    return first, second


def _over_ground(path: Path) -> bool:
    """Whether the ordinate is an altitude over the sphere along which the abscissa goes."""
    return isinstance(path.x, Arc) and path.y.label.rpartition(".")[2] == "altitude"


def _axis(signal: Signal | Arc, scale: float) -> str:
    return labelled(signal.label, "km" if scale != 1.0 else shown_unit(signal.unit_name))


def _draw_point(axes: Axes, point: Point, position: tuple[np.ndarray, np.ndarray], index: int) -> None:
    """Everywhere where a position has stood, smaller than where it stands last."""
    places = np.stack(position)
    places = places[:, np.all(np.isfinite(places), axis=0)]
    if not places.size:
        return
    moved = np.concatenate([[True], np.any(np.diff(places, axis=1) != 0.0, axis=0)])
    style = look(index)
    axes.plot(*places[:, moved], linestyle="", marker=style.marker, markersize=4, color=style.colour)
    axes.plot(
        *places[:, -1], linestyle="", marker=style.marker, markersize=9, markerfacecolor="none",
        markeredgewidth=1.6, color=style.colour, label=point.name,
    )  # fmt: skip


def _reading(path: Path, beyond: bool) -> list[Markup]:
    words = Markup("ring: the end")
    if path.points:
        names = ", ".join(f"{point.name} ({point.x.label}, {point.y.label})" for point in path.points)
        words = Markup("{}; marks: {} wherever it stood, large where it stands last").format(words, names)
    if path.rows is not None:
        words = Markup("{}; where {}").format(words, choice(path.rows))
    scale = Markup("both axes to one scale") if path.equal else Markup("axes to different scales")
    words = Markup("{}; {}").format(words, scale)
    if isinstance(path.x, Arc):
        words = Markup("{}; range: along the ground, from the origin to below {}").format(words, path.x.position.label)
        if beyond:
            words = Markup("{}, beyond a quarter of the circumference along the great circle of the track").format(
                words
            )
    if _over_ground(path):
        words = Markup("{}; dark line: the surface").format(words)
    return [sentence(words), *(Markup("{}").format(note) for note in path.notes)]
