"""View of trajectories as a chart: paths, times along the first one, ends, ground."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...chart.axes import linear_axis
from ...chart.equal import Ends, to_scale
from ...chart.layout import axes_size, lay_out, lay_out_fluid
from ...chart.marks import horizontal_band, horizontal_line
from ...chart.quantity import quantity_curve
from ...chart.symbols import marker, marks
from ...chart.ticks import axis_ends
from ...common.colours import GRID, INK, look
from ...common.panels import choose_length_unit
from ...interactive.charts import NO_BOX, Chart, Curve
from .times_on_path import mark_rows, time_notes

MAXIMUM_RATIO = 4.0  # largest ratio of the ranges of both axes with equal scales
X_MARGIN, Y_MARGIN = 0.1, 0.12  # margins beyond the ends, over the ranges
X_INTERVALS, Y_INTERVALS = 5, 6  # largest numbers of intervals between ticks
WHITE = "#ffffff"
GROUND = 0.05  # depth of the grey ground over the height


class View(NamedTuple):
    """A view: heading, identifier, and paths of abscissas and ordinates in m, [2, samples], at times (s), [samples].

    ``labels`` are the names of the paths, ``names`` are the names of the axes; ``has_ground`` draws the ground at 0.
    """

    title: str
    name: str
    paths: Sequence[np.ndarray]
    labels: Sequence[str]
    time: np.ndarray
    names: tuple[str, str]
    has_ground: bool = False


def view_chart(view: View, width: float, height: float, *, fluid: bool = True) -> tuple[Chart, str, str]:
    """Return the chart of a view in a figure of this size (pt), the ordinate's label, and a remark on scales.

    Its curves are the paths, followed by the dots at times and the circle at the end of each. ``fluid`` is as in
    `to_scale`.
    """
    everything = np.concatenate(view.paths, axis=1)
    ranges = np.ptp(everything, axis=1)
    if view.has_ground:
        ranges[1] = max(ranges[1], float(np.nanmax(everything[1])))
    is_equal = _is_legible_to_scale(*ranges)
    both = choose_length_unit(everything)
    scales, units = zip(*((both, both) if is_equal else map(choose_length_unit, everything)), strict=True)
    paths = [np.array(scales)[:, None] * path for path in view.paths]
    rows = mark_rows(view.time)
    curves, depth = _curves(view, paths, rows), GROUND * scales[1] * ranges[1]
    areas, rules = (
        ([horizontal_band(-depth, 0.0, GRID, 1.0)], [horizontal_line(0.0, INK, 0.8)]) if view.has_ground else ([], [])
    )
    x, y = np.concatenate(paths, axis=1)
    ends = axis_ends(x, X_MARGIN), axis_ends(np.append(y, [-depth, 0.0]) if view.has_ground else y, Y_MARGIN)
    ordinate = f"{view.names[1]}, {units[1]}"

    def chart_of(x_ends: Ends, y_ends: Ends) -> Chart:
        abscissa = linear_axis(x_ends, X_INTERVALS, label=f"{view.names[0]}, {units[0]}")
        return Chart(NO_BOX, abscissa, linear_axis(y_ends, Y_INTERVALS), curves=curves, areas=areas, rules=rules)

    if is_equal:
        chart = to_scale(chart_of, *ends, width, height, title=ordinate, fluid=fluid)
    else:
        lay = lay_out_fluid if fluid else lay_out
        chart = lay(chart_of(*ends), width, height, title=ordinate)
    notes = time_notes(chart, axes_size(chart, width, height), paths, view.time, rows)
    return replace(chart, notes=notes), ordinate, "equal scales" if is_equal else "not to scale"


def _curves(view: View, paths: Sequence[np.ndarray], rows: np.ndarray) -> list[Curve]:
    lines, dots = [], []
    for index, (path, label) in enumerate(zip(paths, view.labels, strict=True)):
        lines.append(replace(quantity_curve(path[0], path[1], label, None, index), time=view.time))
        colour = look(index).colour
        dots.append(marks(path[0, rows], path[1, rows], marker("o", 3.5, colour), name=label))
        dots.append(marks(path[0, -1:], path[1, -1:], marker("o", 6.0, colour, fill=WHITE), name=label))
    return [*lines, *dots]


def _is_legible_to_scale(width: float, height: float) -> bool:
    """Return True if the path remains legible with equal scales of both axes."""
    return height > 0.0 and 1.0 / MAXIMUM_RATIO <= width / height <= MAXIMUM_RATIO
