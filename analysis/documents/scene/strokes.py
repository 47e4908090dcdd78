"""Bodies, arrows and lines of a view at one sample as strokes with depths."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from markupsafe import Markup

from .camera import Camera
from .clipping import visible_stretches
from .ground import Ground
from .painting import Stroke
from .pen import BEAM, HEIGHT, WIDTH, lighter, path, point_of
from .solids import facets_of
from .view import ArrowView, BodyView, SceneView, position_at

SHAFT, HEAD = 0.026, (0.16, 0.1)  # shaft's width, and the head's length and width, over an arrow's length
SEGMENTS = 24  # segments of a shaft, which are ordered individually behind or before facets
OVERLAP = 0.2  # fraction by which segments overlap, to close gaps
LIGHT = np.array([-0.515, 0.735, -0.441])  # direction towards the light: from the left, above and behind the camera
DARKEST = 0.6  # least brightness of a facet


def body_strokes(scene: SceneView, camera: Camera, row: int) -> Iterator[Stroke]:
    """Yield the facets of bodies that face the camera."""
    for body in scene.bodies:
        turn = attitude_at(body, row)
        if turn is None:
            continue
        for facet in facets_of(body):
            corners = camera.look(position_at(body, row) + facet.corners @ turn.T)
            normal = camera.axes @ (turn @ facet.normal)
            if normal @ corners.mean(axis=0) >= 0.0 or corners[:, 2].min() <= 0.0:
                continue
            light = DARKEST + (1.0 - DARKEST) * max(float(normal @ LIGHT), 0.0)
            shade = "#" + "".join(f"{round(light * int(facet.colour[k : k + 2], 16)):02x}" for k in (1, 3, 5))
            markup = Markup('<path class="facet" d="{}z" fill="{}" stroke="{}" stroke-width=".4"/>')
            yield Stroke(corners, markup.format(path(camera.project(corners)), shade, shade), normal)


def attitude_at(body: BodyView, row: int) -> np.ndarray | None:
    """Return the rotation matrix from body to scene, or None if position or attitude is unknown."""
    quaternion = np.array([column[row] for column in body.attitude])
    if not quaternion.size or not np.all(np.isfinite([*quaternion, *position_at(body, row)])):
        return None
    w, (x, y, z) = quaternion[0], quaternion[1:]
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross)


def line_strokes(scene: SceneView, camera: Camera, ground: Ground | None, row: int) -> Iterator[Stroke]:
    """Yield the lines that are visible at this sample."""
    for line in scene.lines:
        if line.condition is not None and line.condition[row] == 0.0:
            continue
        start = point_of(scene, line.start, row)
        if line.end is not None:
            end = point_of(scene, line.end, row)
        elif ground is not None:
            end = start - ground.height(start) * ground.level(start)[0]
        else:
            continue
        for stretch in visible_stretches(camera.look(np.stack([start, end])), camera.tangent, WIDTH / HEIGHT):
            markup = Markup('<path class="line" d="{}" style="stroke:{}" fill="none" stroke-dasharray="4"/>')
            yield Stroke(stretch, markup.format(path(camera.project(stretch)), BEAM))


class ArrowStrokes(NamedTuple):
    """An arrow as strokes, which bodies may hide, and as one outline; its name and its end (m), [3]."""

    name: str
    end: np.ndarray
    strokes: list[Stroke]
    outline: Markup


def arrow_strokes(scene: SceneView, camera: Camera, ground: Ground | None, row: int) -> Iterator[ArrowStrokes]:
    """Yield the arrows with known origin and direction that are in front of the camera and not hidden by the ground."""
    for arrow in scene.arrows:
        ends = _arrow_ends(scene, camera, arrow, row)
        if ends is None or (ground is not None and ground.hides(camera.eye, ends[:1])[0]):
            continue
        way = ends[1] - ends[0]
        shaft = camera.look(ends[0] + np.linspace(0.0, 1.0 - HEAD[0], SEGMENTS + 1)[:, None] * way)
        head = camera.look(ends[1] - np.array([[HEAD[0]], [0.0]]) * way)
        if min(shaft[:, 2].min(), head[:, 2].min()) <= 0.0:
            continue
        colour = lighter(arrow.colour)
        widths = HEIGHT * float(np.linalg.norm(way)) / (2.0 * camera.tangent * shaft[:, 2])
        line = Markup('<path d="{}" style="stroke:{}" stroke-width="{:.2f}"/>')
        strokes = []
        for k in range(SEGMENTS):
            longer = shaft[k : k + 2] + OVERLAP * np.array([[-1.0], [1.0]]) * (shaft[k + 1] - shaft[k])
            strokes.append(
                Stroke(shaft[k : k + 2], line.format(path(camera.project(longer)), colour, SHAFT * widths[k]))
            )
        tip = Markup('<path class="arrow" d="{}z" style="fill:{}"/>')
        tip = tip.format(path(_head(camera.project(head), HEAD[1] * widths[-1] / HEIGHT)), colour)
        whole = line.format(path(camera.project(shaft[[0, -1]])), colour, SHAFT * widths[0])
        yield ArrowStrokes(arrow.name, ends[1], [*strokes, Stroke(head, tip)], whole + tip)


def _head(ends: np.ndarray, width: float) -> np.ndarray:
    """Return the corners of an arrow head, [3, 2], with the tip second; ``ends`` are the ends of the shaft, [2, 2]."""
    along = ends[1] - ends[0]
    length = float(np.linalg.norm(along))
    across = np.array([-along[1], along[0]]) * (width / (2.0 * length) if length > 0.0 else 0.0)
    return np.array([ends[0] + across, ends[1], ends[0] - across])


def _arrow_ends(scene: SceneView, camera: Camera, arrow: ArrowView, row: int) -> np.ndarray | None:
    """Return both ends (m) of an arrow, [2, 3], or None if direction or origin is unknown, or behind the camera."""
    start = point_of(scene, arrow.start, row)
    direction = np.array([column[row] for column in arrow.direction])
    depth = float(camera.look(start[None])[0, 2])
    if not np.all(np.isfinite([*start, *direction])) or depth <= 0.0:
        return None
    length = arrow.length * (2.0 * camera.tangent * depth if arrow.on_screen else 1.0)
    return np.stack([start, start + length * direction])
