"""Marks of the points of curves, and marks of trials, in SVG."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ...interactive.charts import Curve, Dots, Marker
from .frame import Frame
from .polyline import in_tenths

CROSS_WIDTH = 0.29  # line width over the size of a cross


def draw_marks(frame: Frame, curve: Curve) -> str:
    """Return the marks at the points of a curve within the axes."""
    if curve.marker is None:
        return ""
    positions = _within(frame, frame.across(curve.x), frame.down(curve.displayed))
    elements = _draw(frame, curve.marker, positions)
    return f'<g opacity="{curve.opacity:g}">{elements}</g>' if elements and curve.opacity < 1.0 else elements


def draw_dots(frame: Frame, dots: Dots, x: np.ndarray, y: np.ndarray) -> str:
    """Return the marks of trials at abscissas and ordinates, [trials], as one path; coincident marks are drawn once."""
    positions = np.unique(_within(frame, frame.across(x), frame.down(y)), axis=0)
    return (_crosses if dots.cross else _round)(positions, dots.size, dots.colour)


def _within(frame: Frame, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the positions within the axes, in tenths of pt, [marks, 2]."""
    return np.rint(10.0 * np.stack([x, y], axis=1)[frame.contains(x, y)]).astype(np.int64)


def _draw(frame: Frame, marker: Marker, positions: np.ndarray) -> str:
    if not positions.size:
        return ""
    width = marker.width if marker.edge else 0.0
    if not marker.outline and marker.edge in ("", marker.fill):
        return frame.stretch(_round(positions, marker.size + width, marker.fill))
    edge = f' stroke="{marker.edge}" stroke-width="{width:g}"' if width else ""
    paint = f'fill="{marker.fill or "none"}"{edge}'
    if not marker.outline:
        return "".join(
            f'<circle cx="{frame.format_x(x / 10)}" cy="{frame.format_y(y / 10)}" r="{marker.size / 2.0:g}" {paint}/>'
            for x, y in positions.tolist()
        )
    return _shapes(frame, positions, marker.outline, marker.size, paint)


def _round(positions: np.ndarray, diameter: float, colour: str) -> str:
    """Return discs as round caps of strokes of zero length, in one path."""
    moves = np.diff(positions, axis=0, prepend=0).tolist()
    path = "".join(f"m{in_tenths(move)}h0" for move in moves)
    # A style, because the page's style sheet overrides attributes.
    style = 'style="stroke-linecap:round"'
    return f'<path d="{path}" stroke="{colour}" stroke-width="{diameter:.3g}" {style}/>' if path else ""


def _crosses(positions: np.ndarray, size: float, colour: str) -> str:
    """Return crosses in one path, because thousands of elements would slow the page."""
    arm = int(np.rint(5.0 * size))
    ends = np.array([(-arm, -arm), (arm, arm), (-arm, arm), (arm, -arm)])  # tenths, from the middle
    moves = np.diff((positions[:, np.newaxis] + ends).reshape(-1, 2), axis=0, prepend=0).reshape(-1, 2, 2).tolist()
    path = "".join(f"m{in_tenths(move)}l{in_tenths(line)}" for move, line in moves)
    return f'<path d="{path}" stroke="{colour}" stroke-width="{CROSS_WIDTH * size:.3g}"/>' if path else ""


def _shapes(frame: Frame, positions: np.ndarray, outline: Sequence[Sequence[float]], size: float, paint: str) -> str:
    """Return copies of an outline at all positions."""
    strokes = [np.rint(10.0 * size * np.reshape(stroke, (-1, 2)) * (1.0, -1.0)).astype(np.int64) for stroke in outline]
    moves = [in_tenths(np.diff(stroke, axis=0).ravel().tolist()) for stroke in strokes]
    ends = ["z" if np.array_equal(stroke[0], stroke[-1]) else "" for stroke in strokes]

    lines = (
        f"M{in_tenths(stroke[0].tolist())}l{move}{end}" for stroke, move, end in zip(strokes, moves, ends, strict=True)
    )
    path = f'<path d="{"".join(lines)}" {paint}/>'
    return frame.repeat(path, [(x / 10.0, y / 10.0) for x, y in positions.tolist()]) if positions.size else ""
