"""Stored data and texts of the scenes of shipped systems on a page.

Truth: scipy's Rotation on the signals of the run, a field in two frames, the sphere of the ground, the firing time of
jets reported by the plant, the jets' matrix of the robot, and texts with a special meaning in HTML or JSON.
"""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

import perilune
from perilune.analysis.documents.figures.scene.scene_elements import Cartesian, SceneFigure
from perilune.analysis.documents.scene.notes import scene_notes
from perilune.analysis.documents.scene.view import remaining_pulses, scene_view
from perilune.fmus_src.mathlib.actuators.jets import jet_strength, jet_wrench
from perilune.fmus_src.mathlib.vectors import vector as kernel_vector
from tests.support.documents.run_page import write_run_report
from tests.support.pages.checks import assert_self_contained, parse, text_of
from tests.support.scenes.descent import descent
from tests.support.scenes.embedded import column, document_of, embed, require_bundle

EXACT = 1e-6
LANDING, ROBOT, SPACECRAFT, CAPSULE = "landing_mission", "robot_rendezvous", "orbital_attitude", "entry_attitude"


def instants(rows):
    return np.linspace(0, rows - 1, 10).astype(int)


@pytest.fixture(scope="module")
def flights(fmus):
    """Return a function from a system to flight, scene as declared, and document of the page; each simulated once."""
    created = {}

    def flight_of(name):
        if name not in created:
            result = perilune.simulate(name)
            (declared,) = (figure for figure in result.figures if isinstance(figure, SceneFigure))
            created[name] = (result, declared, embed("scene", "scene", scene_view(declared, result)))
        return created[name]

    return flight_of


def stored(document, index=0):
    """Return positions (m), [3, n], and rotations of a body, as the page has them."""
    stored_scene = document["scene"]
    stored_body = stored_scene["bodies"][index]
    position = np.stack([column(document, number) for number in stored_body["position"]])
    attitude = np.stack([column(document, number) for number in stored_body["attitude"]])
    rotation = Rotation.from_quat(attitude.T, scalar_first=True)
    return position + np.array(stored_scene["origin"])[:, None], rotation


def assert_near(actual, expected):
    """Assert equality to 1e-6 of the largest, which float32 has."""
    assert np.abs(actual - expected).max() <= EXACT * max(1.0, np.abs(expected).max())


def test_the_robots_quaternion(flights):
    result, _, document = flights(ROBOT)
    for index, name in enumerate(("robot", "target")):
        position, rotation = stored(document, index)
        rows = instants(result.time.size)
        assert_near(position.T[rows], result[f"{name}.position"][rows])
        expected = Rotation.from_quat(result[f"{name}.quaternion"][rows], scalar_first=True)
        assert_near(rotation[rows].as_matrix(), expected.as_matrix())


def test_the_spacecrafts_angles(flights):
    result, _, document = flights(SPACECRAFT)
    position, rotation = stored(document)
    rows = instants(result.time.size)
    roll, yaw, pitch = result["plant.angles"][rows].T
    assert_near(
        rotation[rows].as_matrix(), Rotation.from_euler("YZX", np.stack([yaw, pitch, roll], axis=1)).as_matrix()
    )
    assert not position.any()


def test_the_landers_thrust_axis(flights):
    result, _, document = flights(LANDING)
    position, rotation = stored(document)
    rows = instants(result.time.size)
    assert_near(position.T[rows], result["plant.position"][rows])
    axes = result["plant.attitude"]
    assert_near(rotation[rows].apply([0.0, 0.0, 1.0]), axes[rows] / np.linalg.norm(axes[rows], axis=1)[:, None])


