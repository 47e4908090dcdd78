"""One section of a page: the plots, table and text of a figure that a system declares."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from markupsafe import Markup

from ...runtime.flight.results import Result
from ..chart.axes import linear_axis
from ..chart.panel import chart_panel, wide_figure
from ..common.colours import look
from ..common.page import Table, exact, with_exact
from ..common.panels import HALF_WIDTH, Panel, swatch
from ..common.quantities import MINUS, in_display_unit
from ..interactive.charts import NO_BOX, Area, Chart, Curve, Drawing, Rule
from .declared import Rows

HEIGHT = 2.6  # in


@dataclass(frozen=True)
class Section:
    """A heading with plots, ``panels`` side by side or one ``plot`` as wide as the page, and a table.

    ``legend`` are (swatch, label) of the series, ``findings`` the results, ``notes`` the captions.
    """

    title: str
    panels: list[Panel] = field(default_factory=list)
    plot: Drawing | None = None
    table: Table | None = None
    legend: list[tuple[Markup, str]] = field(default_factory=list)
    findings: list[Markup] = field(default_factory=list)
    notes: Sequence[str] = ()


def legend_of(labels: tuple[str, ...]) -> list[tuple[Markup, str]]:
    """The elements of a vector with their line styles; none for a scalar."""
    return [(swatch(look(index)), label) for index, label in enumerate(labels)] if len(labels) > 1 else []


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
    """Return a chart over time; ``ends`` are those of the ordinate, as displayed.

    There are at most ``intervals`` intervals between the ticks of the abscissa, ``y_intervals`` between the others.
    """
    abscissa = (float(time[0]), float(time[-1] if time[-1] > time[0] else time[0] + 1.0))
    x, y = linear_axis(abscissa, intervals, label="time, s"), linear_axis(ends, y_intervals)
    return Chart(NO_BOX, x, y, curves=curves, areas=areas, rules=rules)


def displayed(curves: Sequence[Curve]) -> np.ndarray:
    """Return all ordinates of curves, as displayed."""
    return np.concatenate([curve.displayed for curve in curves])


def history_panel(label: str, name: str, description: str, unit: str, chart: Chart) -> Panel:
    """Return a panel over time, half as wide as the page's column, with the ``unit`` above its axes."""
    return chart_panel(label, name, description, chart, HEIGHT, HALF_WIDTH, title=unit)


def wide_history(name: str, description: str, unit: str, chart: Chart) -> Drawing:
    """Return a plot over time as wide as the page, with the ``unit`` above its axes."""
    return wide_figure(name, description, chart, HEIGHT, title=unit)


def select_rows(rows: Rows | None, result: Result) -> tuple[np.ndarray, slice]:
    """Whether each sample belongs to a figure, and from the first of them to the last; at least one does."""
    chosen = np.ones(result.time.size, dtype=bool) if rows is None else rows.select(result)
    selected = np.flatnonzero(chosen)
    return chosen, slice(int(selected[0]), int(selected[-1]) + 1)


def align(values: Sequence[float | None], unit: str | None, digits: int = 5) -> list[Markup]:
    """Numbers of a column, all with the decimals of the largest at so many significant digits."""
    sizes = [abs(in_display_unit(value, unit)) for value in values if value is not None and math.isfinite(value)]
    maximum = max(sizes, default=0.0)
    places = max(0, digits - 1 - math.floor(math.log10(maximum))) if maximum > 0.0 else 0
    return [
        exact(value, unit)
        if value is None or not math.isfinite(value)
        else with_exact(repr(value), f"{in_display_unit(value, unit) + 0.0:.{places}f}".replace("-", MINUS))
        for value in values
    ]
