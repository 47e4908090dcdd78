"""Positions above a round body: its radius, if signals reveal it, and distances along its ground.

Positions are in m in the frame of a landing site: z is up, and the body's centre is at (0, 0, -radius).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

FLATNESS = 1e-3  # m, least difference between altitude and height above the tangent plane that reveals the curvature
MISMATCH = 1e-3  # m, largest error of an altitude on the fitted sphere, plus 1e-6 of the distance


def radius_of(position: np.ndarray, altitude: np.ndarray) -> float | None:
    """Return the radius (m) of the sphere above which positions, [3, n], have these altitudes (m), [n], or None.

    With the centre at (0, 0, -R) and |p - centre| = R + a, |p|^2 - a^2 = 2 R (a - z): a line through the origin whose
    slope is fitted by least squares. None if no sphere fits, or if the motion is too short for the curvature to be
    observable.
    """
    finite = np.all(np.isfinite(position), axis=0) & np.isfinite(altitude)
    points, height = position[:, finite], altitude[finite]
    rise = 2.0 * (height - points[2])
    if not rise.size or np.max(np.abs(rise)) < FLATNESS:
        return None
    square = np.sum(points**2, axis=0) - height**2
    radius = float(np.sum(rise * square) / np.sum(rise**2))
    if radius <= 0.0:
        return None
    error = np.abs(altitude_over(points, radius) - height)
    return radius if np.all(error <= MISMATCH + 1e-6 * np.linalg.norm(points, axis=0)) else None


def altitude_over(position: np.ndarray, radius: float) -> np.ndarray:
    """Return the altitudes (m) of positions, [3, n], above a sphere of this radius (m)."""
    x, y, z = position
    return np.sqrt(x**2 + y**2 + (z + radius) ** 2) - radius


def track_angles(
    position: np.ndarray, radius: float, target: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return angles (rad) along and across the great circle through the target that best fits a track.

    ``position`` is [3, n]; ``target``, [3], is by default the origin of the frame. The angle along is 0 at the target,
    grows in the direction of flight, and is continuous beyond half the circumference; at the row nearest to the target
    its magnitude is at most pi. Non-finite rows are NaN. A track without horizontal direction, vertical or at rest, is
    treated as a track along x.
    """
    centre = np.array([0.0, 0.0, -radius])
    up = (np.zeros(3) if target is None else target) - centre
    up = up / np.linalg.norm(up)
    finite = np.all(np.isfinite(position), axis=0)
    along, across = np.full(position.shape[1], np.nan), np.full(position.shape[1], np.nan)
    if not finite.any():
        return along, across
    direction = position[:, finite] - centre[:, None]
    direction = direction / np.linalg.norm(direction, axis=0)
    normal = _normal(direction, up)
    angle = np.unwrap(np.arctan2(np.cross(normal, up) @ direction, up @ direction))
    nearest = int(np.argmax(up @ direction))
    along[finite] = angle - 2.0 * np.pi * np.round(angle[nearest] / (2.0 * np.pi))
    across[finite] = np.arcsin(np.clip(normal @ direction, -1.0, 1.0))
    return along, across


def downrange(position: np.ndarray, radius: float, target: np.ndarray | None = None) -> np.ndarray:
    """Return the distance (m) of positions, [3, n], along the ground past the target, as in `track_angles`.

    In figures it grows to the right: flights begin at the left, where it is negative, and end near 0.
    """
    return radius * track_angles(position, radius, target)[0]


def track_normal(position: np.ndarray, centre: Sequence[float]) -> np.ndarray:
    """Return the unit normal, [3], of the great circle that best fits a track, [3, n], around a ``centre``.

    The circle passes through the point above the centre, along z. The track turns about the normal in the direction of
    flight. A track without horizontal direction is treated as a track along x.
    """
    direction = position[:, np.all(np.isfinite(position), axis=0)] - np.array(centre)[:, None]
    return _normal(direction / np.linalg.norm(direction, axis=0), np.array([0.0, 0.0, 1.0]))


def _normal(direction: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Return the unit normal of the great circle through ``up`` that best fits directions, [3, n], from the centre."""
    turning = np.sum(np.cross(direction[:, :-1], direction[:, 1:], axis=0), axis=1)
    normal = turning - (turning @ up) * up
    if np.linalg.norm(normal) < 1e-12:
        normal = np.cross(up, [1.0, 0.0, 0.0])
    return normal / np.linalg.norm(normal)
