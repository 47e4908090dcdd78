"""Marks of curves: their outlines, and curves that consist of marks only."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..interactive.charts import Curve, Marker
from .quantity import quantity_curve

# Outlines in units of the size, as x, y, x, y, ..., by matplotlib's letters.
OUTLINES: dict[str, tuple[tuple[float, ...], ...]] = {
    "s": ((-0.5, -0.5, 0.5, -0.5, 0.5, 0.5, -0.5, 0.5, -0.5, -0.5),),
    "D": ((0.0, -0.7071, 0.7071, 0.0, 0.0, 0.7071, -0.7071, 0.0, 0.0, -0.7071),),
    "d": ((0.0, -0.7071, 0.4243, 0.0, 0.0, 0.7071, -0.4243, 0.0, 0.0, -0.7071),),
    "v": ((0.0, -0.5, 0.5, 0.5, -0.5, 0.5, 0.0, -0.5),),
    "^": ((0.0, 0.5, -0.5, -0.5, 0.5, -0.5, 0.0, 0.5),),
    "<": ((-0.5, 0.0, 0.5, -0.5, 0.5, 0.5, -0.5, 0.0),),
    ">": ((0.5, 0.0, -0.5, 0.5, -0.5, -0.5, 0.5, 0.0),),
    "+": ((-0.5, 0.0, 0.5, 0.0), (0.0, -0.5, 0.0, 0.5)),
    "x": ((-0.5, -0.5, 0.5, 0.5), (-0.5, 0.5, 0.5, -0.5)),
    "|": ((0.0, -0.5, 0.0, 0.5),),
    "_": ((0.5, 0.0, -0.5, 0.0),),
    "P": (
        (
            *(-0.1667, -0.5, 0.1667, -0.5, 0.1667, -0.1667, 0.5, -0.1667, 0.5, 0.1667, 0.1667, 0.1667, 0.1667, 0.5),
            *(-0.1667, 0.5, -0.1667, 0.1667, -0.5, 0.1667, -0.5, -0.1667, -0.1667, -0.1667, -0.1667, -0.5),
        ),
    ),
    "X": (
        (
            *(-0.25, -0.5, 0.0, -0.25, 0.25, -0.5, 0.5, -0.25, 0.25, 0.0, 0.5, 0.25, 0.25, 0.5),
            *(0.0, 0.25, -0.25, 0.5, -0.5, 0.25, -0.25, 0.0, -0.5, -0.25, -0.25, -0.5),
        ),
    ),
}
ROUND = {"o": 1.0, ".": 0.5}  # diameters in units of the size
STROKES = "+x|_"  # marks without an area
SHAFT, HEAD, BARB = 0.018 * 72.0, 4.5, 5.5  # shaft's width (pt); head's width and length, in widths of the shaft


def marker(kind: str, size: float, colour: str, *, fill: str | None = None, width: float = 1.0) -> Marker:
    """Return the mark for one of matplotlib's marker letters; ``size`` and edge ``width`` are in pt.

    ``fill`` is the fill colour, by default the colour of the edge; empty for no fill.
    """
    painted = "" if kind in STROKES else colour if fill is None else fill
    edge = colour.lower() if width > 0.0 else ""
    return Marker(
        size=size * ROUND.get(kind, 1.0), outline=OUTLINES.get(kind, ()), fill=painted.lower(), edge=edge, width=width
    )


def marks(
    x: np.ndarray, y: np.ndarray, mark: Marker, *, name: str = "", unit: str | None = None, opacity: float = 1.0,
    beyond: bool = False,
) -> Curve:  # fmt: skip
    """Return a curve of unconnected marks; ``y`` is in ``unit``, [rows]. ``beyond`` permits marks outside the axes."""
    curve = quantity_curve(x, y, name, unit)
    colour = mark.edge or mark.fill
    return replace(curve, colour=colour, dashes=(), joined=False, marker=mark, opacity=opacity, beyond=beyond)


def mark(x: float, y: float, symbol: Marker, *, beyond: bool = False) -> Curve:
    """Return a mark at one point."""
    return marks(np.array([x]), np.array([y]), symbol, beyond=beyond)


def arrow(at: tuple[float, float], angle: float, length: float, colour: str, width: float = SHAFT) -> Curve:
    """Return an arrow from a data point at an ``angle`` (rad, counter-clockwise from the right of the figure).

    ``length`` and shaft ``width`` are in pt and independent of zoom.
    """
    half, barb = width / 2.0, min(BARB * width, length)
    shape = np.array(
        [
            [0.0, -half], [length - barb, -half], [length - barb, -HEAD * half], [length, 0.0],
            [length - barb, HEAD * half], [length - barb, half], [0.0, half], [0.0, -half],
        ]
    )  # fmt: skip
    cosine, sine = math.cos(angle), math.sin(angle)
    outline = np.round(shape @ np.array([[cosine, sine], [-sine, cosine]]) / length, 4)
    mark = Marker(size=length, outline=[outline.ravel().tolist()], fill=colour.lower(), width=0.0)
    return marks(np.array([at[0]]), np.array([at[1]]), mark)
