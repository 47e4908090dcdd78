"""Lines and areas of a chart, of the supported kinds; all others raise UnstatedError."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import FillBetweenPolyCollection, LineCollection
from matplotlib.colors import to_hex, to_rgba
from matplotlib.lines import Line2D
from matplotlib.markers import MarkerStyle
from matplotlib.patches import Circle, Patch, PathPatch, Polygon, Rectangle, StepPatch
from matplotlib.path import Path
from matplotlib.transforms import IdentityTransform, Transform

from perilune.analysis.documents.chart.plot_lines import QuantityLine, TrialDots
from perilune.analysis.documents.interactive.charts import Area, Curve, Dots, Marker, Rule
from perilune.analysis.documents.interactive.columns import Coarse
from perilune.analysis.documents.interactive.envelope import envelope
from tests.support.figures.unstated import UnstatedError

NOTHING = ("", "None", "none", " ", None)  # markers and line styles that draw nothing
STEPS = {"steps-post": True, "steps-pre": True, "default": False}
FILLED = (Rectangle, Circle, Polygon, PathPatch)
ROUND = {"o": 1.0, ".": 0.5}  # markers that are circles, with their diameter in units of the marker's size
FINE = 8.0  # points of a curved outline, a pixel of the figure


def read_curve(line: Line2D, reduced: bool) -> Curve:
    """Read a line over the data; ``reduced``: its envelope."""
    _check_line(line)
    style = line.get_drawstyle()
    if style not in STEPS:
        raise UnstatedError(f"draw style {style}")
    quantity = line if isinstance(line, QuantityLine) else None
    x, y = numbers_of(line.get_xdata(orig=False)), numbers_of(line.get_ydata(orig=False))
    exact = y if quantity is None else quantity.quantity
    if style == "steps-pre":
        x, exact = np.append(x[:1], x), np.concatenate([exact[:1], exact[1:], exact[-1:]])
    abscissa, ordinate = envelope(x, exact) if reduced else (x, exact)
    is_envelope = ordinate.size < exact.size
    return Curve(
        x=abscissa,
        y=Coarse(ordinate) if is_envelope else ordinate,
        factor=1.0 if quantity is None else quantity.factor,
        time=None if quantity is None or reduced else quantity.time,
        name="" if quantity is None else quantity.name,
        unit="" if quantity is None else quantity.unit,
        colour=to_hex(line.get_color()),
        opacity=_opacity(line.get_color(), line),
        width=line.get_linewidth(),
        dashes=_dashes(line),
        steps=STEPS[style],
        joined=line.get_linestyle() not in NOTHING,
        marker=_marker(line),
        beyond=not line.get_clip_on(),
        reduced=is_envelope,
        metric="" if quantity is None else quantity.metric,
    )


def read_dots(line: TrialDots) -> Dots:
    """Read marks of trials."""
    if line.get_marker() not in ("o", "x"):
        raise UnstatedError(f"marker {line.get_marker()}")
    size, cross = line.get_markersize(), line.get_marker() == "x"
    return Dots(
        variant=line.variant,
        names=line.names,
        success=line.success,
        colour=to_hex(line.get_color()),
        size=size,
        cross=cross,
    )


def read_rule(axes: Axes, line: Line2D) -> Rule:
    """Read a line across the axes."""
    _check_line(line)
    upright = line.get_transform() is axes.get_xaxis_transform(which="grid")
    if not upright and line.get_transform() is not axes.get_yaxis_transform(which="grid"):
        raise UnstatedError("a line neither over the data nor across the axes")
    along, across = numbers_of(line.get_xdata()), numbers_of(line.get_ydata())
    if upright:
        along, across = across, along
    if list(along) != [0.0, 1.0] or line.get_marker() not in NOTHING or _opacity(line.get_color(), line) < 1.0:
        raise UnstatedError("a line across a part of the axes")
    return Rule(
        at=float(across[0]),
        upright=upright,
        colour=to_hex(line.get_color()),
        width=line.get_linewidth(),
        dashes=_dashes(line),
    )


def read_steps(patch: StepPatch) -> Curve:
    """Read the outline of a histogram without a baseline as a line of steps."""
    values, edges, baseline = patch.get_data()
    if patch.get_fill() or baseline is not None or patch.orientation != "vertical" or patch.get_hatch():
        raise UnstatedError("a filled or hatched histogram")
    line = Line2D(
        edges, np.append(values, values[-1]), drawstyle="steps-post", color=patch.get_edgecolor(),
        linewidth=patch.get_linewidth(), linestyle=patch.get_linestyle(), alpha=patch.get_alpha(),
    )  # fmt: skip
    return read_curve(line, reduced=False)


def read_areas(axes: Axes, patch: Patch) -> Iterator[Area]:
    """Read the fill of a patch, and the strokes around it."""
    if type(patch) not in FILLED or patch.get_hatch() or patch.get_path_effects():
        raise UnstatedError(f"{type(patch).__name__}, or its hatches")
    fill: Any = to_rgba(patch.get_facecolor())
    edge: Any = to_rgba(patch.get_edgecolor())
    of_axes, unit = _transform_of(axes, patch)
    for points in _polygons(patch.get_path(), patch.get_patch_transform(), unit):
        if patch.get_fill() and fill[3] > 0.0:
            yield _area(points, of_axes, fill, 0.0, [])
        if edge[3] > 0.0 and patch.get_linewidth() > 0.0:
            strokes = np.repeat(points, 2, axis=0)[1:-1]
            yield _area(strokes, of_axes, edge, patch.get_linewidth(), _dashes(patch))


def read_collection(axes: Axes, collection: Any) -> Iterator[Area]:
    """Read the areas between lines, or unbroken strokes."""
    kind, edges = type(collection), collection.get_edgecolor()
    if kind not in (FillBetweenPolyCollection, LineCollection) or collection.get_hatch():
        raise UnstatedError(f"{kind.__name__}, or its hatches")
    if collection.get_transform() is not axes.transData or np.any(collection.get_offsets()):
        raise UnstatedError("areas that are not over the data")
    strokes = kind is LineCollection
    width = float(collection.get_linewidth()[0])
    if any(pattern for _, pattern in collection.get_linestyle()) or (not strokes and len(edges) and width > 0.0):
        raise UnstatedError("dashes or edges of areas")
    colours = edges if strokes else collection.get_facecolor()
    paths = collection.get_paths()
    for index, path in enumerate(paths):
        colour = colours[index % len(colours)]
        for points in _polygons(path, IdentityTransform(), axes.transData):
            rows = np.repeat(points, 2, axis=0)[1:-1] if strokes else points
            yield _area(rows, (False, False), colour, width if strokes else 0.0, [])


def numbers_of(sequence: Any) -> np.ndarray:
    """Return data of a line, nan where they are masked."""
    return np.ma.filled(np.ma.asarray(sequence, dtype=float), np.nan)


def _check_line(line: Line2D) -> None:
    if line.get_path_effects() or line.get_markevery() is not None or line.get_fillstyle() != "full":
        raise UnstatedError("a line with effects, or marks at some of its points")


def _marker(line: Line2D) -> Marker | None:
    kind, size = line.get_marker(), line.get_markersize()
    if kind in NOTHING or not size:
        return None
    style = MarkerStyle(kind)  # type: ignore[arg-type]  # none of those without a mark
    outline = []
    if kind not in ROUND:
        for points in _polygons(style.get_path(), style.get_transform(), IdentityTransform()):
            outline.append([round(float(number), 4) for number in points.ravel()])
    fill: Any = to_rgba(line.get_markerfacecolor())
    edge: Any = to_rgba(line.get_markeredgecolor())
    return Marker(
        size=size * ROUND.get(kind, 1.0) if isinstance(kind, str) else size,
        outline=outline,
        fill=to_hex(fill) if style.is_filled() and fill[3] > 0.0 else "",
        edge=to_hex(edge) if edge[3] > 0.0 and line.get_markeredgewidth() > 0.0 else "",
        width=line.get_markeredgewidth(),
    )


def _opacity(colour: Any, artist: Any) -> float:
    alpha = artist.get_alpha()
    return float(to_rgba(colour)[3] if alpha is None else alpha)


def _dashes(artist: Any) -> list[float]:
    """Return lengths of dashes and gaps in line widths; matplotlib has them before scaling only in a private
    attribute."""
    offset, pattern = artist._unscaled_dash_pattern
    if offset:
        raise UnstatedError("dashes that begin elsewhere")
    return [float(length) for length in pattern or ()]


def _polygons(path: Path, transform: Transform, unit: Transform) -> Iterator[np.ndarray]:
    """Yield the outlines of a path, [points, 2], every point of them; curves as chords, fine in pixels.

    `Path.to_polygons` leaves out points that are near to each other in units of the data.
    """
    placed = path.transformed(transform)
    if placed.codes is not None and np.isin(placed.codes, (Path.CURVE3, Path.CURVE4)).any():
        pixels = placed.transformed(unit)
        pixels = Path(FINE * np.asarray(pixels.vertices, dtype=float), pixels.codes).cleaned(
            simplify=False, curves=False
        )
        placed = Path(np.asarray(pixels.vertices)[:-1] / FINE, np.asarray(pixels.codes)[:-1])
        placed = placed.transformed(unit.inverted())
    vertices, codes = np.asarray(placed.vertices, dtype=float), placed.codes
    if codes is None:
        yield vertices
        return
    points: list[np.ndarray] = []
    for vertex, code in zip(vertices, np.asarray(codes, dtype=int), strict=True):
        if code == Path.MOVETO and len(points) > 1:
            yield np.array(points)
        if code == Path.MOVETO:
            points = []
        points.append(points[0] if code == Path.CLOSEPOLY else vertex)
    if len(points) > 1:
        yield np.array(points)


def _area(points: np.ndarray, of_axes: tuple[bool, bool], colour: Any, stroke: float, dashes: list[float]) -> Area:
    return Area(points[:, 0], points[:, 1], of_axes, to_hex(colour), float(colour[3]), stroke, dashes)


def _transform_of(axes: Axes, patch: Patch) -> tuple[tuple[bool, bool], Transform]:
    """Return the transform from units of a patch to pixels, and for each coordinate if it is a fraction of the axes."""
    transform = patch.get_data_transform()
    if transform is axes.get_xaxis_transform(which="grid"):
        return (False, True), transform
    if transform is axes.get_yaxis_transform(which="grid"):
        return (True, False), transform
    if transform is axes.transAxes:
        return (True, True), transform
    if transform is not axes.transData:
        raise UnstatedError("a patch neither over the data nor over the axes")
    return (False, False), transform
