"""Layout: the box of the axes of a chart in a figure, with room for all texts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..font.text import ASCENT, DESCENT, MIDDLE, text_width
from ..interactive.charts import Axis, Chart, Fluid
from ..interactive.measures import LABEL_SIZE
from .svg.axes import MARGIN, TITLE_GAP, text_offset
from .svg.fluid import POINT
from .svg.frame import fraction
from .svg.texts import overhang

LABEL_GAP = 4.0  # pt, from the texts of ticks to the label of the axis
NARROW, BROAD = 366.0 / POINT, 1000.0 / POINT  # pt: a page's column on a telephone and on a wide screen
SPACE, LABELS = 6.0, 40.0  # pt: between texts of ticks, left of the axes
FEWEST = 3  # ticks, of which a narrow screen may have each second one
LINE = ASCENT + DESCENT  # of a text, of its size


def lay_out(chart: Chart, width: float, height: float, *, title: str = "", left: float = 0.0) -> Chart:
    """Return the chart with the ``box`` of its axes in a figure of this size (pt).

    ``left`` (pt) is the room left of the axes at least, for charts below each other.
    """
    return replace(chart, box=_box(_margins(chart, width, height, title, left), width, height))


def lay_out_fluid(chart: Chart, height: float, *, title: str = "", left: float = 0.0) -> Chart:
    """Return the chart with ``fluid`` margins in a figure of this height (pt), as wide as a telephone or a page.

    Its ``box`` is that in the page's column; a narrow screen has the ticks that are ``few``.
    """
    few = _few(chart.x)
    ticks = [chart.x.ticks[index] for index in few] if few else chart.x.ticks
    on_narrow = _margins(replace(chart, x=replace(chart.x, ticks=ticks)), NARROW, height, title, left)
    margins = np.ceil(POINT * np.maximum(on_narrow, _margins(chart, BROAD, height, title, left)))
    fluid = Fluid(tuple(margins.tolist()), POINT)
    return replace(chart, x=replace(chart.x, few=few), box=_box(margins / POINT, BROAD, height), fluid=fluid)


def _few(axis: Axis) -> list[int]:
    """Each second tick, if all are too many for a narrow screen: that of 0 and others are at whole multiples."""
    length = sum(text_width(text, axis.size) + SPACE for _, text in axis.ticks if text)
    if len(axis.ticks) < FEWEST or length <= NARROW - MARGIN - LABELS:
        return []
    (first, _), (second, _) = axis.ticks[:2]
    begin = 0 if axis.named or axis.logarithmic else round(first / (second - first)) % 2
    return list(range(begin, len(axis.ticks), 2))


def _margins(chart: Chart, width: float, height: float, title: str, left: float) -> np.ndarray:
    """The room (pt) left, above, right and below the axes."""
    room = np.maximum(_room(chart, title), [left, 0.0, 0.0, 0.0])
    for _ in range(2):  # the room for what is placed in fractions of the axes depends on their size
        across, up = width - room[0] - room[2], height - room[1] - room[3]
        first, last = _ends_of_ticks(chart, across)
        hanging = np.array([(first, 0.0, last, 0.0), *(overhang(note, across, up) for note in chart.notes)])
        room = np.maximum(room, MARGIN + hanging.max(axis=0))
    return room


def _box(margins: np.ndarray, width: float, height: float) -> tuple[float, float, float, float]:
    left, top, right, bottom = margins.tolist()
    across, up = 1.0 - (left + right) / width, 1.0 - (top + bottom) / height
    return round(left / width, 5), round(top / height, 5), round(across, 5), round(up, 5)


def _room(chart: Chart, title: str) -> tuple[float, float, float, float]:
    """For ticks, labels and the title: left, top, right, bottom."""
    x, y = chart.x, chart.y
    widest = max((text_width(text, y.size) for _, text in y.ticks), default=0.0)
    left_label, label = (LABEL_GAP + LINE * LABEL_SIZE if axis.label else 0.0 for axis in (y, x))
    left = MARGIN + text_offset(y) + widest + left_label
    bottom = MARGIN + text_offset(x) + (0.0 if x.bare else LINE * x.size + label)
    top = MARGIN + (TITLE_GAP + LINE * LABEL_SIZE if title else MIDDLE * y.size)
    return left, top, MARGIN, bottom


def _ends_of_ticks(chart: Chart, width: float) -> tuple[float, float]:
    """Return by how much texts of the abscissa's ticks exceed the left and the right end of axes of this width."""
    if not chart.x.ticks:
        return 0.0, 0.0
    at = width * fraction(chart.x, np.array([each for each, _ in chart.x.ticks]))
    half = np.array([text_width("" if chart.x.bare else text, chart.x.size) for _, text in chart.x.ticks]) / 2.0
    return float(np.max(half - at)), float(np.max(at + half) - width)
