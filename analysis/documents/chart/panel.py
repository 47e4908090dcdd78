"""A chart as a panel of a page: its picture, and its data for the page's script."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..common.panels import PANEL_HEIGHT, PANEL_WIDTH, FigurePanel
from ..interactive.charts import NO_BOX, Chart, Curve, Drawing
from ..interactive.columns import Coarse, has_enough_digits
from ..interactive.envelope import envelope
from .layout import BROAD, lay_out_fluid
from .svg.fluid import POINT
from .write_svg import TrialPositions, no_trials, write_svg

POINTS = 72.0  # points per inch
ABSCISSA = 0.36  # in, height of an abscissa's tick labels and label


def chart_panel(
    label: str,
    name: str,
    description: str,
    chart: Chart,
    height: float = PANEL_HEIGHT,
    width: float = PANEL_WIDTH,
    *,
    title: str = "",
    kind: str = "",
    trials: TrialPositions = no_trials,
    reduced: bool = False,
) -> FigurePanel:
    """Return the panel of a ``chart``, sizes in inches; ``name`` must be unique among the figures of a page.

    A chart that has a box keeps it, other charts are laid out; text has the same size at any width. ``title`` is above
    the axes, and ``kind`` is an additional CSS class. ``trials`` returns the positions of marks of trials. ``reduced``
    embeds only envelopes of the curves. A chart whose numbers exceed the resolution of the page remains a picture.
    """
    across, up = POINTS * width, POINTS * height
    placed = chart if chart.box != NO_BOX else lay_out_fluid(chart, across, up, title=title)
    svg = write_svg(placed, name, description, across, up, title=title, kind=kind, trials=trials)
    if not _is_exact(placed):
        return FigurePanel(label, Drawing(svg, [_picture(placed)]))
    curves = [_reduce(curve) for curve in placed.curves] if reduced else placed.curves
    return FigurePanel(label, Drawing(svg, [replace(placed, curves=curves)]))


def wide_figure(name: str, description: str, chart: Chart, height: float, *, title: str = "") -> Drawing:
    """Return the figure of a ``chart`` of full page width; arguments are as in `chart_panel`."""
    return chart_panel("", name, description, chart, height, BROAD / POINTS, title=title).figure


def stack_panel(
    label: str, name: str, description: str, charts: tuple[Chart, Chart], height: float, width: float = PANEL_WIDTH
) -> FigurePanel:
    """Return the panel of two charts over a common abscissa, labelled at the lower chart; sizes in inches."""
    upper, lower = charts
    stacked = (replace(upper, x=replace(upper.x, bare=True)), lower)
    heights = [(height - ABSCISSA) / 2.0, (height + ABSCISSA) / 2.0]

    def lay_out_both(left: float = 0.0, right: float = 0.0) -> list[Chart]:
        return [
            lay_out_fluid(chart, POINTS * width, POINTS * high, title=chart.title, left=left, right=right)
            for chart, high in zip(stacked, heights, strict=True)
        ]

    left, _, right, _ = np.max([chart.fluid.margins for chart in lay_out_both() if chart.fluid], axis=0) / POINT
    above, below = (
        chart_panel(label, f"{name}-{order}", f"{description}; {chart.title}", chart, high, width, title=chart.title)
        for order, (chart, high) in enumerate(zip(lay_out_both(left, right), heights, strict=True))
    )
    return FigurePanel(label, above.figure._replace(below=below.figure))


def _picture(chart: Chart) -> Chart:
    return Chart(chart.box, chart.x, chart.y, picture=True, fluid=chart.fluid)


def _is_exact(chart: Chart) -> bool:
    return all(
        axis.logarithmic or has_enough_digits(axis.ends, numbers)
        for curve in chart.curves
        for axis, numbers in ((chart.x, curve.x), (chart.y, curve.displayed))
    )


def _reduce(curve: Curve) -> Curve:
    """Replace a curve of many rows by its envelope."""
    assert isinstance(curve.y, np.ndarray)
    x, y = envelope(curve.x, curve.y)
    is_shorter = y.size < curve.y.size
    return replace(curve, x=x, y=Coarse(y) if is_shorter else y, time=None, reduced=is_shorter)
