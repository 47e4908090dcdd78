"""Where the axes of a chart lie in a figure, so that there is room for all texts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..font.text import ASCENT, DESCENT, MIDDLE, text_width
from ..interactive.charts import Chart
from ..interactive.measures import LABEL_SIZE
from .svg.axes import MARGIN, TITLE_GAP, text_offset
from .svg.frame import fraction
from .svg.texts import overhang

LABEL_GAP = 4.0  # pt, from the texts of ticks to the label of the axis
LINE = ASCENT + DESCENT  # of a text, of its size


def lay_out(chart: Chart, width: float, height: float, *, title: str = "", left: float = 0.0) -> Chart:
    """Return the chart with the ``box`` of its axes in a figure of this size (pt).

    ``left`` (pt) is the room left of the axes at least, for charts below each other.
    """
    before, above, beyond, below = _room(chart, title)
    before = max(before, left)
    for _ in range(2):  # the room for what is placed in fractions of the axes depends on their size
        across, up = width - before - beyond, height - above - below
        first, last = _ends_of_ticks(chart, across)
        hanging = np.array([(0.0, 0.0, 0.0, 0.0), *(overhang(note, across, up) for note in chart.notes)])
        margins = MARGIN + np.maximum([first, 0.0, last, 0.0], hanging.max(axis=0))
        before, above, beyond, below = np.maximum([before, above, beyond, below], margins).tolist()
    across, up = 1.0 - (before + beyond) / width, 1.0 - (above + below) / height
    return replace(chart, box=(round(before / width, 5), round(above / height, 5), round(across, 5), round(up, 5)))


def _room(chart: Chart, title: str) -> tuple[float, float, float, float]:
    """For ticks, labels and the title: left, top, right, bottom."""
    x, y = chart.x, chart.y
    widest = max((text_width(text, y.size) for _, text in y.ticks), default=0.0)
    left_label, label = (LABEL_GAP + LINE * LABEL_SIZE if axis.label else 0.0 for axis in (y, x))
    left = MARGIN + text_offset(y) + widest + left_label
    bottom = MARGIN + text_offset(x) + (0.0 if x.bare else LINE * x.size) + label
    top = MARGIN + (TITLE_GAP + LINE * LABEL_SIZE if title else MIDDLE * y.size)
    return left, top, MARGIN, bottom


def _ends_of_ticks(chart: Chart, width: float) -> tuple[float, float]:
    """How far texts of the abscissa's ticks reach beyond the left and the right end of axes of this width."""
    if not chart.x.ticks:
        return 0.0, 0.0
    at = width * fraction(chart.x, np.array([each for each, _ in chart.x.ticks]))
    half = np.array([text_width(text, chart.x.size) for _, text in chart.x.ticks]) / 2.0
    return float(np.max(half - at)), float(np.max(at + half) - width)
