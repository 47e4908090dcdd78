"""Notes in SVG, and the space that they need outside the axes."""

from __future__ import annotations

import numpy as np
from markupsafe import escape

from ...font.text import ASCENT, DEEP, DESCENT, MIDDLE, TALL, text_width
from ...interactive.charts import ChartNote
from .fluid import FluidFrame

ANCHORS = {"left": "start", "center": "middle", "right": "end"}
BEGINS = {"left": 0.0, "center": -0.5, "right": -1.0}  # distance from a text's point to its left end, over its width
RISES = {"top": ASCENT, "center": MIDDLE, "bottom": -DESCENT, "baseline": 0.0}


def draw_note(frame: FluidFrame, note: ChartNote) -> str:
    """Return a text with its backing at a point of the data or of the axes; empty if the point is outside."""
    x, y = frame.point(note.at, note.of_axes)
    of_data = (frame.left if note.of_axes[0] else x, frame.top if note.of_axes[1] else y)
    if not frame.contains(*np.array(of_data)[:, np.newaxis]).all():
        return ""
    return frame.place_element(x, y, _write(note))


def _write(note: ChartNote) -> str:
    x, y = note.offset[0], RISES[note.align[1]] * note.size - note.offset[1]
    bold = ' font-weight="700"' if note.bold else ""
    return (
        f'{_backing(note, x, y)}<text x="{x:.2f}" y="{y:.2f}" font-size="{note.size:g}" '
        f'text-anchor="{ANCHORS[note.align[0]]}" fill="{note.colour}"{bold}>{escape(note.text)}</text>'
    )


def overhang(note: ChartNote, width: float, height: float) -> tuple[float, float, float, float]:
    """Return how far (pt) a note extends beyond axes of this size: left, top, right, bottom."""
    left = note.offset[0] + BEGINS[note.align[0]] * _width(note)
    base = -note.offset[1] + RISES[note.align[1]] * note.size
    right, top, bottom = left + _width(note), base - ASCENT * note.size, base + DESCENT * note.size
    across, up = note.at
    return (
        -left - across * width if note.of_axes[0] and across <= 0.0 else 0.0,
        -top + (up - 1.0) * height if note.of_axes[1] and up >= 1.0 else 0.0,
        right + (across - 1.0) * width if note.of_axes[0] and across >= 1.0 else 0.0,
        bottom - up * height if note.of_axes[1] and up <= 0.0 else 0.0,
    )


def _width(note: ChartNote) -> float:
    return text_width(note.text, note.size, is_bold=note.bold)


def _backing(note: ChartNote, x: float, y: float) -> str:
    """Return a rectangle as high as the tallest letters, which gives all backings the same height."""
    if note.backing is None:
        return ""
    margin, width = note.backing.margin, _width(note)
    left, top = x + BEGINS[note.align[0]] * width - margin, y - TALL * note.size - margin
    return (
        f'<rect x="{left:.2f}" y="{top:.2f}" width="{width + 2.0 * margin:.2f}" '
        f'height="{(TALL + DEEP) * note.size + 2.0 * margin:.2f}" fill="{note.backing.colour}" '
        f'fill-opacity="{note.backing.opacity:g}"/>'
    )
