"""Sketch of a hover transfer's programme that explains its times and its threshold, drawn with their actual values."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ....design.transfers.programme import Programme
from ...chart.axes import linear_axis
from ...chart.lines import line
from ...chart.marks import horizontal_line, vertical_band, vertical_line
from ...chart.symbols import mark, marker
from ...chart.ticks import axis_ends
from ...common.colours import BLUE, FAINT, INK, SKY, VERMILION
from ...common.quantities import number
from ...interactive.charts import NO_BOX, Backing, Chart, ChartNote, Curve
from ...interactive.measures import TICK_SIZE
from ...pictures import Figure

HEIGHT = 3.4  # in
HEAD = 5.0  # pt, of an arrow
SAMPLES = 400  # samples of the tilt
LANE = 0.16  # distance of a dimension line from the next, over the range of the tilt
DOTS, DASHES = (1.0, 2.0), (5.0, 3.0)


def sketch_figure(programme: Programme) -> list[Figure]:
    """Return the sketch of a programme, as wide as the page."""
    burns = " and ".join(f"{number(begin, 4)} to {number(end, 4)} s" for begin, end in programme.burns)
    words = f"Tilt of thrust of the {programme.kind} programme over time, full thrust {burns}"
    chart = sketch_chart(programme)
    return [Figure(chart.title, "programme", words, chart, HEIGHT, is_wide=True)]


def sketch_chart(programme: Programme) -> Chart:
    """Return the chart of thrust's tilt from the vertical (deg) over time; t2, t5, w, tp and t7 are dimensions.

    Full thrust is shaded. A dashed line is the fraction k of the largest tilt towards the target, at which the initial
    burn begins and ends if w is below t1 and d (`docs/systems/hover_transfer.md`).
    """
    t2, t5, w, tp, t7 = programme.times
    switches = [time for burn in programme.burns for time in burn]
    time = np.unique([*np.linspace(0.0, t7, SAMPLES), *switches])
    tilt = np.degrees(programme.states(time)[1][:, 0] - 0.5 * math.pi)
    low, high = axis_ends(tilt)
    lane = LANE * (high - low)
    dimensions = [(0, f"tp = {number(tp, 4)} s", t7 - tp, t7), (3, f"t7 = {number(t7, 4)} s", 0.0, t7)]
    rules, levels = [horizontal_line(0.0, FAINT, 0.8)], []
    if t2 > 0.0:
        dimensions += [(1, f"t2 = {number(t2, 4)} s", 0.0, t2), (2, f"t5 = {number(t5, 4)} s", 0.0, t5)]
        rules += [vertical_line(at, FAINT, 0.8, DOTS) for at in (t2, t5)]
    if programme.threshold is not None and w > 0.0:
        dimensions.append((0, f"w = {number(w, 4)} s", t2, t2 + w))
        threshold = programme.threshold * float(tilt.min())
        rules.append(horizontal_line(threshold, VERMILION, 1.1, DASHES))
        words = f"k = {number(programme.threshold, 3)} of the largest tilt"
        levels.append(_text(words, (t7, threshold), VERMILION, "right"))
    arrows, notes = [], []
    for row, text, begin, end in dimensions:
        up = high + (row + 0.5) * lane
        arrows += _dimension(begin, end, up)
        side = "right" if end == t7 and begin else "center" if begin or end > 0.5 * t7 else "left"
        at = {"left": begin, "center": 0.5 * (begin + end), "right": end}[side]
        notes.append(_text(text, (at, up), INK, side))
    y = replace(linear_axis((low, high), 5), ends=(low, high + 4.5 * lane))
    return Chart(
        NO_BOX,
        linear_axis((0.0, 1.01 * t7), 8, label="time, s"),
        y,
        title="tilt of thrust from the vertical, deg",
        curves=[line(time, tilt, BLUE, width=1.8, name="tilt", unit="deg"), *arrows],
        areas=[vertical_band(begin, end, SKY, 0.3) for begin, end in programme.burns],
        rules=rules,
        notes=[*notes, *levels],
    )


def _dimension(begin: float, end: float, at: float) -> list[Curve]:
    """Return a dimension line between two abscissas, with arrow heads at both ends."""
    heads = [mark(x, at, marker(kind, HEAD, INK, width=0.0), beyond=True) for kind, x in (("<", begin), (">", end))]
    return [line(np.array([begin, end]), np.full(2, at), INK, width=0.8), *heads]


def _text(text: str, at: tuple[float, float], colour: str, side: str) -> ChartNote:
    """Return a text above a point, on a pale background."""
    return ChartNote(
        text, at, (False, False), (0.0, 3.0), (side, "baseline"), colour.lower(), TICK_SIZE,
        backing=Backing("#ffffff", 0.7, 0.5),
    )  # fmt: skip
