"""Points, directions and an orbit at which models are compared. Needs numpy alone."""

import numpy as np

# m, m/s, inertial: a circle at 500 km, inclined by 97.4 deg
LOW_ORBIT = (6878137.0, 0.0, 0.0), (0.0, -980.4704108126322, 7549.203993067037)


def directions(number: int) -> np.ndarray:
    """Return unit vectors that cover a sphere evenly along a spiral, after both poles, [number, 3]."""
    k = np.arange(number - 2) + 0.5
    z = 1.0 - 2.0 * k / (number - 2)
    angle = np.pi * (1.0 + np.sqrt(5.0)) * k
    across = np.sqrt(1.0 - z * z)
    spiral = np.stack([across * np.cos(angle), across * np.sin(angle), z], axis=1)
    return np.vstack([[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]], spiral])


def points(number: int, nearest: float, farthest: float) -> np.ndarray:
    """Return positions (m) in these directions at distances (m) that grow from the nearest to the farthest."""
    return np.linspace(nearest, farthest, number)[:, None] * directions(number)


def attitudes(number: int) -> np.ndarray:
    """Return quaternions of turns about these directions by angles (rad) between 0.1 and 3, scalar first."""
    half = 0.5 * np.linspace(0.1, 3.0, number)[:, None]
    return np.hstack([np.cos(half), np.sin(half) * directions(number)])
