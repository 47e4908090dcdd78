"""A chart as a panel of a page: its picture, and its numbers for the page's script."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..common.panels import PANEL_HEIGHT, PANEL_WIDTH, Panel
from ..interactive.charts import NO_BOX, Chart, Curve, Drawing
from ..interactive.columns import Coarse, has_enough_digits
from ..interactive.envelope import envelope
from .layout import BROAD, lay_out, lay_out_fluid
from .write_svg import TrialPositions, no_trials, write_svg

POINTS = 72.0  # in an inch
ABSCISSA = 0.36  # in, of the texts of an abscissa and its label


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
    left: float = 0.0,
    trials: TrialPositions = no_trials,
    reduced: bool = False,
) -> Panel:
    """Return the panel of a ``chart``, sizes in inches; ``name`` must differ between the figures of a page.

    A chart that has its box keeps it, others are laid out. ``title`` stands above the axes; ``kind`` is a class more,
    for the style; ``left`` (pt) is the room left of the axes at least; ``trials`` returns the positions of its marks of
    trials; ``reduced``: the page has only envelopes of its curves. A chart whose numbers a page cannot tell apart
    remains a picture.
    """
    across, up = POINTS * width, POINTS * height
    placed = chart if chart.box != NO_BOX else lay_out(chart, across, up, title=title, left=left)
    svg = write_svg(placed, name, description, across, up, title=title, kind=kind, trials=trials)
    if not _is_exact(placed):
        return Panel(label, Drawing(svg, [_picture(placed)]))
    curves = [_reduce(curve) for curve in placed.curves] if reduced else placed.curves
    return Panel(label, Drawing(svg, [replace(placed, curves=curves)]))


def fluid_figure(
    name: str,
    description: str,
    chart: Chart,
    height: float,
    *,
    title: str = "",
    left: float = 0.0,
    trials: TrialPositions = no_trials,
) -> Drawing:
    """Return the figure of a ``chart`` as wide as the page, ``height`` in inches; text has one size at any width.

    Other arguments are those of `chart_panel`.
    """
    placed = lay_out_fluid(chart, POINTS * height, title=title, left=left)
    svg = write_svg(placed, name, description, BROAD, POINTS * height, title=title, trials=trials)
    return Drawing(svg, [placed if _is_exact(placed) else _picture(placed)])


def stack_panel(
    label: str, name: str, description: str, charts: tuple[Chart, Chart], height: float, width: float = PANEL_WIDTH
) -> Panel:
    """Return the panel of two charts over the same abscissa, whose texts the lower one has; sizes in inches."""
    upper, lower = charts
    bare = replace(upper, x=replace(upper.x, bare=True))
    heights = [(height - ABSCISSA) / 2.0, (height + ABSCISSA) / 2.0]
    placed = [
        lay_out(chart, POINTS * width, POINTS * high, title=chart.title)
        for chart, high in zip((bare, lower), heights, strict=True)
    ]
    left = max(chart.box[0] for chart in placed)
    wide = round(min(chart.box[0] + chart.box[2] for chart in placed) - left, 5)
    above, below = (
        chart_panel(
            label,
            f"{name}-{order}",
            f"{description}; {chart.title}",
            replace(chart, box=(left, chart.box[1], wide, chart.box[3])),
            high,
            width,
            title=chart.title,
        )
        for order, (chart, high) in enumerate(zip(placed, heights, strict=True))
    )
    return Panel(label, above.figure._replace(below=below.figure))


def _picture(chart: Chart) -> Chart:
    return Chart(chart.box, chart.x, chart.y, picture=True, fluid=chart.fluid)


def _is_exact(chart: Chart) -> bool:
    return all(
        axis.logarithmic or has_enough_digits(axis.ends, numbers)
        for curve in chart.curves
        for axis, numbers in ((chart.x, curve.x), (chart.y, curve.displayed))
    )


def _reduce(curve: Curve) -> Curve:
    """The envelope of a curve of many rows."""
    assert isinstance(curve.y, np.ndarray)
    x, y = envelope(curve.x, curve.y)
    is_shorter = y.size < curve.y.size
    return replace(curve, x=x, y=Coarse(y) if is_shorter else y, time=None, reduced=is_shorter)
