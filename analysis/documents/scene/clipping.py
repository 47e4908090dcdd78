"""Clipping of polygons and paths at the edges of a picture.

Points are in the axes of `Camera.look`: right, up, depth (m).
"""

from __future__ import annotations

import numpy as np

LEAST_DEPTH = 1e-2  # m, least depth
WIDER = 1.05  # width of the clipping region over the picture's, so that clipped edges are outside the picture


def clip_polygon(corners: np.ndarray, tangent: float, aspect: float) -> np.ndarray:
    """Return the corners, [n, 3], of a convex polygon clipped to a picture with this aspect ratio and field of view."""
    for plane, offset in _planes(tangent, aspect):
        distance = corners @ plane - offset
        cut: list[np.ndarray] = []
        for k in range(len(corners)):
            if distance[k - 1] * distance[k] < 0.0:
                cut.append(
                    corners[k - 1] + (corners[k] - corners[k - 1]) * distance[k - 1] / (distance[k - 1] - distance[k])
                )
            if distance[k] >= 0.0:
                cut.append(corners[k])
        corners = np.array(cut).reshape(-1, 3)
    return corners


def visible_stretches(points: np.ndarray, tangent: float, aspect: float) -> list[np.ndarray]:
    """Return the visible stretches of a path through points, [n, 3]; NaN points interrupt it."""
    starts, ends = points[:-1], points[1:]
    low, high = np.zeros(len(starts)), np.where(np.all(np.isfinite(starts + ends), axis=1), 1.0, -1.0)
    for plane, offset in _planes(tangent, aspect):
        before, after = starts @ plane - offset, ends @ plane - offset
        with np.errstate(divide="ignore", invalid="ignore"):
            crossing = before / (before - after)
        low = np.where((before < 0.0) & (after >= 0.0), np.maximum(low, crossing), low)
        high = np.where((before >= 0.0) & (after < 0.0), np.minimum(high, crossing), high)
        high = np.where((before >= 0.0) | (after >= 0.0), high, -1.0)
    stretches: list[list[np.ndarray]] = []
    last = -2
    for index in np.flatnonzero(low < high):
        way = ends[index] - starts[index]
        first, final = starts[index] + low[index] * way, starts[index] + high[index] * way
        if index == last + 1 and low[index] == 0.0 and high[last] == 1.0:
            stretches[-1].append(final)
        else:
            stretches.append([first, final])
        last = int(index)
    return [np.array(stretch) for stretch in stretches]


def _planes(tangent: float, aspect: float) -> list[tuple[np.ndarray, float]]:
    """Return the planes that bound the visible space: inward normals, and distances from the eye."""
    wide, high = WIDER * aspect * tangent, WIDER * tangent
    sides = ((1.0, 0.0, wide), (-1.0, 0.0, wide), (0.0, 1.0, high), (0.0, -1.0, high))
    return [(np.array([0.0, 0.0, 1.0]), LEAST_DEPTH), *((np.array(side), 0.0) for side in sides)]
