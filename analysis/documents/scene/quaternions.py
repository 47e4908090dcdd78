"""Unit quaternions over time: [4, n], scalar first, from body to reference; vectors are [3, n]."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

AXES = "xyz"


def multiply(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return the product of quaternions: rotation ``first``, followed by ``second`` about the rotated axes."""
    a, u = first[0], first[1:]
    b, v = second[0], second[1:]
    return np.concatenate([(a * b - np.sum(u * v, axis=0))[None], a * v + b * u + np.cross(u, v, axis=0)])


def compose_rotations(turns: Iterable[tuple[str, np.ndarray]], size: int) -> np.ndarray:
    """Return the composition of rotations by angles (rad), [n], each about its axis as rotated by the previous ones."""
    total = np.zeros((4, size))
    total[0] = 1.0
    for axis, angle in turns:
        single = np.zeros((4, size))
        single[0] = np.cos(0.5 * angle)
        single[1 + AXES.index(axis)] = np.sin(0.5 * angle)
        total = multiply(total, single)
    return total


def rotate(quaternion: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Rotate vectors, [3, n], from body axes to reference axes."""
    u = quaternion[1:]
    across = 2.0 * np.cross(u, vector, axis=0)
    return vector + quaternion[0] * across + np.cross(u, across, axis=0)


def normalise(vector: np.ndarray) -> np.ndarray:
    """Scale vectors or quaternions to norm 1; vectors of norm 0 become NaN."""
    length = np.sqrt(np.sum(vector**2, axis=0))
    return vector / np.where(length > 0.0, length, np.nan)


def make_continuous(quaternion: np.ndarray) -> np.ndarray:
    """Return the same attitudes with signs chosen to be nearest to the previous sample; NaN is unchanged."""
    finite = np.flatnonzero(np.all(np.isfinite(quaternion), axis=0))
    chosen = quaternion[:, finite]
    signs = np.where(np.sum(chosen[:, 1:] * chosen[:, :-1], axis=0) < 0.0, -1.0, 1.0)
    result = quaternion.copy()
    result[:, finite] = chosen * np.cumprod(np.concatenate([[1.0], signs]))[: finite.size]
    return result


def transport_axis(axis: np.ndarray) -> np.ndarray:
    """Return attitudes with z axes along these directions, [3, n], without rotation about z between samples.

    The first attitude rotates z to its direction by the shortest rotation. The rotation from sample to sample is the
    shortest, too, so the unknown roll adds no rotation, whatever the direction. NaN where a direction is non-finite or
    zero.
    """
    unit = normalise(axis)
    carried = np.full((4, unit.shape[1]), np.nan)
    attitude, before = (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 1.0)
    for index in np.flatnonzero(np.all(np.isfinite(unit), axis=0)):
        now = tuple(unit[:, index].tolist())
        if now != before:
            attitude = _product(_shortest(before, now), attitude)
            before = now
        carried[:, index] = attitude
    return normalise(carried)


def _shortest(start: tuple[float, ...], end: tuple[float, ...]) -> tuple[float, ...]:
    """Return the shortest rotation between unit vectors; about any perpendicular axis if they are opposite."""
    x, y, z = start
    cosine = x * end[0] + y * end[1] + z * end[2]
    if cosine < -1.0 + 1e-12:
        length = math.hypot(x, z) if abs(y) < 0.9 else math.hypot(y, z)
        return (0.0, -z / length, 0.0, x / length) if abs(y) < 0.9 else (0.0, 0.0, z / length, -y / length)
    rotated = (1.0 + cosine, y * end[2] - z * end[1], z * end[0] - x * end[2], x * end[1] - y * end[0])
    length = math.sqrt(sum(component * component for component in rotated))
    w, a, b, c = (component / length for component in rotated)
    return w, a, b, c


def _product(first: tuple[float, ...], second: tuple[float, ...]) -> tuple[float, float, float, float]:
    """Return the product of two quaternions as in `multiply`."""
    a, b, c, d = first
    e, f, g, h = second
    return (
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    )
