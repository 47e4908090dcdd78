"""A chart as wide as the page's column, and the same for a narrow screen."""

from __future__ import annotations

from collections.abc import Callable

from ..common.panels import HALF_WIDTH, Widths
from ..interactive.charts import Chart
from ..interactive.measures import WIDTH
from .panel import chart_panel


def chart_widths(
    name: str,
    description: str,
    chart_of: Callable[[float, float], Chart],
    height: float,
    slim_height: float | None = None,
    *,
    title: str = "",
) -> Widths:
    """Return a figure as wide as the page's column and the same for narrow screens, heights in inches.

    ``chart_of`` makes the chart for a width and a height (in); see `chart_panel` for the others.
    """
    drawings = []
    for kind, width, high in (("wide", WIDTH, height), ("slim", HALF_WIDTH, slim_height or height)):
        chart, label = chart_of(width, high), name if kind == "wide" else f"{name}-{kind}"
        drawings.append(chart_panel("", label, description, chart, high, width, title=title, kind=kind).figure)
    return Widths(*drawings)
