"""Initial camera of a view: aimed at the first body, level with the horizon, with all bodies in view.

web/scene/camera.ts moves it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .ground import Ground
from .view import SceneView, position_at

LOWEST = 0.05  # least height of the camera above the ground over its distance, at most 2 m
DEEP = -0.5  # height in radii below which the camera's axes are the frame's
UP = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
FORWARD = {"x": "y", "y": "x", "z": "x"}


@dataclass(frozen=True)
class Camera:
    """Position ``eye`` (m), axes right, up and forward as rows, and the tangent of half the vertical field of view."""

    eye: np.ndarray
    axes: np.ndarray
    tangent: float

    def look(self, points: np.ndarray) -> np.ndarray:
        """Return points (m), [n, 3], in camera axes, [n, 3]: right, up, depth."""
        return np.asarray((points - self.eye) @ self.axes.T)

    def project(self, points: np.ndarray) -> np.ndarray:
        """Project points from `look` to the picture, [n, 2].

        The result is the distance to the right of and below the centre of the picture, divided by its height.
        """
        return np.asarray(points[:, :2] * [0.5, -0.5] / (self.tangent * points[:, 2:]))


def first_camera(scene: SceneView, ground: Ground | None, row: int) -> Camera | None:
    """Return the camera at a sample, or None if the position of the first body is unknown."""
    body, start = scene.bodies[0], scene.camera
    target = position_at(body, row)
    if not np.all(np.isfinite(target)):
        return None
    up, forward = np.array(UP[scene.up]), np.array(UP[FORWARD[scene.up]])
    if ground is not None and not ground.height(target) < DEEP * ground.radius:
        up, forward = ground.level(target)
    distance = max(
        start.diagonals * math.hypot(*body.size), start.room * _extent(scene, row) / math.sin(0.5 * start.field)
    )
    level = math.cos(start.elevation) * distance
    eye = target + level * (math.cos(start.azimuth) * forward + math.sin(start.azimuth) * np.cross(up, forward))
    eye = eye + math.sin(start.elevation) * distance * up
    if ground is not None:
        missing = min(LOWEST * distance, 2.0) - ground.height(eye)
        eye = eye + max(missing, 0.0) * ground.level(eye)[0]
    ahead = (target - eye) / np.linalg.norm(target - eye)
    right = np.cross(ahead, up)
    right = right / np.linalg.norm(right)
    return Camera(eye, np.stack([right, np.cross(right, ahead), ahead]), math.tan(0.5 * start.field))


def _extent(scene: SceneView, row: int) -> float:
    """Return the extent (m) of the other bodies around the first one at a sample; 0 without others."""
    first, *others = scene.bodies
    ends = [
        float(np.linalg.norm(position_at(body, row) - position_at(first, row))) + 0.5 * math.hypot(*body.size)
        for body in others
    ]
    return max((end for end in ends if math.isfinite(end)), default=0.0)
