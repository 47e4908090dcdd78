"""Paths, and bands over another signal, as matplotlib draws them, read back out of its figure."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes

from perilune.analysis.documents.common.colours import BLUE, FAINT, GREEN, look
from perilune.analysis.documents.common.panels import choose_length_unit
from perilune.analysis.documents.common.quantities import display_factor, label_with_unit
from perilune.analysis.documents.common.style import house_style, new_figure, plain_ticks
from perilune.analysis.documents.figures.declared import BandFigure, PathFigure, Signal
from perilune.analysis.documents.interactive.charts import Chart
from perilune.analysis.documents.of.simulation.figures.section import select_rows
from perilune.analysis.runtime.flight.results import FlightResult
from tests.support.figures.lines import plot_path, plot_quantity
from tests.support.figures.read_figure import read_charts


def _read(draw: Callable[[Axes], None], height: float, width: float) -> Chart:
    with house_style():
        figure = new_figure(height, width)
        draw(figure.subplots())
        (chart,) = read_charts(figure, reduced=False)
    return chart


def path_chart(path: PathFigure, run: FlightResult, height: float, width: float, intervals: int) -> Chart:
    """Return a path of scalars in m whose axes have separate scales."""
    chosen, rows = select_rows(path.rows, run)

    def line(signal: Signal) -> np.ndarray:
        return np.where(chosen, signal.plot_values(run)[0], np.nan)[rows]

    (across, x_unit), (up, y_unit) = choose_length_unit(line(path.x)), choose_length_unit(line(path.y))

    def draw(axes: Axes) -> None:
        x, y = across * line(path.x), up * line(path.y)
        plot_path(axes, x, y, path.y.label, run.time[rows])
        axes.plot(x[-1], y[-1], "o", markersize=6, markerfacecolor="white", color=BLUE)
        for index, point in enumerate(path.points, 1):
            points, style = np.stack([across * line(point.x), up * line(point.y)]), look(index)
            changes = np.concatenate([[True], np.any(np.diff(points, axis=1) != 0.0, axis=0)])
            axes.plot(*points[:, changes], linestyle="", marker=style.marker, markersize=4, color=style.colour)
            axes.plot(
                *points[:, -1:], linestyle="", marker=style.marker, markersize=9, markerfacecolor="none",
                markeredgewidth=1.6, color=style.colour,
            )  # fmt: skip
        axes.set_xlabel(label_with_unit(path.x.label, x_unit))
        axes.set_title(label_with_unit(path.y.label, y_unit), loc="left", pad=4)
        plain_ticks(axes, x=intervals, y=6)
        axes.margins(0.05, 0.08)

    return _read(draw, height, width)


def against_chart(band: BandFigure, run: FlightResult, other: Signal, height: float, width: float) -> Chart:
    """Return a band over another signal that spans no decades."""

    def draw(axes: Axes) -> None:
        across = other.plot_values(run)[0]
        for index, (element, line) in enumerate(zip(band.line_names, band.values(run), strict=True)):
            plot_quantity(axes, across, line, element, band.signal.unit_name, index, time=run.time)
        low, high = (display_factor(band.signal.unit_name) * limit for limit in (band.low, band.high))
        for limit in (low, high):
            axes.axhline(limit, color=FAINT, linewidth=0.8)
        ends = axes.get_ylim()
        axes.axhspan(low, high, color=GREEN, alpha=0.16, linewidth=0.0)
        axes.set_ylim(ends)
        axes.set_xlabel(label_with_unit(other.label, other.unit_name))
        plain_ticks(axes, x=6, y=5)

    return _read(draw, height, width)
