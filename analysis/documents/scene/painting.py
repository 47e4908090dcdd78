"""Drawing order of a picture's strokes such that nearer ones hide farther ones (after Newell et al. 1972).

Points are in the axes of `Camera.look`: right, up, depth (m), with the eye at the origin.
"""

from __future__ import annotations

from graphlib import CycleError, TopologicalSorter
from itertools import combinations
from typing import NamedTuple

import numpy as np
from markupsafe import Markup

SAME = 1e-6  # distance up to which a point counts as on a plane, over its depth


class Stroke(NamedTuple):
    """A drawn element: its points, [n, 3], and for a facet its outward normal, [3]."""

    points: np.ndarray
    markup: Markup
    normal: np.ndarray | None = None

    @property
    def depth(self) -> float:
        return float(self.points[:, 2].mean())


def in_order(strokes: list[Stroke]) -> list[Stroke]:
    """Return the strokes, each after all strokes that it may hide; by depth alone if they form a cycle."""
    by_depth = sorted(strokes, key=lambda stroke: -stroke.depth)
    flat = [stroke.points[:, :2] / stroke.points[:, 2:] for stroke in by_depth]
    boxes = [(points.min(axis=0), points.max(axis=0)) for points in flat]
    before: dict[int, set[int]] = {index: set() for index in range(len(by_depth))}
    for first, second in combinations(range(len(by_depth)), 2):
        (low, high), (other_low, other_high) = boxes[first], boxes[second]
        if np.any(low > other_high) or np.any(other_low > high):
            continue
        behind, ahead = _lies_behind(by_depth[first], by_depth[second]), _lies_behind(by_depth[second], by_depth[first])
        if behind and not ahead:
            before[second].add(first)
        elif ahead and not behind:
            before[first].add(second)
    try:
        return [by_depth[index] for index in TopologicalSorter(before).static_order()]
    except CycleError:
        return by_depth


def _lies_behind(stroke: Stroke, other: Stroke) -> bool:
    """Return True if a facet's plane separates both strokes, with ``other`` on the side of the eye."""
    if other.normal is not None and np.all(_heights(stroke, other) <= SAME * other.depth):
        return True
    return stroke.normal is not None and bool(np.all(_heights(other, stroke) >= -SAME * stroke.depth))


def _heights(stroke: Stroke, facet: Stroke) -> np.ndarray:
    """Return the heights (m) of a stroke's points above the plane of a facet, [n]."""
    return np.asarray((stroke.points - facet.points[0]) @ facet.normal)
