"""A chart as a panel of a page: its picture, and its numbers for the page's script."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..common.panels import PANEL_HEIGHT, PANEL_WIDTH, Panel
from ..common.svg import Drawing
from ..interactive.charts import Chart, Curve
from ..interactive.columns import Coarse, has_enough_digits
from ..interactive.envelope import envelope
from .quantity import ordinates
from .write_svg import lay_out, write_svg

POINTS = 72.0  # in an inch


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
    reduced: bool = False,
) -> Panel:
    """Return the panel of a ``chart``, sizes in inches; ``name`` must differ between the figures of a page.

    ``title`` stands above the axes; ``kind`` is a class more, for the style; ``reduced``: the page has only envelopes
    of its curves. A chart whose numbers a page cannot tell apart remains a picture.
    """
    placed = lay_out(chart, POINTS * width, POINTS * height, title=title)
    svg = write_svg(placed, name, description, POINTS * width, POINTS * height, title=title, kind=kind)
    if not all(_is_exact(placed, curve) for curve in placed.curves):
        stated = Chart(placed.box, placed.x, placed.y, picture=True)
        return Panel(label, Drawing(svg, [stated]))
    curves = [_reduce(curve) for curve in placed.curves] if reduced else placed.curves
    return Panel(label, Drawing(svg, [replace(placed, curves=curves)]))


def _is_exact(chart: Chart, curve: Curve) -> bool:
    return has_enough_digits(chart.x.ends, curve.x) and has_enough_digits(chart.y.ends, ordinates(curve))


def _reduce(curve: Curve) -> Curve:
    """The envelope of a curve of many rows."""
    assert isinstance(curve.y, np.ndarray)
    x, y = envelope(curve.x, curve.y)
    is_shorter = y.size < curve.y.size
    return replace(curve, x=x, y=Coarse(y) if is_shorter else y, time=None, reduced=is_shorter)
