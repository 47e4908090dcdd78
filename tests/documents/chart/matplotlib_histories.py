"""Charts over time as matplotlib draws them, read back out of its figure."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes

from perilune.analysis.documents.common.colours import FAINT, GREEN, INK, ORANGE
from perilune.analysis.documents.common.panels import HALF_WIDTH
from perilune.analysis.documents.common.quantities import display_factor, display_unit
from perilune.analysis.documents.common.style import WIDTH, house_style, new_figure, plain_ticks
from perilune.analysis.documents.figures.declared import BandFigure, CurveFigure, ErrorFigure
from perilune.analysis.documents.interactive.charts import Chart
from perilune.analysis.documents.of.simulation.figures import band_figure, history_figures
from perilune.analysis.documents.of.simulation.figures.section import HEIGHT, select_rows
from perilune.analysis.runtime.flight.results import FlightResult
from tests.support.figures.lines import plot_quantity
from tests.support.figures.read_figure import read_charts


def _read(unit: str, time: np.ndarray, draw: Callable[[Axes], None], width: float = HALF_WIDTH) -> Chart:
    with house_style():
        figure = new_figure(HEIGHT, width)
        axes = figure.subplots()
        draw(axes)
        axes.set_xlim(time[0], time[-1] if time[-1] > time[0] else time[0] + 1.0)
        axes.set_xlabel("time, s")
        axes.set_title(unit, loc="left", pad=4)
        plain_ticks(axes, x=6 if width < WIDTH else 12, y=5)
        (chart,) = read_charts(figure, reduced=False)
    return chart


def error_charts(error: ErrorFigure, run: FlightResult) -> list[Chart]:
    """Return the panels of an error, as `history_figures` orders them."""
    chosen, rows = select_rows(error.rows, run)
    time = run.time[rows]
    values = np.where(chosen, error.estimate.values(run) - error.truth.values(run), np.nan)[:, rows]
    stated = np.zeros_like(values) if error.sigma is None else error.sigma.values(run)[:, rows]
    sigma = np.where(stated > 0.0, stated, np.nan)
    name, factor = error.estimate.unit_name, display_factor(error.estimate.unit_name)
    few = np.linspace(0, time.size - 1, min(time.size, history_figures.MOST_ROWS)).round().astype(int)
    charts = []
    for index, label in enumerate(error.labels):

        def draw(axes: Axes, bound: float | None = None, index: int = index, label: str = label) -> None:
            for times, shade in zip(history_figures.SIGMAS, (0.20, 0.40), strict=True):
                half = factor * times * sigma[index][few]
                axes.fill_between(time[few], -half, half, color=ORANGE, alpha=shade, linewidth=0.0)
            axes.axhline(0.0, color=FAINT, linewidth=0.8)
            plot_quantity(axes, time, values[index], label or error.title, name)
            if bound is not None:
                axes.set_ylim(-factor * bound, factor * bound)

        charts.append(_read(display_unit(name), time, draw))
        bound = history_figures._final_range(values[index], sigma[index])
        if bound is not None:
            charts.append(_read(display_unit(name), time, lambda axes, bound=bound, draw=draw: draw(axes, bound)))  # type: ignore[misc]
    return charts


def curve_charts(curve: CurveFigure, run: FlightResult) -> list[Chart]:
    """Return the plot of curves as wide as the page, or their panels."""
    chosen, rows = select_rows(curve.rows, run)
    time = run.time[rows]
    values = [np.where(chosen, signal.values(run)[0], np.nan)[rows] for signal in curve.signals]
    name = curve.signals[0].unit_name

    def draw(axes: Axes, which: range) -> None:
        for limit in (curve.low, curve.high):
            if limit is not None:
                axes.axhline(display_factor(name) * limit, color=FAINT, linewidth=0.9, linestyle=(0, (5, 3)))
        for index in which:
            plot_quantity(axes, time, values[index], curve.signals[index].label, name, index if curve.together else 0)

    if len(values) == 1 or curve.together:
        whole = range(len(values))
        return [_read(display_unit(name), time, lambda axes: draw(axes, whole), WIDTH)]
    return [
        _read(display_unit(name), time, lambda axes, index=index: draw(axes, range(index, index + 1)))  # type: ignore[misc]
        for index in range(len(values))
    ]


def band_charts(band: BandFigure, run: FlightResult) -> list[Chart]:
    """Return the whole history of a band and its zoom."""
    time, name = run.time, band.signal.unit_name
    factor = display_factor(name)
    row = band_figure.settling_row(np.logical_and.reduce(band_figure.inside(band, run)))
    low, high = (None if limit is None else factor * limit for limit in (band.low, band.high))
    zoom = None if low is None or high is None else band_figure._zoom_limits(band.plot_values(run), low, high)

    def draw(axes: Axes, limits: tuple[float, float] | None = None) -> None:
        for index, (element, line) in enumerate(zip(band.line_names, band.values(run), strict=True)):
            plot_quantity(axes, time, line, element, name, index)
        for limit in (low, high):
            if limit is not None:
                axes.axhline(limit, color=FAINT, linewidth=0.8)
        bottom, top = axes.get_ylim()
        axes.axhspan(
            bottom if low is None else low, top if high is None else high, color=GREEN, alpha=0.16, linewidth=0.0
        )
        axes.set_ylim(bottom, top)
        for begin, end in band_figure._spans(band, run):
            axes.axvspan(begin, end, color=FAINT, alpha=0.35, linewidth=0.0)
        if limits is not None:
            axes.set_ylim(limits)
        if row:
            axes.axvline(time[row], color=INK, linewidth=0.9, linestyle=(0, (1, 2)))

    charts = [_read(display_unit(name), time, draw)]
    return charts if zoom is None else [*charts, _read(display_unit(name), time, lambda axes: draw(axes, zoom))]
