"""Pictures of a scene for pages without scripts.

Truth: a pinhole camera of a few lines, scipy's Rotation, the dip of the horizon of a sphere, and rays: of all facets on
a ray the nearest is drawn last.
"""

import numpy as np
import pytest
from markupsafe import Markup
from scipy.spatial.transform import Rotation

from perilune.analysis.documents.figures.scene.scene_elements import (
    SHAPES,
    Arrow,
    Cartesian,
    Panel,
    Quaternion,
    Surface,
)
from perilune.analysis.documents.scene.camera import first_camera
from perilune.analysis.documents.scene.painting import Stroke, in_order
from perilune.analysis.documents.scene.picture import draw_ends, draw_scene
from perilune.analysis.documents.scene.solids import facets_of
from perilune.analysis.documents.scene.view import BodyView, position_at, scene_view
from tests.support.pages.checks import parse
from tests.support.scenes.made import METRE, SIZE, body, cartesian, flown, scene, vector
from tests.support.scenes.stills import arrow_tips, points_of

RANDOM = np.random.default_rng(5)
POINT = np.array([4e5, -3e5, 7e5])
TANGENT = np.tan(np.radians(20.0))
ROUNDED = 2.5e-4  # tenths of 260


def fly(direction):
    """Return a body with a random attitude at a point, and an arrow's direction at both its samples."""
    rotation = Rotation.random(rng=RANDOM)
    quaternion = np.tile(rotation.as_quat(scalar_first=True)[:, None], 2)
    signals = {"position": np.tile(POINT[:, None], 2), "attitude": quaternion, "way": np.tile(direction[:, None], 2)}
    return rotation, flown(**signals)


def project_point(point):
    """Return the picture point by a pinhole camera 3.6 diagonals from the body, 2.5 rad about z
    from x and 0.25 rad above."""
    away = np.array([np.cos(0.25) * np.cos(2.5), np.cos(0.25) * np.sin(2.5), np.sin(0.25)])
    right = np.cross(-away, [0.0, 0.0, 1.0]) / np.cos(0.25)
    line = point - (POINT + 3.6 * np.linalg.norm(SIZE) * away)
    depth = -away @ line
    return np.array([right @ line, -np.cross(right, -away) @ line]) / depth / (2.0 * TANGENT)


def picture(flight, *arrows, **more):
    declared = body(position=cartesian(), attitude=Quaternion(vector("ship.attitude", 4)))
    return draw_scene(scene_view(scene(declared, arrows=arrows, **more), flight), 0)


@pytest.mark.parametrize("frame", [None, "ship"])
@pytest.mark.parametrize("length", [None, 5.0])
def test_an_arrow_ends_where_a_pinhole_camera_sees_it(frame, length):
    for _ in range(10):
        direction = RANDOM.normal(size=3) * 1e-5
        rotation, flight = fly(direction)
        svg = picture(flight, Arrow("field", "ship", vector("ship.way", 3), frame, length, None))
        unit = direction / np.linalg.norm(direction)
        along = rotation.apply(unit) if frame else unit
        metres = length or 0.3 * 2.0 * TANGENT * 3.6 * np.linalg.norm(SIZE)
        (tip, faint) = arrow_tips(svg)
        assert tip == pytest.approx(project_point(POINT + metres * along), abs=ROUNDED)
        assert (tip == faint).all()


@pytest.mark.parametrize("direction", [np.zeros(3), np.array([1.0, np.nan, 0.0])])
def test_an_arrow_without_a_direction_is_left_out(direction):
    _, flight = fly(direction)
    svg = picture(flight, Arrow("field", "ship", vector("ship.way", 3), None, None, None))
    assert not arrow_tips(svg)
    assert "field" not in svg


def test_an_arrow_has_its_colour_and_its_name_as_text():
    _, flight = fly(np.array([0.0, 0.0, 1.0]))
    svg = picture(flight, Arrow("<b>field", "ship", vector("ship.way", 3), None, 4.0, "purple"))
    assert "light-dark(#CC79A7, " in svg
    root = parse(f"<!DOCTYPE html><html><body>{svg}</body></html>")
    (name,) = root.xpath("//*[@class='arrow-name']")
    assert name.text_content() == "<b>field"


