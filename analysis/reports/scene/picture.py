"""A view at one sample as SVG, for pages without scripts: what the page's script shows at first, in a few strokes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np
from markupsafe import Markup

from .camera import Camera, first_camera
from .clipping import clip_polygon, visible_stretches
from .ground import Ground, ground_of
from .painting import Stroke, in_order
from .solids import faces_of
from .view import ArrowView, BodyView, SceneView, SiteView, position_at

WIDTH, HEIGHT = 400.0, 290.0  # units of the picture
SHAFT, HEAD = 0.026, (0.16, 0.1)  # of an arrow: width, and length and width of its head, over its length
PIECES = 24  # of a shaft, each behind or before the faces of a body
LIGHT = np.array([-0.515, 0.735, -0.441])  # towards it, from the left, above and behind the camera
DARKEST = 0.6  # of a face's colour
NAMED, RINGED = 0.23, 0.045  # of the picture's height: larger bodies have no name, no ring
SKY, LAND = "light-dark(#eef2f6, #0d1117)", "light-dark(#d8d4cc, #3a3936)"
INK, BEAM = "light-dark(#222, #e6e6e6)", "light-dark(#c92a2a, #ff8787)"
AXES = ("light-dark(#d9480f, #ff922b)", "light-dark(#2b8a3e, #69db7c)", "light-dark(#1c6fd0, #74c0fc)")
GHOST = 0.3  # opacity of an arrow where a body hides it


def draw_ends(scene: SceneView) -> list[tuple[float, Markup]]:
    """The first and the last sample at which the first body has a position: times (s) and pictures."""
    known = np.flatnonzero(np.all(np.isfinite(scene.bodies[0].position), axis=0))
    rows = [] if not known.size else sorted({int(known[0]), int(known[-1])})
    drawn = ((float(scene.time[row]), draw_scene(scene, row)) for row in rows)
    return [(time, picture) for time, picture in drawn if picture is not None]


def draw_scene(scene: SceneView, row: int) -> Markup | None:
    """The <svg> element of a view at a sample; None where the first body has no position then."""
    ground = ground_of(scene)
    camera = first_camera(scene, ground, row)
    if camera is None:
        return None
    arrows = list(_arrows(scene, camera, ground, row))
    strokes = in_order([*_bodies(scene, camera, row), *_lines(scene, camera, ground, row), *arrows])
    parts = [
        *_land(camera, ground),
        *_paths(scene, camera, ground),
        *(stroke.markup for stroke in strokes),
        Markup('<g opacity="{:g}">').format(GHOST),
        *(arrow.markup for arrow in arrows),
        Markup("</g>"),
        *_names(scene, camera, ground, row),
        *_triad(scene, camera),
    ]
    head = Markup(
        '<svg class="still-scene" role="img" aria-label="{}" viewBox="0 0 {:g} {:g}" style="background:{}">'
    ).format(f"{scene.title} at {float(scene.time[row]):g} s", WIDTH, HEIGHT, SKY)
    return head + Markup("").join(parts) + Markup("</svg>")


def _land(camera: Camera, ground: Ground | None) -> Iterator[Markup]:
    if ground is not None:
        edge = clip_polygon(camera.look(ground.horizon(camera.eye)), camera.tangent, WIDTH / HEIGHT)
        if len(edge):
            yield Markup('<path d="{}z" style="fill:{}"/>').format(_path(camera.project(edge)), LAND)


def _bodies(scene: SceneView, camera: Camera, row: int) -> Iterator[Stroke]:
    for body in scene.bodies:
        turn = _attitude(body, row)
        if turn is None:
            continue
        for face in faces_of(body):
            corners = camera.look(position_at(body, row) + face.corners @ turn.T)
            normal = camera.axes @ (turn @ face.normal)
            if normal @ corners.mean(axis=0) >= 0.0 or corners[:, 2].min() <= 0.0:
                continue  # it looks away, or is behind the camera
            light = DARKEST + (1.0 - DARKEST) * max(float(normal @ LIGHT), 0.0)
            shade = "#" + "".join(f"{round(light * int(face.colour[k : k + 2], 16)):02x}" for k in (1, 3, 5))
            markup = Markup('<path class="face" d="{}z" fill="{}" stroke="{}" stroke-width=".4"/>')
            yield Stroke(corners, markup.format(_path(camera.project(corners)), shade, shade), normal)


def _attitude(body: BodyView, row: int) -> np.ndarray | None:
    """The matrix from body to scene; None where position or attitude is unknown."""
    quaternion = np.array([column[row] for column in body.attitude])
    if not quaternion.size or not np.all(np.isfinite(quaternion)) or not np.all(np.isfinite(position_at(body, row))):
        return None
    w, (x, y, z) = quaternion[0], quaternion[1:]
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross)


def _arrows(scene: SceneView, camera: Camera, ground: Ground | None, row: int) -> Iterator[Stroke]:
    for arrow in scene.arrows:
        ends = arrow_ends(scene, camera, arrow, row)
        if ends is None or (ground is not None and ground.hides(camera.eye, ends[:1])[0]):
            continue
        way = ends[1] - ends[0]
        points = camera.look(ends[0] + np.linspace(0.0, 1.0 - HEAD[0], PIECES + 1)[:, None] * way)
        tip = camera.look(ends[1:])
        if min(points[:, 2].min(), tip[0, 2]) <= 0.0:
            continue
        flat, colour = camera.project(points), _lighter(arrow.colour)
        scale = float(np.linalg.norm(way)) / (2.0 * camera.tangent * points[:, 2])
        for k in range(PIECES):
            markup = Markup('<path d="{}" style="stroke:{}" stroke-width="{:.2f}"/>')
            line = markup.format(_path(flat[k : k + 2]), colour, HEIGHT * SHAFT * scale[k])
            yield Stroke(points[k : k + 2], line)
        end = camera.project(tip)[0]
        along = end - flat[-1]
        length = float(np.linalg.norm(along))
        if length > 0.0:
            across = np.array([-along[1], along[0]]) / length * HEAD[1] * scale[-1] / 2.0
            corners = np.array([flat[-1] + across, end, flat[-1] - across])
            markup = Markup('<path class="arrow" d="{}z" style="fill:{}"/>')
            yield Stroke(np.concatenate([points[-1:], tip]), markup.format(_path(corners), colour))


def arrow_ends(scene: SceneView, camera: Camera, arrow: ArrowView, row: int) -> np.ndarray | None:
    """Both ends (m) of an arrow, [2, 3]; None where direction or origin is unknown, or behind the camera."""
    start = _point(scene, arrow.start, row)
    direction = np.array([column[row] for column in arrow.direction])
    depth = float(camera.look(start[None])[0, 2])
    if not np.all(np.isfinite([*start, *direction])) or depth <= 0.0:
        return None
    length = arrow.length * (2.0 * camera.tangent * depth if arrow.on_screen else 1.0)
    return np.stack([start, start + length * direction])


def _point(scene: SceneView, name: str, row: int) -> np.ndarray:
    points: Sequence[BodyView | SiteView] = [*scene.bodies, *scene.sites]
    return next(position_at(each, row) for each in points if each.name == name)


def _lines(scene: SceneView, camera: Camera, ground: Ground | None, row: int) -> Iterator[Stroke]:
    for line in scene.lines:
        start = _point(scene, line.start, row)
        if line.end is not None:
            end = _point(scene, line.end, row)
        elif ground is not None:
            end = start - ground.height(start) * ground.level(start)[0]
        if line.condition is not None and line.condition[row] == 0.0:
            continue
        for stretch in visible_stretches(camera.look(np.stack([start, end])), camera.tangent, WIDTH / HEIGHT):
            markup = Markup('<path class="line" d="{}" style="stroke:{}" fill="none" stroke-dasharray="4"/>')
            yield Stroke(stretch, markup.format(_path(camera.project(stretch)), BEAM))


def _paths(scene: SceneView, camera: Camera, ground: Ground | None) -> Iterator[Markup]:
    for body in scene.bodies:
        points = np.stack(body.position, axis=1)
        if ground is not None:
            points = np.where(ground.hides(camera.eye, points)[:, None], np.nan, points)
        stretches = visible_stretches(camera.look(points), camera.tangent, WIDTH / HEIGHT)
        drawn = "".join(_path(_thin(camera.project(stretch))) for stretch in stretches)
        if drawn:
            markup = Markup('<path class="path" d="{}" style="stroke:{}" fill="none" stroke-width=".7"/>')
            yield markup.format(drawn, _lighter(body.colour))


def _thin(points: np.ndarray) -> np.ndarray:
    """Points of a path without those that are nearer than half a unit to the one before."""
    kept = [0]
    for index in range(1, len(points)):
        if index == len(points) - 1 or math.dist(points[index], points[kept[-1]]) > 0.5 / HEIGHT:
            kept.append(index)
    return points[kept]


def _names(scene: SceneView, camera: Camera, ground: Ground | None, row: int) -> Iterator[Markup]:
    labels: list[tuple[str, str, np.ndarray, float]] = []
    for body in scene.bodies:
        extent = max(body.size) if _attitude(body, row) is not None else 0.0
        labels.append((body.name, body.colour, position_at(body, row), extent))
    labels += [(site.name, site.colour, position_at(site, row), 0.0) for site in scene.sites]
    for name, colour, point, extent in labels:
        seen = _on_picture(camera, ground, point)
        if seen is None:
            continue
        size = extent / (2.0 * camera.tangent * float(camera.look(point[None])[0, 2]))
        x, y = seen
        if size < RINGED:
            markup = Markup('<circle cx="{:.1f}" cy="{:.1f}" r="4" fill="none" style="stroke:{}" stroke-width="1.3"/>')
            yield markup.format(x, y, _lighter(colour))
        if size < NAMED:
            yield _text(name, x, y - 6.0 - 0.5 * size * HEIGHT)
    for arrow in scene.arrows:
        ends = arrow_ends(scene, camera, arrow, row)
        seen = None if ends is None else _on_picture(camera, ground, ends[1])
        if seen is not None:
            yield _text(arrow.name, seen[0], seen[1] - 4.0, "arrow-name")


def _on_picture(camera: Camera, ground: Ground | None, point: np.ndarray) -> tuple[float, float] | None:
    """Where a point is on the picture; None where it is outside, behind the camera or hidden by the ground."""
    seen = camera.look(point[None])
    if not seen[0, 2] > 0.0 or (ground is not None and ground.hides(camera.eye, point[None])[0]):
        return None
    x, y = camera.project(seen)[0] * HEIGHT + [WIDTH / 2.0, HEIGHT / 2.0]
    return (float(x), float(y)) if 0.0 <= x <= WIDTH and 0.0 <= y <= HEIGHT else None


def _triad(scene: SceneView, camera: Camera) -> Iterator[Markup]:
    """The axes of the frame with their names, as the camera sees them."""
    for name, axis, colour, (x, y, depth) in zip(scene.axes, "xyz", AXES, camera.axes.T, strict=True):
        x0, y0, opacity = WIDTH - 46.0, 40.0, 0.55 if depth > 0.2 else 1.0
        markup = Markup('<path d="M{:g} {:g}l{:.1f} {:.1f}" style="stroke:{}" stroke-width="1.6" opacity="{:g}"/>')
        yield markup.format(x0, y0, 22.0 * x, -22.0 * y, colour, opacity)
        text = axis if name == axis else f"{axis} {name}"
        yield _text(text, x0 + 30.0 * x, y0 - 30.0 * y + 4.0, "axis", colour)


def _text(text: str, x: float, y: float, kind: str = "name", colour: str = INK) -> Markup:
    markup = Markup('<text class="{}" x="{:.1f}" y="{:.1f}" style="fill:{};stroke:{}">{}</text>')
    return markup.format(kind, x, y, colour, SKY, text)


def _path(points: np.ndarray) -> str:
    """The commands of a line through points of `Camera.project`, [n, 2]."""
    placed = points * HEIGHT + [WIDTH / 2.0, HEIGHT / 2.0]
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in placed)


def _lighter(colour: str) -> str:
    """A colour that is a quarter lighter where the page is dark."""
    light = "#" + "".join(f"{round(0.75 * int(colour[k : k + 2], 16) + 0.25 * 255):02x}" for k in (1, 3, 5))
    return f"light-dark({colour}, {light})"
