"""Curves, areas and rules in SVG."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ...interactive.charts import Area, Curve, Rule
from .frame import Frame
from .polyline import path_of


def draw_curve(frame: Frame, curve: Curve) -> str:
    """Return the line of a curve; empty if its points are not joined."""
    if not curve.joined:
        return ""
    x, y = frame.across(curve.x), frame.down(curve.displayed)
    path = path_of(x, y, steps=curve.steps, width=frame.width)
    return (
        f'<path d="{path}" stroke="{curve.colour}" stroke-width="{curve.width:g}" stroke-linejoin="round"'
        f"{dashed(curve.width, curve.dashes)}{opaque('', curve.opacity)}/>"
    )


def draw_area(frame: Frame, area: Area) -> str:
    """Return a filled polygon, or strokes, of which consecutive ones are joined."""
    x, y = frame.across(area.x, of_axes=area.of_axes[0]), frame.down(area.y, of_axes=area.of_axes[1])
    if not area.stroke:
        path = path_of(x, y, steps=False)
        return f'<path d="{path}z" fill="{area.colour}"{opaque("fill-", area.opacity)}/>'
    path = path_of(*_joined(x, y), steps=False)
    return (
        f'<path d="{path}" stroke="{area.colour}" stroke-width="{area.stroke:g}"'
        f"{dashed(area.stroke, area.dashes)}{opaque('', area.opacity)}/>"
    )


def draw_rule(frame: Frame, rule: Rule) -> str:
    """Return a straight line across the axes; empty outside their ends."""
    low, high = (frame.x if rule.upright else frame.y).ends
    if not min(low, high) <= rule.at <= max(low, high):
        return ""
    x, y = frame.point((rule.at, rule.at), (not rule.upright, rule.upright))
    path = (
        f"M{x:.2f} {frame.top:.2f}v{frame.height:.2f}"
        if rule.upright
        else f"M{frame.left:.2f} {y:.2f}h{frame.width:.2f}"
    )
    return f'<path d="{path}" stroke="{rule.colour}" stroke-width="{rule.width:g}"{dashed(rule.width, rule.dashes)}/>'


def dashed(width: float, dashes: Sequence[float]) -> str:
    """Return the attribute for dashes in multiples of the line width."""
    return f' stroke-dasharray="{" ".join(f"{width * each:g}" for each in dashes)}"' if dashes else ""


def opaque(kind: str, opacity: float) -> str:
    """Return the attribute for an opacity below 1; ``kind`` restricts it: fill- or stroke-."""
    return f' {kind}opacity="{opacity:g}"' if opacity < 1.0 else ""


def _joined(x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return strokes between pairs of points as lines separated by NaN."""
    points, gap = np.stack([x, y]), np.full((2, 1), np.nan)
    begins, ends = points[:, ::2], points[:, 1::2]
    breaks = np.flatnonzero(np.any(begins[:, 1:] != ends[:, :-1], axis=0)) + 1
    lines = [
        np.concatenate([begins[:, first : first + 1], ends[:, first:after], gap], axis=1)
        for first, after in pairwise([0, *breaks, begins.shape[1]])
    ]
    return tuple(np.concatenate(lines, axis=1))