def test_the_horizon_of_a_sphere_dips():
    """By acos(R/(R + h)) below the level of the eye, from which the camera looks down by its elevation."""
    radius, height = 6378136.3, 500e3
    up = POINT / np.linalg.norm(POINT)
    _, flight = fly(np.ones(3))
    for k in range(3):
        flight.signals[f"ship.position[{k + 1}]"][:] = up[k] * (radius + height)
    svg = picture(flight, surface=Surface("Earth", radius, (0.0, 0.0, 0.0)))
    (land,) = parse(f"<!DOCTYPE html><html><body>{svg}</body></html>").xpath("//*[contains(@style, '#d8d4cc')]/@d")
    highest = points_of(land)[:, 1].min()
    dip = np.arccos(radius / (radius + height))
    assert highest == pytest.approx(np.tan(dip - 0.25) / (2.0 * TANGENT), abs=5e-4)


@pytest.mark.parametrize("shape", SHAPES)
def test_the_nearest_facet_on_a_ray_hides_the_others(shape):
    panels = [Panel((0.0, 0.0, -6.0), (1.0, 2.0, 0.2))]
    declared = BodyView("it", "#000000", shape, (2.0, 3.0, 4.0), (0.1, 0.0, 0.0), [], [], [], [], panels)
    facets = facets_of(declared)
    wrong = total = 0
    random = np.random.default_rng(3)
    for _ in range(4):
        turn = Rotation.random(rng=random).as_matrix()
        placed = [(facet.corners @ turn.T + [0.0, 0.0, 20.0], turn @ facet.normal) for facet in facets]
        strokes = [Stroke(points, Markup(""), normal) for points, normal in placed if normal @ points[0] < 0.0]
        ordered = in_order(strokes)
        assert len(ordered) == len(strokes)
        for x, y in random.uniform(-0.08, 0.08, size=(100, 2)):
            depths = [depth_on_ray(stroke, np.array([x, y, 1.0])) for stroke in ordered]
            hit = [depth for depth in depths if depth is not None]
            total += bool(hit)
            wrong += bool(hit) and hit[-1] > min(hit) + 0.05
    assert total > 50, (wrong, total)
    assert wrong <= 0.01 * total, (wrong, total)


def depth_on_ray(stroke, ray):
    """Return the length of a ray to a convex facet; None if it misses."""
    depth = (stroke.points[0] @ stroke.normal) / (ray @ stroke.normal)
    edges = np.roll(stroke.points, -1, axis=0) - stroke.points
    sides = np.cross(edges, depth * ray - stroke.points) @ stroke.normal
    return depth if (sides > 0.0).all() or (sides < 0.0).all() else None


def test_the_camera_is_as_far_as_shows_every_body():
    """Truth: a point in any direction from the middle of the view is inside of a cone that touches its edges."""
    for _ in range(20):
        away = RANDOM.normal(size=3)
        away *= RANDOM.uniform(20.0, 400.0) / np.linalg.norm(away)
        signals = {"position": np.tile(POINT[:, None], 2), "other": np.tile((POINT + away)[:, None], 2)}
        declared = [body(position=cartesian()), body("far", Cartesian(vector("ship.other", 3, METRE)))]
        view = scene_view(scene(*declared), flown(**signals))
        camera = first_camera(view, None, 0)
        points = np.array([position_at(each, 0) for each in view.bodies])
        distance = np.linalg.norm(camera.eye - points[0])
        assert distance >= (np.linalg.norm(away) + np.linalg.norm(SIZE) / 2.0) / np.sin(np.radians(20.0))
        assert np.all(np.abs(camera.project(camera.look(points))) < 0.5)


def test_a_picture_at_the_first_and_at_the_last_known_sample():
    flight = flown(position=np.tile(POINT[:, None], 5), attitude=np.tile([[1.0], [0.0], [0.0], [0.0]], 5))
    flight.signals["ship.position[2]"][[0, 4]] = np.nan
    declared = body(position=cartesian(), attitude=Quaternion(vector("ship.attitude", 4)))
    assert [time for time, _ in draw_ends(scene_view(scene(declared), flight))] == [0.5, 1.5]
    flight.signals["ship.position[2]"][:] = np.nan
    assert draw_ends(scene_view(scene(declared), flight)) == []
