"""Charts with equal scales: a unit has the same length on both axes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from ..interactive.charts import Chart
from .layout import lay_out, lay_out_fluid

Ends = tuple[float, float]
ROUNDS = 4  # iterations, since the ends determine the tick labels, and these the available space


def equal_ends(x: Ends, y: Ends, width: float, height: float) -> tuple[Ends, Ends]:
    """Return the ends of both axes, one of them widened about its middle so that the scales are equal.

    ``width`` and ``height`` are the dimensions of the plotting area.
    """
    unit = max(abs(x[1] - x[0]) / width, abs(y[1] - y[0]) / height)
    return _widen(x, unit * width), _widen(y, unit * height)


def to_scale(
    chart_of: Callable[[Ends, Ends], Chart],
    x: Ends,
    y: Ends,
    width: float,
    height: float,
    *,
    title: str = "",
    fluid: bool = True,
) -> Chart:
    """Return a chart with equal scales, laid out in a figure of this size (pt).

    ``chart_of`` constructs it from the ends of abscissa and ordinate, which contain ``x`` and ``y``. ``fluid`` lays it
    out for a page, at any width.
    """
    lay = partial(lay_out_fluid, to_scale=True) if fluid else lay_out
    chart = lay(chart_of(x, y), width, height, title=title)
    for _ in range(ROUNDS):
        ends = equal_ends(x, y, width * chart.box[2], height * chart.box[3])
        chart = lay(chart_of(*ends), width, height, title=title)
    ends = equal_ends(x, y, width * chart.box[2], height * chart.box[3])
    return replace(chart, x=replace(chart.x, ends=ends[0]), y=replace(chart.y, ends=ends[1]))


def _widen(ends: Ends, length: float) -> Ends:
    low, high = ends
    if high < low:
        return _widen((high, low), length)[::-1]
    more = (length - (high - low)) / 2.0
    return low - more, high + more
