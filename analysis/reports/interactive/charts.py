"""A figure as numbers: its axes, lines, areas and notes, read from matplotlib's figure after it was drawn.

The page's script draws the same again at another zoom. A pair of axes with something that has no form here (an image,
scattered dots) has no chart; the page then keeps its picture.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Annotation, Text
from matplotlib.ticker import FixedFormatter

from .columns import Coarse
from .envelope import envelope
from .lines import QuantityLine, TrialDots


@dataclass(frozen=True)
class Axis:
    """An axis: its label, its ends as drawn, and the labels at fixed positions in place of numbers."""

    label: str
    ends: tuple[float, float]
    logarithmic: bool
    ticks: list[tuple[float, str]]


@dataclass(frozen=True)
class Curve:
    """A line; ``time`` (s) where its abscissa is another quantity; ``reduced`` where it is the envelope of its rows;
    ``metric`` where it is the distribution of that over the trials of a variant.
    """

    x: np.ndarray
    y: np.ndarray | Coarse
    factor: float
    time: np.ndarray | None
    name: str
    unit: str
    colour: str
    width: float
    dashes: list[float]
    steps: bool
    joined: bool
    marker: float
    filled: bool
    reduced: bool
    metric: str


@dataclass(frozen=True)
class Dots:
    """Marks of trials, `TrialDots`; ``cross`` or a filled circle."""

    variant: str
    names: tuple[str, str]
    success: bool
    colour: str
    size: float
    cross: bool


@dataclass(frozen=True)
class Area:
    """A filled polygon, or strokes from each second point to the next; a coordinate is of the data or of the axes."""

    x: np.ndarray
    y: np.ndarray
    of_axes: tuple[bool, bool]
    colour: str
    opacity: float
    stroke: float


@dataclass(frozen=True)
class Rule:
    """A straight line across the axes, at ``at`` of the abscissa (``upright``) or of the ordinate."""

    at: float
    upright: bool
    colour: str
    width: float
    dashes: list[float]


@dataclass(frozen=True)
class Note:
    """A text at a point of the data or of the axes, ``offset`` (pt) from it to the right and up."""

    text: str
    at: tuple[float, float]
    of_axes: bool
    offset: tuple[float, float]
    align: tuple[str, str]
    colour: str
    bold: bool


@dataclass(frozen=True)
class Chart:
    """A pair of axes; ``box`` is left, top, width and height of their area as fractions of the figure.

    ``title`` is written above its left end, ``aside`` above the right one.
    """

    box: list[float]
    title: str
    aside: str
    x: Axis
    y: Axis
    equal: bool
    curves: list[Curve]
    dots: list[Dots]
    areas: list[Area]
    rules: list[Rule]
    notes: list[Note]


def read_charts(figure: Figure, *, reduced: bool = False) -> list[Chart | None]:
    """The charts of a figure that was drawn, None for axes without one; ``reduced``: envelopes of their lines."""
    return [_read_axes(axes, reduced) for axes in figure.axes]


def _read_axes(axes: Axes, reduced: bool) -> Chart | None:
    if axes.images or not all(isinstance(each, PolyCollection) for each in axes.collections):
        return None
    dots = [line for line in axes.lines if isinstance(line, TrialDots)]
    plain = [line for line in axes.lines if line.get_transform() is axes.transData and line not in dots]
    bounds = axes.get_position()
    return Chart(
        box=[round(float(each), 5) for each in (bounds.x0, 1.0 - bounds.y1, bounds.width, bounds.height)],
        title=axes.get_title(loc="left"),
        aside=axes.get_title(loc="right"),
        x=_axis(axes.xaxis, axes.get_xlim(), _label(axes, "x")),
        y=_axis(axes.yaxis, axes.get_ylim(), _label(axes, "y")),
        equal=axes.get_aspect() != "auto",
        curves=[_curve(line, reduced) for line in plain],
        dots=[_dots(line) for line in dots],
        areas=list(_areas(axes)),
        rules=[_rule(axes, line) for line in axes.lines if line not in (*plain, *dots)],
        notes=[_note(axes, text) for text in axes.texts if text.get_text()],
    )


def _label(axes: Axes, which: str) -> str:
    """The label of an axis, which of axes that share theirs only one has, or the figure."""
    shared = axes.get_shared_x_axes() if which == "x" else axes.get_shared_y_axes()
    labels = [getattr(each, f"get_{which}label")() for each in (axes, *shared.get_siblings(axes))]
    return next(filter(None, labels), getattr(axes.get_figure(root=True), f"get_sup{which}label")())


def _axis(axis: Any, ends: tuple[float, float], label: str) -> Axis:
    formatter = axis.get_major_formatter()
    ticks = []
    if isinstance(formatter, FixedFormatter):
        ticks = [(float(at), str(text)) for at, text in zip(axis.get_majorticklocs(), formatter.seq, strict=False)]
    return Axis(label, (float(ends[0]), float(ends[1])), axis.get_scale() == "log", ticks)


def _curve(line: Line2D, reduced: bool) -> Curve:
    quantity = line if isinstance(line, QuantityLine) else None
    x, y = _numbers(line.get_xdata(orig=False)), _numbers(line.get_ydata(orig=False))
    exact = y if quantity is None else quantity.quantity
    abscissa, ordinate = envelope(x, exact) if reduced else (x, exact)
    is_envelope = ordinate.size < exact.size
    marked = line.get_marker() not in ("", "None", "none", None)
    return Curve(
        x=abscissa,
        y=Coarse(ordinate) if is_envelope else ordinate,
        factor=1.0 if quantity is None else quantity.factor,
        time=None if quantity is None or reduced else quantity.time,
        name="" if quantity is None else quantity.name,
        unit="" if quantity is None else quantity.unit,
        colour=to_hex(line.get_color()),
        width=line.get_linewidth(),
        dashes=_dashes(line),
        steps=line.get_drawstyle() == "steps-post",
        joined=line.get_linestyle() not in ("", "None", "none", None),
        marker=line.get_markersize() if marked else 0.0,
        filled=to_hex(line.get_markerfacecolor(), keep_alpha=True) == to_hex(line.get_color(), keep_alpha=True),
        reduced=is_envelope,
        metric="" if quantity is None else quantity.metric,
    )


def _dots(line: TrialDots) -> Dots:
    size, cross = line.get_markersize(), line.get_marker() == "x"
    return Dots(line.variant, line.names, line.success, to_hex(line.get_color()), size, cross)


def _numbers(sequence: Any) -> np.ndarray:
    return np.ma.filled(np.ma.asarray(sequence, dtype=float), np.nan)


def _dashes(line: Line2D) -> list[float]:
    """Lengths of dashes and gaps in pt; matplotlib has them before scaling only in a private attribute."""
    pattern = line._unscaled_dash_pattern[1]  # type: ignore[attr-defined]
    return [float(length) for length in pattern or ()]


def _rule(axes: Axes, line: Line2D) -> Rule:
    upright = line.get_transform() is axes.get_xaxis_transform(which="grid")
    at = _numbers(line.get_xdata() if upright else line.get_ydata())[0]
    return Rule(float(at), upright, to_hex(line.get_color()), line.get_linewidth(), _dashes(line))


def _areas(axes: Axes) -> Iterator[Area]:
    for patch in axes.patches:
        path = patch.get_path().transformed(patch.get_patch_transform())
        colour: Any = patch.get_facecolor() if patch.get_fill() else patch.get_edgecolor()
        stroke = 0.0 if patch.get_fill() else patch.get_linewidth()
        for polygon in path.to_polygons(closed_only=False):
            points = np.asarray(polygon)
            strokes = np.repeat(points, 2, axis=0)[1:-1] if stroke else points
            yield _area(strokes, _of_axes(axes, patch), colour, stroke)
    for collection in axes.collections:
        for path, colour in zip(collection.get_paths(), collection.get_facecolor(), strict=False):
            for polygon in path.to_polygons(closed_only=False):
                yield _area(np.asarray(polygon), (False, False), colour, 0.0)


def _area(points: np.ndarray, of_axes: tuple[bool, bool], colour: Any, stroke: float) -> Area:
    return Area(points[:, 0], points[:, 1], of_axes, to_hex(colour), float(colour[3]), stroke)


def _of_axes(axes: Axes, patch: Patch) -> tuple[bool, bool]:
    """Whether abscissa and ordinate of a patch are fractions of the axes."""
    transform = patch.get_data_transform()
    if transform is axes.get_xaxis_transform(which="grid"):
        return False, True
    if transform is axes.get_yaxis_transform(which="grid"):
        return True, False
    return (True, True) if transform is axes.transAxes else (False, False)


def _note(axes: Axes, text: Text) -> Note:
    is_annotation = isinstance(text, Annotation)
    offset = text.xyann if is_annotation else (0.0, 0.0)  # type: ignore[attr-defined]
    at: Any = text.xy if is_annotation else text.get_position()  # type: ignore[attr-defined]
    return Note(
        text=text.get_text(),
        at=(float(at[0]), float(at[1])),
        of_axes=not is_annotation and text.get_transform() is axes.transAxes,
        offset=(float(offset[0]), float(offset[1])),
        align=(text.get_horizontalalignment(), text.get_verticalalignment()),
        colour=to_hex(text.get_color()),
        bold=text.get_fontweight() in ("bold", 700),
    )
