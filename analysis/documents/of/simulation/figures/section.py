"""Elements of declared figures: charts over time, legends, a heading with its content."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .....runtime.flight.results import FlightResult
from ....cell import LegendEntry, Quantity, Rich
from ....chart.axes import linear_axis
from ....common.colours import look
from ....common.quantities import in_display_unit
from ....figures.declared import SampleRange
from ....interactive.charts import NO_BOX, Area, Chart, Curve, Rule
from ....model import Group, Node, Note, Table, Text
from ....pictures import Figure, Figures

HEIGHT = 2.6  # in


def figure_group(
    title: str,
    *,
    figures: Sequence[Figure] = (),
    legend: Sequence[LegendEntry] = (),
    findings: Sequence[Rich] = (),
    table: Table | None = None,
    notes: Sequence[Rich] = (),
) -> Group:
    """Return a heading with figures and their legend, findings, a table and captions."""
    nodes: list[Node] = [Figures(lambda: figures, legend, is_in_order=True)] if figures else []
    nodes += map(Text, findings)
    nodes += [table] if table is not None else []
    return Group(title, [*nodes, *map(Note, notes)])


def legend_of(labels: Sequence[str]) -> list[LegendEntry]:
    """Return the elements of a vector with their line styles; none for a scalar."""
    return [LegendEntry(look(index), [label]) for index, label in enumerate(labels)] if len(labels) > 1 else []


def time_chart(
    time: np.ndarray,
    curves: Sequence[Curve],
    ends: tuple[float, float],
    *,
    areas: Sequence[Area] = (),
    rules: Sequence[Rule] = (),
    intervals: int = 6,
    y_intervals: int = 5,
) -> Chart:
    """Return a chart over time; ``ends`` are the ends of the ordinate, as displayed.

    There are at most ``intervals`` intervals between ticks of the abscissa, and ``y_intervals`` of the ordinate.
    """
    abscissa = (float(time[0]), float(time[-1] if time[-1] > time[0] else time[0] + 1.0))
    x, y = linear_axis(abscissa, intervals, label="time, s"), linear_axis(ends, y_intervals)
    return Chart(NO_BOX, x, y, curves=curves, areas=areas, rules=rules)


def displayed(curves: Sequence[Curve]) -> np.ndarray:
    """Return all ordinates of curves, as displayed."""
    return np.concatenate([curve.displayed for curve in curves])


def history_figure(
    label: str, name: str, description: str, unit: str, chart: Chart, *, is_wide: bool = False
) -> Figure:
    """Return a figure over time with the ``unit`` above its axes."""
    return Figure(label, name, description, replace(chart, title=unit), HEIGHT, is_wide=is_wide)


def select_rows(rows: SampleRange | None, result: FlightResult) -> tuple[np.ndarray, slice]:
    """Return True for each sample of a figure, and the slice from the first to the last; at least one is selected."""
    chosen = np.ones(result.time.size, dtype=bool) if rows is None else rows.select(result)
    selected = np.flatnonzero(chosen)
    return chosen, slice(int(selected[0]), int(selected[-1]) + 1)


def align(values: Sequence[float | None], unit: str | None, digits: int = 5) -> list[Quantity]:
    """Return the numbers of a column with as many decimals as give the largest ``digits`` significant digits."""
    sizes = [abs(in_display_unit(value, unit)) for value in values if value is not None and math.isfinite(value)]
    maximum = max(sizes, default=0.0)
    places = max(0, digits - 1 - math.floor(math.log10(maximum))) if maximum > 0.0 else 0
    return [Quantity(value, unit, is_bare=True, decimals=places) for value in values]
