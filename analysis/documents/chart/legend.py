"""Legend of a chart as text with swatches, next to its panels on a page."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from markupsafe import Markup

from ..interactive.charts import Axis, Chart, Curve
from .svg.frame import Frame
from .svg.lines import draw_curve
from .svg.marks import draw_marks

WIDTH, HEIGHT = 26.0, 8.0  # px
UNIT = Axis(ends=(0.0, 1.0), size=0.0)
FRAME = Frame(UNIT, UNIT, 0.0, 0.0, WIDTH, HEIGHT)
THIN, SMALL = 2.0, 4.0  # px, the least width of a line and size of a mark

Legend = list[tuple[Markup, str]]


def legend_of(charts: Sequence[Chart]) -> Legend:
    """Return swatches and names of the curves of charts, each name once."""
    named = {curve.name: curve for chart in charts for curve in chart.curves if curve.name}
    return [(swatch_of(curve), name) for name, curve in named.items()]


def swatch_of(curve: Curve) -> Markup:
    """Return a short line with a curve's style and mark, for a legend."""
    half = np.array([0.5])
    line = replace(curve, x=np.array([0.0, 1.0]), y=np.full(2, 0.5), factor=1.0, steps=False, marker=None)
    elements = draw_curve(FRAME, replace(line, width=max(curve.width, THIN)))
    if curve.marker is not None:
        marker = replace(curve.marker, size=max(curve.marker.size, SMALL))
        elements += draw_marks(FRAME, replace(curve, x=half, y=half, factor=1.0, marker=marker))
    return Markup(
        f'<svg class="swatch" viewBox="0 0 {WIDTH:g} {HEIGHT:g}" aria-hidden="true"><g fill="none">{elements}</g></svg>'
    )
