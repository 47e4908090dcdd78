"""Curves, areas, marks of trials and notes of charts drawn by matplotlib."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.markers import MarkerStyle
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.typing import LineStyleType

from ..interactive.charts import Area, Backing, ChartNote, Curve, Dots, Marker
from .plot_lines import QuantityLine, TrialDots
from .svg.marks import CROSS_WIDTH
from .symbols import OUTLINES

SYSTEMS = {False: "data", True: "axes fraction"}


def line_style(dashes: Sequence[float]) -> LineStyleType:
    """Return matplotlib's dash style, in multiples of the line width."""
    return (0, tuple(dashes)) if dashes else "-"


def plot_curve(axes: Axes, curve: Curve, label: str) -> None:
    """Draw a curve and its marks; a ``label`` that begins with _ appears in no legend."""
    line = QuantityLine(
        curve.x,
        curve.displayed / curve.factor,
        name=curve.name,
        unit=curve.unit,
        factor=curve.factor,
        time=curve.time,
        metric=curve.metric,
        label=label,
        color=curve.colour,
        alpha=curve.opacity if curve.opacity < 1.0 else None,
        linewidth=curve.width,
        linestyle=line_style(curve.dashes) if curve.joined else "none",
        drawstyle="steps-post" if curve.steps else "default",
    )
    if curve.marker is not None:
        _set_marker(line, curve.marker)
    axes.add_line(line)
    line.set_clip_on(not curve.beyond)


def _set_marker(line: QuantityLine, marker: Marker) -> None:
    outline = tuple(tuple(stroke) for stroke in marker.outline)
    letters = {shape: letter for letter, shape in OUTLINES.items()}
    size = marker.size
    if not outline:
        line.set_marker("o")
    elif outline in letters:
        line.set_marker(letters[outline])
    else:
        path = _path([np.reshape(stroke, (-1, 2)) for stroke in outline])
        line.set_marker(MarkerStyle(path))
        size *= 2.0 * float(np.abs(path.vertices).max())  # matplotlib scales paths to a size of 1
    line.set_markersize(size)
    line.set_markerfacecolor(marker.fill or "none")
    line.set_markeredgecolor(marker.edge or "none")
    line.set_markeredgewidth(marker.width)


def plot_area(axes: Axes, area: Area) -> None:
    """Draw a filled polygon, or strokes."""
    points = np.stack([area.x, area.y], axis=1)
    across, up = area.of_axes
    transform = axes.transAxes if across and up else axes.transData
    if across != up:
        transform = axes.get_yaxis_transform() if across else axes.get_xaxis_transform()
    colour = (area.colour, area.opacity)
    patch = PathPatch(_path(np.reshape(points, (-1, 2, 2))) if area.stroke else Path(points), transform=transform)
    patch.set(fill=not area.stroke, linewidth=area.stroke, linestyle=line_style(area.dashes), capstyle="butt")
    patch.set_facecolor("none" if area.stroke else colour)
    patch.set_edgecolor(colour if area.stroke else "none")
    axes.add_patch(patch)


def _path(strokes: Sequence[np.ndarray] | np.ndarray) -> Path:
    """Return strokes as one path, consecutive ones joined."""
    points: list[np.ndarray] = []
    codes: list[np.uint8] = []
    for stroke in strokes:
        follows = bool(points) and np.array_equal(points[-1], stroke[0])
        points += [*stroke[1 if follows else 0 :]]
        codes += [] if follows else [Path.MOVETO]
        codes += [Path.LINETO] * (len(stroke) - 1)
    return Path(np.array(points), codes)


def plot_dots(axes: Axes, dots: Dots, x: np.ndarray, y: np.ndarray) -> None:
    """Draw the marks of trials, rasterised within vector graphics."""
    line = TrialDots(
        x, y, variant=dots.variant, names=dots.names, success=dots.success, color=dots.colour, linestyle="none",
        marker="x" if dots.cross else "o", markersize=dots.size, rasterized=x.size > CROWD,
        markeredgewidth=CROSS_WIDTH * dots.size if dots.cross else 0.0,
    )  # fmt: skip
    axes.add_line(line)


CROWD = 3000  # number of dots from which they are rasterised


def plot_note(axes: Axes, note: ChartNote) -> None:
    """Draw a note at its point."""
    axes.annotate(
        note.text, note.at, note.offset, (SYSTEMS[note.of_axes[0]], SYSTEMS[note.of_axes[1]]), "offset points",
        ha=note.align[0], va=note.align[1], color=note.colour, fontsize=note.size, bbox=_box(note, note.backing),
        fontweight="bold" if note.bold else "normal",
    )  # fmt: skip


def _box(note: ChartNote, backing: Backing | None) -> dict[str, object] | None:
    if backing is None:
        return None
    style = f"square,pad={backing.margin / note.size!r}"
    return {"boxstyle": style, "facecolor": (backing.colour, backing.opacity), "edgecolor": "none"}
