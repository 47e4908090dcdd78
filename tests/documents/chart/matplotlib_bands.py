"""Bands over time as matplotlib draws them, read back out of its figure."""

from __future__ import annotations

from perilune.analysis.documents.common.colours import FAINT
from perilune.analysis.documents.common.style import house_style, new_figure, plain_ticks
from perilune.analysis.documents.interactive.charts import Chart
from perilune.analysis.documents.of.comparison.flights.band_figures import QuantityFrame
from perilune.analysis.documents.of.comparison.flights.bands import Bands
from tests.support.figures.axes import FAILED
from tests.support.figures.read_figure import read_charts


def read_bands(bands: Bands, frame: QuantityFrame, colour: str, *, is_stepped: bool) -> Chart:
    """Return the chart of `band_chart` whose range is not clipped."""
    with house_style():
        figure = new_figure(2.1, 3.4)
        axes = figure.subplots()
        rows = frame.factor * bands.percentiles
        style = "steps-post" if is_stepped else "default"
        for low, high, shade in ((0, 4, 0.18), (1, 3, 0.32)):
            axes.fill_between(
                bands.time, rows[low], rows[high], color=colour, alpha=shade, linewidth=0.0,
                step="post" if is_stepped else None,
            )  # fmt: skip
        for time, values in bands.failed:
            axes.plot(time, frame.factor * values, linewidth=0.6, alpha=0.45, zorder=0.9, drawstyle=style, **FAILED)
        for time, values in bands.singles:
            axes.plot(time, frame.factor * values, color=FAINT, linewidth=0.6, drawstyle=style)
        axes.plot(bands.time, rows[2], color=colour, linewidth=1.8, drawstyle=style)
        for value in frame.expected:
            axes.axhline(frame.factor * value, linewidth=0.9, **FAILED)
        start, end = frame.time
        margin = 0.06 * (frame.high - frame.low) or 0.06 * abs(frame.high) or 1.0
        axes.set_xlim(start, end + 0.02 * (end - start))
        axes.set_ylim(frame.factor * (frame.low - margin), frame.factor * (frame.high + margin))
        axes.set_xlabel("time, s")
        plain_ticks(axes, x=5, y=5, whole_y=frame.held)
        (chart,) = read_charts(figure, reduced=False)
    return chart
