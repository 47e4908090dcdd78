"""Axes in a picture: grid, edges, strokes of ticks and their texts, labels."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from markupsafe import escape

from ...common.colours import FAINT, GRID, INK
from ...font.text import ASCENT, DESCENT, MIDDLE
from ...interactive.charts import Axis, Chart
from ...interactive.measures import AXES_WIDTH, GRID_WIDTH, LABEL_SIZE
from .frame import Frame

MARGIN = 3.0  # pt, around everything
STROKE, GAP = 3.5, 3.5  # pt: of a tick, from there to its text
TITLE_GAP = 4.0  # pt, from the title to the axes
STILL = "still"  # the class of what remains where a script draws lines


def text_offset(axis: Axis) -> float:
    """Return how far (pt) the texts of an axis begin from its edge."""
    return (STROKE if axis.marked else 0.0) + GAP


def draw_axes(frame: Frame) -> Iterator[str]:
    """Yield the elements of both axes."""
    left, top, right, bottom = frame.left, frame.top, frame.right, frame.bottom
    x = frame.across(np.array([at for at, _ in frame.x.ticks]))
    y = frame.down(np.array([at for at, _ in frame.y.ticks]))
    grid = "".join(f"M{at:.2f} {bottom:.2f}V{top:.2f}" for at in x if frame.x.grid)
    grid += "".join(f"M{left:.2f} {at:.2f}H{right:.2f}" for at in y if frame.y.grid)
    if grid:
        yield f'<path d="{grid}" stroke="{GRID}" stroke-width="{GRID_WIDTH:g}"/>'
    strokes = "".join(f"M{at:.2f} {bottom:.2f}v{STROKE:g}" for at in x if frame.x.marked)
    strokes += "".join(f"M{left:.2f} {at:.2f}h-{STROKE:g}" for at in y if frame.y.marked)
    edges = f"M{left:.2f} {top:.2f}V{bottom:.2f}H{right:.2f}"
    yield f'<path d="{edges}{strokes}" fill="none" stroke="{FAINT}" stroke-width="{AXES_WIDTH:g}"/>'
    base = bottom + text_offset(frame.x) + ASCENT * frame.x.size
    below = [(at, base, text) for at, (_, text) in zip(x, frame.x.ticks, strict=True)]
    end, rise = left - text_offset(frame.y), MIDDLE * frame.y.size
    yield from _texts(frame.x, "middle", below)
    yield from _texts(frame.y, "end", [(end, at + rise, text) for at, (_, text) in zip(y, frame.y.ticks, strict=True)])


def _texts(axis: Axis, anchor: str, positions: list[tuple[float, float, str]]) -> Iterator[str]:
    written = "".join(f'<text x="{x:.2f}" y="{y:.2f}">{escape(text)}</text>' for x, y, text in positions if text)
    if written and not axis.bare:
        yield f'<g font-size="{axis.size:g}" text-anchor="{anchor}" fill="{INK}">{written}</g>'


def draw_labels(frame: Frame, chart: Chart, height: float, title: str) -> Iterator[str]:
    """Yield the labels of the axes and the title, which remain where a script draws the chart."""
    middle, centre = frame.left + frame.width / 2.0, frame.top + frame.height / 2.0
    edge = MARGIN + ASCENT * LABEL_SIZE
    for text, x, y, anchor, turn in (
        (chart.x.label, middle, height - MARGIN - DESCENT * LABEL_SIZE, "middle", ""),
        (chart.y.label, edge, centre, "middle", f' transform="rotate(-90 {edge:.2f} {centre:.2f})"'),
        (title, frame.left, frame.top - TITLE_GAP - DESCENT * LABEL_SIZE, "start", ""),
    ):
        if text:
            yield (
                f'<g class="{STILL}"><text x="{x:.2f}" y="{y:.2f}" font-size="{LABEL_SIZE:g}" '
                f'text-anchor="{anchor}" fill="{INK}"{turn}>{escape(text)}</text></g>'
            )
