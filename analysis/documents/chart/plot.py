"""Charts drawn by matplotlib, for notebooks, PNG and PDF; only this file and `plot_marks.py` import it."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullFormatter

from ..common.colours import FAINT
from ..common.style import house_style
from ..common.svg import Picture
from ..interactive.charts import NO_BOX, Axis, Chart
from ..interactive.measures import AXES_WIDTH
from .layout import lay_out
from .plot_marks import line_style, plot_area, plot_curve, plot_dots, plot_note
from .svg.axes import STROKE, TITLE_GAP
from .write_svg import TrialPositions, no_trials

POINTS = 72.0  # points per inch
KEY_LINE = 0.22  # in


def plot_charts(
    charts: Sequence[Chart],
    height: float,
    width: float,
    *,
    columns: int = 1,
    titles: Sequence[str] = (),
    legends: Sequence[Sequence[str]] = (),
    key: Sequence[str] = (),
    trials: TrialPositions = no_trials,
) -> Figure:
    """Return a figure of charts, row by row; ``height`` and ``width`` (in) are the dimensions of one chart.

    A chart that has a box keeps it, other charts are laid out; in a single column the axes are aligned. ``titles`` and
    ``legends``, the labels of each chart's first curves, are above the axes. ``key`` contains the labels of first
    curves common to all charts, and is above the figure. ``trials`` returns the positions of marks of trials.
    """
    texts = [*titles, *[""] * (len(charts) - len(titles))]
    labels = [*legends, *[()] * (len(charts) - len(legends))]
    rows = -(-len(charts) // columns)
    with house_style():
        strip = KEY_LINE * -(-len(key) // columns)
        figure = Picture(figsize=(columns * width, rows * height + strip))
        whole = rows + strip / height
        placed = _lay_out(charts, POINTS * width, POINTS * height, texts, aligned=columns == 1)
        for index, (chart, text, legend) in enumerate(zip(placed, texts, labels, strict=True)):
            row, column = divmod(index, columns)
            left, top, wide, high = chart.box
            below = (rows - row - top - high) / whole
            bounds = ((column + left) / columns, below, wide / columns, high / whole)
            _plot(figure.add_axes(bounds), chart, text, legend, trials)
        if key:
            figure.legend(figure.axes[0].lines[: len(key)], key, loc="upper left", ncols=columns, handlelength=3.2)
    return figure


def _lay_out(
    charts: Sequence[Chart], width: float, height: float, titles: Sequence[str], *, aligned: bool
) -> list[Chart]:
    def placed(left: float) -> list[Chart]:
        return [
            chart if chart.box != NO_BOX else lay_out(chart, width, height, title=title, left=left)
            for chart, title in zip(charts, titles, strict=True)
        ]

    return placed(max(width * chart.box[0] for chart in placed(0.0)) if aligned else 0.0)


def _plot(axes: Axes, chart: Chart, title: str, legend: Sequence[str], trials: TrialPositions) -> None:
    _set_axis(axes, "x", chart.x)
    _set_axis(axes, "y", chart.y)
    for area in chart.areas:
        plot_area(axes, area)
    for rule in chart.rules:
        draw = axes.axvline if rule.upright else axes.axhline
        draw(rule.at, color=rule.colour, linewidth=rule.width, linestyle=line_style(rule.dashes))
    for dots in chart.dots:
        plot_dots(axes, dots, *trials(dots))
    for index, curve in enumerate(chart.curves):
        plot_curve(axes, curve, legend[index] if index < len(legend) else "_")
    for note in chart.notes:
        plot_note(axes, note)
    if not chart.x.size and not chart.y.size:
        axes.set_axis_off()
    axes.set_title(title, loc="left", pad=TITLE_GAP)
    if legend:
        axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=len(legend), borderaxespad=0.0)


def _set_axis(axes: Axes, which: str, stated: Axis) -> None:
    axis = axes.xaxis if which == "x" else axes.yaxis
    if stated.logarithmic:
        getattr(axes, f"set_{which}scale")("log")
    named = [(at, text) for at, text in stated.ticks if text] or list(stated.ticks)
    others = [at for at, text in stated.ticks if not text] if named != list(stated.ticks) else []
    axis.set_ticks([at for at, _ in named], [text for _, text in named])
    axis.set_minor_locator(FixedLocator(others))
    axis.grid(visible=stated.grid)
    axis.grid(visible=False, which="minor")
    axis.set_tick_params(which="both", labelsize=stated.size, length=STROKE if stated.marked else 0.0)
    axis.set_tick_params(which="minor", color=FAINT, width=AXES_WIDTH)
    axis.set_minor_formatter(NullFormatter())
    if stated.bare and which == "x":
        axis.set_tick_params(labelbottom=False)
    elif stated.bare:
        axis.set_tick_params(labelleft=False)
    axis.set_label_text(stated.label)
    getattr(axes, f"set_{which}lim")(stated.ends)
    getattr(axes, f"set_autoscale{which}_on")(False)