def test_the_capsules_wind_angles(flights):
    result, _, document = flights(CAPSULE)
    position, rotation = stored(document)
    longitude, latitude = result["plant.longitude"], result["plant.latitude"]
    up = Rotation.from_euler("ZY", np.stack([longitude, -latitude], axis=1))  # x of the earth-fixed frame goes there
    there = up[-1] * Rotation.from_matrix([[0, 0, 1], [1, 0, 0], [0, 1, 0]])  # east, north, up are y, z, x of `up`
    distance = 6371000.0 + result["plant.height"]
    rows = instants(result.time.size)
    fixed = up.apply([1.0, 0.0, 0.0]) * distance[:, None] - up[-1].apply([6371000.0, 0.0, 0.0])
    assert_near(position.T[rows], there.inv().apply(fixed)[rows])
    horizon = up * Rotation.from_matrix([[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    heading, path = result["plant.course"], result["plant.path_angle"]
    level = Rotation.from_matrix([[1, 0, 0], [0, 0, -1], [0, 1, 0]])  # forward, up, right of forward, left, up
    velocity_axes = horizon * Rotation.from_euler("ZY", np.stack([heading, -path], axis=1)) * level
    angles = np.stack([result[f"plant.{name}"] for name in ("bank", "sideslip", "attack")], axis=1)
    expected = there.inv() * velocity_axes * Rotation.from_euler("XYZ", angles)
    assert_near(rotation[rows].as_matrix(), expected[rows].as_matrix())


def test_arrows_of_an_earth_satellite(fmus):
    """The field that the environment states in body axes lies along the one that it states in inertial axes."""
    flight = perilune.simulate("earth_pointing", stop_time=100.0)
    (declared,) = (figure for figure in flight.figures if isinstance(figure, SceneFigure))
    sun, field = scene_view(declared, flight).arrows
    rows = instants(flight.time.size)
    for arrow, name in ((sun, "sun_direction"), (field, "magnetic_field")):
        inertial = flight[f"environment.{name}"][rows]
        unit = inertial / np.linalg.norm(inertial, axis=1)[:, None]
        assert np.stack(arrow.direction, axis=1)[rows] == pytest.approx(unit, abs=1e-9)
    assert declared.surface.centre == (0.0, 0.0, 0.0)
    angle = np.degrees(np.linalg.norm(flight["satellite.angular_velocity"][0])) * 100.0
    assert angle > 300.0  # attitudes matter


def test_a_landed_vehicle_stands_on_the_ground(flights):
    _, declared, document = flights(LANDING)
    position, rotation = stored(document)
    (lander,) = declared.bodies
    half_width = 0.5 * lander.size[0]
    base = [[half_width * x, half_width * y, 0.0] for x, y in ((1, 0), (0, 1), (-1, 0), (0, -1))]
    points = position[:, -1] + rotation[-1].apply(base)
    radius = document["scene"]["ground"]["radius"]
    heights = np.linalg.norm(points + np.array([0.0, 0.0, radius]), axis=1) - radius
    assert np.abs(heights).max() < 0.01


def test_jets_are_visible_for_as_long_as_the_plant_fires_them(flights):
    result, _, document = flights(SPACECRAFT)
    jets = [column(document, jet["values"]) for jet in document["scene"]["bodies"][0]["jets"]]
    on = np.minimum(np.abs(jets)[:, :-1], np.diff(result.time)).sum()
    assert on == pytest.approx(result["plant.jet_seconds"][-1], rel=1e-5)


def test_jets_push_as_the_robots_matrix_says(flights):
    _, declared, _ = flights(ROBOT)
    (jets,) = declared.bodies[0].jets
    strength = jet_strength(np.radians(35.25), np.pi / 4.0, kernel_vector(1.0, 0.7, 0.6))
    for index, (at, along) in enumerate(zip(jets.at, jets.along, strict=True)):
        wrench = jet_wrench(strength, [float(index == other) for other in range(8)])
        assert np.allclose(along, list(wrench.force), atol=1e-5)
        assert np.allclose(np.cross(at, along), list(wrench.torque), atol=1e-5)


@pytest.mark.parametrize("name", [SPACECRAFT, CAPSULE])
def test_couples_turn_about_their_axis(flights, name):
    _, declared, _ = flights(name)
    (jets,) = declared.bodies[0].jets
    torques = np.cross(jets.at, jets.along)
    assert jets.couple
    assert np.allclose(torques / np.linalg.norm(torques, axis=1)[:, None], np.eye(3))


def test_pulses_last_from_the_sample_at_which_they_are_counted():
    time = np.array([0.0, 0.5, 1.0, 1.5, 2.0])
    lengths = np.array([[0.7, 0.7, -1.2, -1.2, -1.2]])
    count = np.array([1.0, 1.0, 2.0, 2.0, 2.0])
    assert np.allclose(remaining_pulses(time, lengths, count), [[0.7, 0.2, -1.2, -0.7, -0.2]])
    assert (remaining_pulses(time, lengths, None) == lengths).all()


def page_of(path, result, *figures):
    write_run_report(result, path, "A flight", figures)
    return path.read_text(encoding="utf-8")


def test_a_page_with_a_scene_stands_alone_and_is_the_same_each_time(tmp_path):
    require_bundle("scene")
    page = page_of(tmp_path / "a.html", *descent())
    assert_self_contained(page)
    assert page == page_of(tmp_path / "b.html", *descent())
    (holder,) = parse(page).xpath("//*[@data-scene]")
    assert "needs JavaScript" in holder.text_content()
    assert len(holder.xpath(".//*[contains(@class, 'still-scene')]")) == 2
    assert holder.xpath("ancestor::section[@class='screen']")  # not in print
    assert "data-scene" not in page_of(tmp_path / "c.html", descent()[0])


def test_without_its_script_a_page_says_so(tmp_path, monkeypatch):
    monkeypatch.setattr("perilune.analysis.documents.interactive.script_bundles.BUNDLES", tmp_path)
    page = page_of(tmp_path / "a.html", *descent())
    assert "There is no three-dimensional view. The scripts of pages are not built" in text_of(page)
    assert not parse(page).xpath("//script")
    assert len(parse(page).xpath("//*[contains(@class, 'still-scene')]")) == 2


def test_a_run_without_samples_has_no_scene(tmp_path):
    assert "data-scene" not in page_of(tmp_path / "a.html", *descent(rows=0))


def test_what_is_not_to_scale_is_said():
    result, declared = descent()
    text = " ".join(scene_notes(declared, result))
    assert "Frame: ship; x, y, z." in text
    assert "ship 2 x 3 x 4 m" in text
    assert "Dashed line: ship's beam." in text
    assert "Arrow: ship's wind, the direction of ship.wind, of constant length on the screen." in text
    assert "roll about ship.axis is unknown and not shown" in text
    assert "proportional to ship.thrust, 8 m at 400." in text
    assert "Jets: shown while a pulse of ship.lengths lasts, not to scale." in text


HOSTILE = ("</script><b>", "<!--<script>", "a\u2028b\nc", "\u202eabc", "__proto__", "constructor", "'\"&amp;`${x}")


@pytest.mark.parametrize("name", HOSTILE)
def test_names_are_text_in_the_page(tmp_path, name):
    require_bundle("scene")
    page = page_of(tmp_path / "a.html", *descent(name))
    assert_self_contained(page)
    assert not parse(page).xpath("//b[ancestor::section[@class='screen']]")
    document = document_of(
        page[page.index('<script type="application/json"') :].partition("</script>")[0] + "</script>"
    )
    stored_scene = document["scene"]
    assert (stored_scene["title"], stored_scene["bodies"][0]["name"]) == (f"Landing of {name}", name)
    assert stored_scene["lines"][0]["start"] == name


@given(st.text(min_size=1))
def test_any_name_comes_back_as_it_was(name):
    result, declared = descent(name)
    document = embed("scene", "scene", scene_view(declared, result))
    assert document["scene"]["bodies"][0]["name"] == name
    assert json.loads(json.dumps(document)) == document


def test_a_position_that_is_never_known_leaves_the_page_whole(tmp_path):
    result, declared = descent()
    result.signals["ship.position[1]"][:] = np.nan
    assert isinstance(declared.bodies[0].position, Cartesian)
    page = page_of(tmp_path / "a.html", result, declared)
    assert_self_contained(page)
