"""Axes in a picture: grid, edges, strokes of ticks and their texts, labels."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
from markupsafe import escape

from ...common.colours import FAINT, GRID, INK
from ...font.text import ASCENT, DESCENT, MIDDLE
from ...interactive.charts import Axis
from ...interactive.measures import AXES_WIDTH, GRID_WIDTH
from .frame import Frame

MARGIN = 3.0  # pt, around everything
STROKE, GAP = 3.5, 3.5  # pt: of a tick, from there to its text
TITLE_GAP = 4.0  # pt, from the title to the axes
STILL = "still"  # the class of what remains where a script draws lines
FINE = "fine"  # the class of ticks that a narrow screen has not


def text_offset(axis: Axis) -> float:
    """Return how far (pt) the texts of an axis begin from its edge."""
    return (STROKE if axis.marked else 0.0) + GAP


def draw_axes(frame: Frame) -> Iterator[str]:
    """Yield the elements of both axes; none of those whose texts have no size, as of a drawing."""
    if not frame.x.size and not frame.y.size:
        return
    ticks, few = list(enumerate(frame.x.ticks)), set(frame.x.few)
    y = frame.down(np.array([at for at, _ in frame.y.ticks]))
    level = "".join(f"M{frame.left:.2f} {at:.2f}h{frame.width:.2f}" for at in y[_have_lines(frame.y, frame.y.ticks)])
    edges = f"M{frame.left:.2f} {frame.top:.2f}v{frame.height:.2f}h{frame.width:.2f}"
    strokes = "".join(f"M{frame.left:.2f} {at:.2f}h-{STROKE:g}" for at in y if frame.y.marked)
    if few:
        fine = _abscissa(frame, [tick for index, tick in ticks if index not in few], "", "")
        yield f'<g class="{FINE}">{fine}</g>'
    if frame.is_fluid:  # which would stretch them
        yield _edge(strokes)
        strokes = ""
    yield _abscissa(frame, [tick for index, tick in ticks if not few or index in few], level, edges + strokes)
    left, rise = frame.left - text_offset(frame.y), MIDDLE * frame.y.size
    texts = [(f"{left:.2f}", at + rise, text) for at, (_, text) in zip(y, frame.y.ticks, strict=True)]
    yield _texts(frame.y, "end", texts)


def _abscissa(frame: Frame, ticks: list[tuple[float, str]], grid: str, edges: str) -> str:
    """Some ticks of the abscissa: their texts, their lines as those of a ``grid``, their strokes as ``edges``."""
    x = frame.across(np.array([at for at, _ in ticks]))
    grid += "".join(f"M{at:.2f} {frame.bottom:.2f}v-{frame.height:.2f}" for at in x[_have_lines(frame.x, ticks)])
    edges += "".join(f"M{at:.2f} {frame.bottom:.2f}v{STROKE:g}" for at in x if frame.x.marked)
    base = frame.bottom + text_offset(frame.x) + ASCENT * frame.x.size
    texts = [(frame.along(at), base, text) for at, (_, text) in zip(x, ticks, strict=True)]
    return frame.stretch(_grid(grid) + _edge(edges)) + _texts(frame.x, "middle", texts)


def _have_lines(axis: Axis, ticks: Sequence[tuple[float, str]]) -> np.ndarray:
    """Return the ticks with a grid line, [ticks]: those with texts, or all where none has."""
    named = np.array([bool(text) for _, text in ticks], dtype=bool)
    return axis.grid & (named | ~named.any())


def _grid(path: str) -> str:
    return f'<path d="{path}" stroke="{GRID}" stroke-width="{GRID_WIDTH:g}"/>' if path else ""


def _edge(path: str) -> str:
    return f'<path d="{path}" fill="none" stroke="{FAINT}" stroke-width="{AXES_WIDTH:g}"/>' if path else ""


def _texts(axis: Axis, anchor: str, positions: list[tuple[str, float, str]]) -> str:
    written = "".join(f'<text x="{x}" y="{y:.2f}">{escape(text)}</text>' for x, y, text in positions if text)
    if not written or axis.bare:
        return ""
    return f'<g font-size="{axis.size:g}" text-anchor="{anchor}" fill="{INK}">{written}</g>'


def draw_labels(frame: Frame, title: str, size: float) -> Iterator[str]:
    """Yield the labels of the axes and the title in texts of this size, which remain where a script draws the chart."""
    middle, centre = frame.left + frame.width / 2.0, frame.top + frame.height / 2.0
    left, bottom = frame.edges
    left += MARGIN + ASCENT * size
    bottom -= MARGIN + DESCENT * size
    for text, x, y, anchor, turn in (
        ("" if frame.x.bare else frame.x.label, frame.along(middle), bottom, "middle", ""),
        (frame.y.label, f"{left:.2f}", centre, "middle", f' transform="rotate(-90 {left:.2f} {centre:.2f})"'),
        (title, f"{frame.left:.2f}", frame.top - TITLE_GAP - DESCENT * size, "start", ""),
    ):
        if text:
            yield (
                f'<g class="{STILL}"><text x="{x}" y="{y:.2f}" font-size="{size:g}" '
                f'text-anchor="{anchor}" fill="{INK}"{turn}>{escape(text)}</text></g>'
            )
