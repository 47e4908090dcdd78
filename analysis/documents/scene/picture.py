"""View at one sample as SVG, for pages without scripts: the initial view of the page's script, without flames."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from markupsafe import Markup

from .camera import Camera, first_camera
from .clipping import clip_polygon, visible_stretches
from .ground import Ground, ground_of
from .labels import draw_axes, draw_names
from .painting import in_order
from .pen import HEIGHT, LAND, SKY, WIDTH, lighter, path
from .strokes import arrow_strokes, body_strokes, line_strokes
from .view import SceneView

FAINT = 0.3  # opacity of an arrow where a body hides it
STEP = 0.5  # units, least distance between points of a path


def draw_ends(scene: SceneView) -> list[tuple[float, Markup]]:
    """Draw the first and the last sample with a position of the first body; return times (s) and pictures."""
    known = np.flatnonzero(np.all(np.isfinite(scene.bodies[0].position), axis=0))
    rows = sorted({int(known[0]), int(known[-1])}) if known.size else []
    pictures = ((float(scene.time[row]), draw_scene(scene, row)) for row in rows)
    return [(time, picture) for time, picture in pictures if picture is not None]


def draw_scene(scene: SceneView, row: int) -> Markup | None:
    """Draw the <svg> element of a view at a sample; None if the first body has no position."""
    ground = ground_of(scene)
    camera = first_camera(scene, ground, row)
    if camera is None:
        return None
    arrows = list(arrow_strokes(scene, camera, ground, row))
    shafts = (stroke for arrow in arrows for stroke in arrow.strokes)
    strokes = in_order([*body_strokes(scene, camera, row), *line_strokes(scene, camera, ground, row), *shafts])
    elements = [
        *_draw_land(camera, ground),
        *_draw_paths(scene, camera, ground),
        *(stroke.markup for stroke in strokes),
        *(Markup('<g opacity="{:g}">{}</g>').format(FAINT, arrow.outline) for arrow in arrows),
        *draw_names(scene, arrows, camera, ground, row),
        *draw_axes(scene, camera),
    ]
    label = f"{scene.title} at {float(scene.time[row]):g} s"
    markup = (
        '<svg class="still-scene" role="img" aria-label="{}" viewBox="0 0 {:g} {:g}" style="background:{}">{}</svg>'
    )
    return Markup(markup).format(label, WIDTH, HEIGHT, SKY, Markup("").join(elements))


def _draw_land(camera: Camera, ground: Ground | None) -> Iterator[Markup]:
    if ground is not None:
        edge = clip_polygon(camera.look(ground.horizon(camera.eye)), camera.tangent, WIDTH / HEIGHT)
        if len(edge):
            yield Markup('<path class="land" d="{}z" style="fill:{}"/>').format(path(camera.project(edge)), LAND)


def _draw_paths(scene: SceneView, camera: Camera, ground: Ground | None) -> Iterator[Markup]:
    for body in scene.bodies:
        points = np.stack(body.position, axis=1)
        if ground is not None:
            points = np.where(ground.hides(camera.eye, points)[:, None], np.nan, points)
        stretches = visible_stretches(camera.look(points), camera.tangent, WIDTH / HEIGHT)
        commands = "".join(path(_thin(camera.project(stretch))) for stretch in stretches)
        if commands:
            markup = Markup('<path class="path" d="{}" style="stroke:{}" fill="none" stroke-width=".7"/>')
            yield markup.format(commands, lighter(body.colour))


def _thin(points: np.ndarray) -> np.ndarray:
    """Return the points of a path, [n, 2], at least `STEP` apart; the last point is kept."""
    chosen = [0]
    for index in range(1, len(points)):
        if index == len(points) - 1 or math.dist(points[index], points[chosen[-1]]) > STEP / HEIGHT:
            chosen.append(index)
    return points[chosen]
