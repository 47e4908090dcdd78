"""Names and marks over the picture of a scene, and the axes of its frame, as in the page's script."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import numpy as np
from markupsafe import Markup

from .camera import Camera
from .ground import Ground
from .pen import AXES, HEIGHT, WIDTH, lighter, text, to_units
from .strokes import ArrowStrokes, attitude_at
from .view import BodyView, SceneView, SiteView, position_at

NAMED, RINGED = 0.23, 0.045  # sizes over the picture's height above which bodies have no name, no ring
CORNER = (WIDTH - 46.0, 40.0)  # position of the frame's axes
AXIS = 22.0  # length of an axis


def draw_names(
    scene: SceneView, arrows: Iterable[ArrowStrokes], camera: Camera, ground: Ground | None, row: int
) -> Iterator[Markup]:
    """Draw names of small bodies, sites and arrows, and rings around bodies too small to be visible."""
    points: list[BodyView | SiteView] = [*scene.bodies, *scene.sites]
    for point in points:
        extent = 0.0
        if isinstance(point, BodyView) and attitude_at(point, row) is not None:
            extent = max(point.size)
        at = position_at(point, row)
        position = _on_picture(camera, ground, at)
        if position is None:
            continue
        size = extent / (2.0 * camera.tangent * float(camera.look(at[None])[0, 2]))
        if size < RINGED:
            markup = Markup('<circle cx="{:.1f}" cy="{:.1f}" r="4" fill="none" style="stroke:{}" stroke-width="1.3"/>')
            yield markup.format(*position, lighter(point.colour))
        if size < NAMED:
            yield text(point.name, position[0], position[1] - 6.0 - 0.5 * size * HEIGHT)
    for arrow in arrows:
        position = _on_picture(camera, ground, arrow.end)
        if position is not None:
            yield text(arrow.name, position[0], position[1] - 4.0, "arrow-name")


def _on_picture(camera: Camera, ground: Ground | None, point: np.ndarray) -> tuple[float, float] | None:
    """Return the projection of a point; None if it is outside, behind the camera or hidden by the ground."""
    in_camera = camera.look(point[None])
    if not in_camera[0, 2] > 0.0 or (ground is not None and ground.hides(camera.eye, point[None])[0]):
        return None
    x, y = to_units(camera.project(in_camera))[0]
    return (float(x), float(y)) if 0.0 <= x <= WIDTH and 0.0 <= y <= HEIGHT else None


def draw_axes(scene: SceneView, camera: Camera) -> Iterator[Markup]:
    """Draw the axes of the frame with their names, as viewed by the camera; fainter if they point away."""
    for name, axis, colour, (x, y, depth) in zip(scene.axes, "xyz", AXES, camera.axes.T, strict=True):
        opacity = 0.55 if depth > 0.2 else 1.0
        markup = Markup('<path d="M{:g} {:g}l{:.1f} {:.1f}" style="stroke:{}" stroke-width="1.6" opacity="{:g}"/>')
        yield markup.format(*CORNER, AXIS * x, -AXIS * y, colour, opacity)
        at = CORNER[0] + 1.4 * AXIS * x, CORNER[1] - 1.4 * AXIS * y + 4.0
        yield text(axis if name == axis else f"{axis} {name}", *at, "axis", colour)
