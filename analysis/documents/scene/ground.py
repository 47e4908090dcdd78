"""Ground of a view: heights, visibility, horizon. Points (m) are relative to the view's origin."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .view import SceneView

CORNERS = 720  # corners of the horizon of a sphere
FARTHEST = 1e4  # distance to the edge of a plane, in heights of the eye
SUNK = 0.5  # m, depth below the ground up to which points are not hidden


@dataclass(frozen=True)
class Ground:
    """A sphere around ``centre`` (m), with a grid about ``normal``; or a plane z = constant through ``centre``."""

    centre: np.ndarray
    radius: float
    normal: np.ndarray

    def height(self, point: np.ndarray) -> float:
        """Return the height (m) of a point, [3]."""
        if math.isinf(self.radius):
            return float(point[2] - self.centre[2])
        return float(np.linalg.norm(point - self.centre)) - self.radius

    def level(self, point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return unit vectors upwards, and along the grid, below a point, [3]."""
        if math.isinf(self.radius):
            return np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
        up = (point - self.centre) / np.linalg.norm(point - self.centre)
        along = np.cross(self.normal, up)
        return up, along / np.linalg.norm(along)

    def hides(self, eye: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Return True for each of the points, [n, 3], that the ground hides from the eye, [3]."""
        if math.isinf(self.radius):
            return (points[:, 2] - self.centre[2]) * self.height(eye) < 0.0
        start, way = eye - self.centre, points - eye
        fraction = np.clip(-(way @ start) / np.sum(way**2, axis=1), 0.0, 1.0)
        return np.linalg.norm(start + fraction[:, None] * way, axis=1) < self.radius - SUNK

    def horizon(self, eye: np.ndarray) -> np.ndarray:
        """Return the horizon as viewed from the eye, [n, 3]: for a sphere the points of tangency."""
        up, along = self.level(eye)
        across = np.cross(up, along)
        if math.isinf(self.radius):
            extent = FARTHEST * max(self.height(eye), 1.0)
            foot = eye - self.height(eye) * up
            return foot + extent * np.array([along + across, across - along, -along - across, along - across])
        angle = math.acos(self.radius / (self.radius + max(self.height(eye), 0.0)))
        around = np.linspace(0.0, 2.0 * np.pi, CORNERS, endpoint=False)[:, None]
        circle = np.cos(around) * along + np.sin(around) * across
        return self.centre + self.radius * (math.cos(angle) * up + math.sin(angle) * circle)


def ground_of(scene: SceneView) -> Ground | None:
    """Return the ground of a view, or None if there is none."""
    if scene.ground is None:
        return None
    origin = np.array(scene.origin)
    if scene.ground.radius is None or scene.ground.centre is None or scene.ground.normal is None:
        return Ground(-origin, math.inf, np.zeros(3))
    return Ground(np.array(scene.ground.centre) - origin, scene.ground.radius, np.array(scene.ground.normal))
