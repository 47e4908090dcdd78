"""A scalar over another scalar as a path, with further positions as marks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from .....runtime.flight.results import FlightResult
from ....cell import Inline, LegendEntry
from ....chart.axes import linear_axis
from ....chart.equal import Ends, to_scale
from ....chart.marks import horizontal_line
from ....chart.panel import POINTS
from ....chart.quantity import quantity_curve
from ....chart.symbols import marker, marks
from ....chart.ticks import axis_ends
from ....common.colours import BLUE, INK, look
from ....common.panels import HALF_WIDTH, choose_length_unit
from ....common.quantities import display_unit, label_with_unit
from ....figures.declared import Arc, PathFigure, Signal
from ....interactive.charts import NO_BOX, Chart, Curve, Marker
from ....model import Group
from ....pictures import Figure
from .figure_texts import condition_text, sentence
from .section import figure_group, select_rows

HEIGHT = 3.6  # in
EQUAL_HEIGHT = 3.4  # in, with equal scales, half as wide as the page's column
Y_MARGIN = 0.08  # margin beyond the ends of the ordinate, over its range
WIDE_INTERVALS, Y_INTERVALS = 10, 6  # largest numbers of intervals between ticks
WHITE = "#ffffff"


def path_section(path: PathFigure, result: FlightResult, name: str) -> Group:
    """Return the section of a path; ``name`` must be unique among the figures of a page."""
    chosen, rows = select_rows(path.rows, result)

    def plotted(signal: Signal | Arc) -> np.ndarray:
        return np.where(chosen, signal.plot_values(result)[0], np.nan)[rows]

    x, y = plotted(path.x), plotted(path.y)
    scales = _scales(path, x, y)
    others = [np.stack([scales[0] * plotted(each.x), scales[1] * plotted(each.y)]) for each in path.points]
    position, title = np.stack([scales[0] * x, scales[1] * y]), _axis(path.y, scales[1])

    ends = path_ends(path, position, others)
    chart_of = partial(path_chart, path, result.time[rows], position, others, _axis(path.x, scales[0]))
    description = f"{path.title}: {path.y.label} over {path.x.label}"
    if path.equal:
        chart = to_scale(chart_of, *ends, POINTS * HALF_WIDTH, POINTS * EQUAL_HEIGHT)
        figure = Figure(title, name, description, chart, EQUAL_HEIGHT)
    else:
        chart = replace(chart_of(*ends, WIDE_INTERVALS), title=title)
        figure = Figure("", name, description, chart, HEIGHT, is_wide=True)
    return figure_group(
        path.title,
        figures=[figure],
        legend=[LegendEntry(_final_mark(index), [each.name]) for index, each in enumerate(path.points, 1)],
        notes=[_caption(path), *path.notes],
    )


def path_ends(path: PathFigure, position: np.ndarray, others: Sequence[np.ndarray]) -> tuple[Ends, Ends]:
    """Return the ends of both axes around a path and its points, for `path_chart`."""
    x, y = np.concatenate([position, *others], axis=1)
    up = axis_ends(y, Y_MARGIN)
    if _over_ground(path) and not up[0] <= 0.0 <= up[1]:
        up = axis_ends(np.append(y, 0.0), Y_MARGIN)
    return axis_ends(x), up


def path_chart(
    path: PathFigure,
    time: np.ndarray,
    position: np.ndarray,
    others: Sequence[np.ndarray],
    label: str,
    x_ends: Ends,
    y_ends: Ends,
    intervals: int = 5,
) -> Chart:
    """Return the chart of a path at times (s), [n], through ``position``, [2, n] in units of the axes.

    Its curves are the path, its end, and for each of its points (``others``, [2, n]) all positions and the last one.
    ``label`` is the label of the abscissa, which has at most ``intervals`` intervals between ticks.
    """
    line = quantity_curve(position[0], position[1], path.y.label, None)
    end = marks(position[0, -1:], position[1, -1:], marker("o", 6.0, BLUE, fill=WHITE))
    curves = [replace(line, time=time), end]
    for index, (point, positions) in enumerate(zip(path.points, others, strict=True), 1):
        curves += _point_curves(point.name, positions, index)
    x, y = linear_axis(x_ends, intervals, label=label), linear_axis(y_ends, Y_INTERVALS)
    rules = [horizontal_line(0.0, INK, 0.8)] if _over_ground(path) else []
    return Chart(NO_BOX, x, y, curves=curves, rules=rules)


def _point_curves(name: str, position: np.ndarray, index: int) -> list[Curve]:
    """Return marks at all positions of a point, [2, n], the last one larger; no marks if no position is finite."""
    finite = position[:, np.all(np.isfinite(position), axis=0)]
    if not finite.size:
        return []
    style = look(index)
    new = np.concatenate([[True], np.any(np.diff(finite, axis=1) != 0.0, axis=0)])
    return [
        marks(finite[0, new], finite[1, new], marker(style.marker, 4.0, style.colour), name=name),
        marks(finite[0, -1:], finite[1, -1:], _final_mark(index), name=name),
    ]


def _final_mark(index: int) -> Marker:
    style = look(index)
    return marker(style.marker, 9.0, style.colour, fill="", width=1.6)


def _scales(path: PathFigure, x: np.ndarray, y: np.ndarray) -> tuple[float, float]:
    """Return the display factors of both axes: km for long lengths in m; equal for equal scales."""
    metres = [signal.unit_name == "m" for signal in (path.x, path.y)]
    if path.equal and all(metres):
        factor, _ = choose_length_unit(np.concatenate([x, y]))
        return factor, factor
    first, second = (
        choose_length_unit(values)[0] if is_length else 1.0 for values, is_length in zip((x, y), metres, strict=True)
    )
    return first, second


def _over_ground(path: PathFigure) -> bool:
    """Return True if the ordinate is the altitude above the sphere of the abscissa."""
    return isinstance(path.x, Arc) and path.y.label.rpartition(".")[2] == "altitude"


def _axis(signal: Signal | Arc, scale: float) -> str:
    return label_with_unit(signal.label, "km" if scale != 1.0 else display_unit(signal.unit_name))


def _caption(path: PathFigure) -> list[Inline]:
    text: list[Inline] = ["circle: end"]
    if path.points:
        names = ", ".join(f"{point.name} ({point.x.label}, {point.y.label})" for point in path.points)
        text.append(f"; marks: {names}, large: final")
    if path.rows is not None:
        text += ["; samples where ", *condition_text(path.rows)]
    text.append("; equal scales" if path.equal else "; not to scale")
    if isinstance(path.x, Arc):
        origin = "great circle of its track, 0 at the origin and increasing in the direction of flight"
        text.append(f"; downrange: distance of {path.x.position.label} along the {origin}")
    if _over_ground(path):
        text.append("; black line: surface")
    return sentence(text)
