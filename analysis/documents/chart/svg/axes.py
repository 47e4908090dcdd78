"""Axes in SVG: grid, edges, tick marks and tick labels, axis labels."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from markupsafe import escape

from ...common.colours import FAINT, GRID, INK
from ...font.text import ASCENT, DESCENT, MIDDLE
from ...interactive.charts import Axis
from ...interactive.measures import AXES_WIDTH, GRID_WIDTH
from .fluid import VISIBLE, FluidFrame

MARGIN = 3.0  # pt, margin around all elements
STROKE, GAP = 3.5, 3.5  # pt, length of a tick mark, and distance from there to its label
TITLE_GAP = 4.0  # pt, from the title to the axes
STILL = "still"  # CSS class of elements that remain when a script draws the lines
FINE = "fine"  # CSS class of ticks that a narrow figure omits, with its greatest width (px)


def text_offset(axis: Axis) -> float:
    """Return the distance (pt) between the edge of an axis and its tick labels."""
    return (STROKE if axis.marked else 0.0) + GAP


def draw_axes(frame: FluidFrame) -> Iterator[str]:
    """Yield the elements of both axes; no elements for axes with text of size 0, as in a drawing."""
    if not frame.x.size and not frame.y.size:
        return
    ticks, few = list(enumerate(frame.x.ticks)), set(frame.x.few)
    y = frame.down(np.array([at for at, _ in frame.y.ticks]))
    level = "".join(f"M0 {at:.2f}h{frame.width:g}" for at in y[_find_grid_ticks(frame.y, frame.y.ticks)])
    edges = f"M0 0v{frame.height:g}h{frame.width:g}"
    strokes = "".join(f"M0 {at:.2f}h{STROKE:g}" for at in y if frame.y.marked)
    if few:
        fine = _abscissa(frame, [tick for index, tick in ticks if index not in few], "", "")
        yield f'<g class="{FINE}-{frame.x.narrow}">{fine}</g>'
    yield frame.stretch_up(_edge(strokes), STROKE)
    yield _abscissa(frame, [tick for index, tick in ticks if not few or index in few], level, edges)
    texts = [("0", frame.format_y(at), text) for at, (_, text) in zip(y, frame.y.ticks, strict=True)]
    yield _texts(frame.y, "end", (-text_offset(frame.y), MIDDLE * frame.y.size), texts)


def _abscissa(frame: FluidFrame, ticks: list[tuple[float, str]], grid: str, edges: str) -> str:
    """Return the ticks of the abscissa as SVG: labels, marks, and the lines of a ``grid``."""
    x = frame.across(np.array([at for at, _ in ticks]))
    grid += "".join(f"M{at:.2f} {frame.height:g}V0" for at in x[_find_grid_ticks(frame.x, ticks)])
    strokes = "".join(f"M{at:.2f} 0v{STROKE:g}" for at in x if frame.x.marked)
    below = frame.stretch_across(_edge(strokes), STROKE)
    texts = [(frame.format_x(at), "100%", text) for at, (_, text) in zip(x, ticks, strict=True)]
    offset = (0.0, text_offset(frame.x) + ASCENT * frame.x.size)
    return frame.stretch_edges(_grid(grid) + _edge(edges)) + below + _texts(frame.x, "middle", offset, texts)


def _find_grid_ticks(axis: Axis, ticks: Sequence[tuple[float, str]]) -> np.ndarray:
    """Return True for each tick with a grid line, [ticks]: ticks with labels, or all if none has a label."""
    named = np.array([bool(text) for _, text in ticks], dtype=bool)
    return axis.grid & (named | ~named.any())


def _grid(path: str) -> str:
    return f'<path d="{path}" stroke="{GRID}" stroke-width="{GRID_WIDTH:g}"/>' if path else ""


def _edge(path: str) -> str:
    return f'<path d="{path}" fill="none" stroke="{FAINT}" stroke-width="{AXES_WIDTH:g}"/>' if path else ""


def _texts(axis: Axis, anchor: str, offset: tuple[float, float], positions: list[tuple[str, str, str]]) -> str:
    written = "".join(f'<text x="{x}" y="{y}">{escape(text)}</text>' for x, y, text in positions if text)
    if not written or axis.bare:
        return ""
    shift = f'transform="translate({offset[0]:g} {offset[1]:.2f})"'
    return f'<g font-size="{axis.size:g}" text-anchor="{anchor}" fill="{INK}" {shift}>{written}</g>'


def draw_labels(frame: FluidFrame, title: str, size: float) -> Iterator[str]:
    """Yield axis labels and title in this text size; they remain when a script redraws the chart."""
    left, bottom = MARGIN + ASCENT * size - frame.margins[0], frame.margins[3] - MARGIN - DESCENT * size
    for text, x, y, anchor, shift in (
        ("" if frame.x.bare else frame.x.label, "50%", "100%", "middle", f"translate(0 {bottom:.2f})"),
        (frame.y.label, "0", "50%", "middle", f"translate({left:.2f}) rotate(-90)"),
        (title, "0", "0", "start", f"translate(0 {-TITLE_GAP - DESCENT * size:.2f})"),
    ):
        if text:
            style = f'font-size="{size:g}" text-anchor="{anchor}" fill="{INK}" transform="{shift}"'
            written = f"<text {style}>{escape(text)}</text>"
            yield f'<g class="{STILL}"><svg x="{x}" y="{y}" {VISIBLE}>{written}</svg></g>'
