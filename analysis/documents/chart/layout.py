"""Layout of a chart: the plotting area within a figure, with space for all text."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from ..font.text import ASCENT, DESCENT, MIDDLE, text_width
from ..interactive.charts import Axis, Chart, Fluid
from ..interactive.measures import LABEL_SIZE
from .svg.axes import MARGIN, TITLE_GAP, text_offset
from .svg.fluid import POINT
from .svg.frame import fraction
from .svg.texts import overhang
from .ticks import STEPS

LABEL_GAP = 4.0  # pt, distance from tick labels to the label of the axis
NARROW, BROAD = 296.0 / POINT, 1000.0 / POINT  # pt: a page's column on the narrowest telephone and on a wide screen
NARROWS = (320, 400, 480, 640, 800)  # px, widths below which a figure may have fewer ticks, as in page.css, `fine`
SPACE = 6.0  # pt, distance between tick labels
FEWEST = 2  # ticks
CLOSE = 1e-6  # tolerance of a tick's position, over a step
LINE = ASCENT + DESCENT  # height of a line of text over its font size


def lay_out(chart: Chart, width: float, height: float, *, title: str = "", left: float = 0.0) -> Chart:
    """Return the chart with its plotting area, ``box``, in a figure of this size (pt).

    ``left`` (pt) is the minimum space to the left of the axes, which aligns charts below each other.
    """
    return replace(chart, box=_box(_margins(chart, width, height, title, left), width, height))


def lay_out_fluid(
    chart: Chart,
    width: float,
    height: float,
    *,
    title: str = "",
    left: float = 0.0,
    right: float = 0.0,
    to_scale: bool = False,
) -> Chart:
    """Return the chart with ``fluid`` margins in a figure of this height (pt) and of variable width.

    Its ``box`` applies at this ``width`` (pt). Ticks whose labels would overlap there are omitted; on narrow screens
    only the ``few`` ticks remain. ``left`` and ``right`` (pt) are minimum spaces, which align charts below each other.
    With ``to_scale`` the height follows the width.
    """

    def margins_of(axis: Axis, at: float) -> np.ndarray:
        return _margins(replace(chart, x=axis), at, height, title, left, right)

    def sparse(axis: Axis, at: float) -> Sequence[int]:
        room = margins_of(axis, at)
        return sparse_ticks(axis, float(at - room[0] - room[2]))

    axis = _select(chart.x, sparse(chart.x, width))
    few = sparse(axis, NARROW)
    margins = np.maximum(margins_of(axis, width), margins_of(_select(axis, few), NARROW))
    if len(few) < len(axis.ticks):
        needed = POINT * (_length_for(axis) + margins[0] + margins[2])
        narrow = next((each for each in NARROWS if each >= needed), NARROWS[-1])
        margins = np.maximum(margins, margins_of(axis, narrow / POINT))
        axis = replace(axis, few=few, narrow=narrow)
    margins = np.ceil(POINT * margins)
    fluid = Fluid(tuple(margins.tolist()), POINT, to_scale)
    return replace(chart, x=axis, box=_box(margins / POINT, width, height), fluid=fluid)


def axes_size(chart: Chart, width: float, height: float) -> tuple[float, float]:
    """Return the size (pt) of the plotting area in a figure of this size; with `Fluid` margins, on a narrow screen."""
    across, up = width * chart.box[2], height * chart.box[3]
    if not chart.fluid:
        return across, up
    narrow = min(across, NARROW - (chart.fluid.margins[0] + chart.fluid.margins[2]) / POINT)
    return narrow, up * narrow / across if chart.fluid.to_scale else up


def _select(axis: Axis, ticks: Sequence[int]) -> Axis:
    return replace(axis, ticks=[axis.ticks[index] for index in ticks])


def sparse_ticks(axis: Axis, length: float) -> Sequence[int]:
    """Return the largest selection of ticks whose labels do not overlap on an abscissa of this length (pt).

    Smaller selections contain rounder numbers.
    """
    chosen: Sequence[int] = range(len(axis.ticks))
    for ticks in _iterate_thinner_ticks(axis):
        if len(ticks) >= FEWEST:
            chosen = ticks
        if _length_for(_select(axis, chosen)) <= length:
            break
    return chosen


def _iterate_thinner_ticks(axis: Axis) -> Iterator[Sequence[int]]:
    """Yield ever smaller selections of ticks: every second, third, ... name, or the multiples of a round step."""
    everything: Sequence[int] = range(len(axis.ticks))
    yield everything
    at = np.array([each for each, _ in axis.ticks])
    if axis.logarithmic and not axis.named:
        exponents = np.log10(at)
        at = np.round(exponents)
        everything = np.flatnonzero(np.abs(exponents - at) < CLOSE).tolist()
        yield everything
    step = 1.0 if axis.logarithmic or at.size < FEWEST else at[1] - at[0]
    counts = np.round(at / step)
    if axis.named or np.any(np.abs(at / step - counts) > CLOSE):
        counts, step = np.arange(at.size), 0.0
    for each in range(FEWEST, at.size + 1):
        if axis.logarithmic or not _is_round(step) or _is_round(each * step):
            yield [index for index in everything if counts[index] % each == 0]


def _is_round(step: float) -> bool:
    """Return True if a step is one of `STEPS` times a power of ten."""
    if not step:
        return False
    mantissa = abs(step) / 10.0 ** math.floor(math.log10(abs(step)) + CLOSE)
    return any(abs(mantissa - each) < CLOSE for each in STEPS)


def _length_for(axis: Axis) -> float:
    """Return the smallest length (pt) of an abscissa at which its tick labels do not overlap."""
    written = [(at, text) for at, text in axis.ticks if text]
    if axis.bare or len(written) < FEWEST:
        return 0.0
    halves = np.array([text_width(text, axis.size) / 2.0 for _, text in written])
    apart = np.abs(np.diff(fraction(axis, np.array([at for at, _ in written]))))
    return float(np.max((halves[:-1] + halves[1:] + SPACE) / apart))


def _margins(
    chart: Chart, width: float, height: float, title: str, left: float = 0.0, right: float = 0.0
) -> np.ndarray:
    """Return the spaces (pt) left, above, right and below the axes, at least ``left`` and ``right``."""
    room = np.maximum(_room(chart, title), [left, 0.0, right, 0.0])
    for _ in range(2):  # the space for notes at fractions of the axes depends on their size
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
    """Return the spaces (pt) for ticks, labels and title: left, top, right, bottom."""
    x, y = chart.x, chart.y
    widest = max((text_width(text, y.size) for _, text in y.ticks), default=0.0)
    left_label, label = (LABEL_GAP + LINE * LABEL_SIZE if axis.label else 0.0 for axis in (y, x))
    left = MARGIN + text_offset(y) + widest + left_label
    bottom = MARGIN + text_offset(x) + (0.0 if x.bare else LINE * x.size + label)
    top = MARGIN + (TITLE_GAP + LINE * LABEL_SIZE if title else MIDDLE * y.size)
    return left, top, MARGIN, bottom


def _ends_of_ticks(chart: Chart, width: float) -> tuple[float, float]:
    """Return how far tick labels of the abscissa extend beyond the left and the right end of axes of this width."""
    if not chart.x.ticks:
        return 0.0, 0.0
    at = width * fraction(chart.x, np.array([each for each, _ in chart.x.ticks]))
    half = np.array([text_width("" if chart.x.bare else text, chart.x.size) for _, text in chart.x.ticks]) / 2.0
    return float(np.max(half - at)), float(np.max(at + half) - width)
