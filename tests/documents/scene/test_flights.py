"""Several trajectories in one scene.

Truth: positions and attitudes of each trajectory at its samples, from its signals by scipy; straight lines between
samples.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from perilune.analysis.documents.figures.scene.scene_elements import Site
from perilune.analysis.documents.scene.flights import RecordedFlight, flights_view
from perilune.analysis.documents.scene.view import FlightName
from tests.support.scenes.descent import descent
from tests.support.scenes.made import vector


def recorded(trial, rows, *, failed=False, without=()):
    """Return a descent of ``rows`` samples, half a second each, each trial 10 m further aside."""
    flight, _ = descent(rows=rows)
    flight.signals["ship.position[2]"] = flight.signals["ship.position[2]"] + 10.0 * trial
    for name in without:
        del flight.signals[name]
    return RecordedFlight(FlightName("default", trial, failed), f"trial {trial}", "#0072B2", flight)


def view_of(flights, **more):
    return flights_view(descent(**more)[1], flights)


def test_flights_are_where_they_were_at_their_own_samples():
    flights = [recorded(3, 20), recorded(7, 33, failed=True)]
    scene = view_of(flights).scene
    assert [body.name for body in scene.bodies] == ["trial 3", "trial 7"]
    assert [body.flight for body in scene.bodies] == [each.name for each in flights]
    assert np.array_equal(scene.time, flights[1].flight.time)  # the longer one's
    for body, each in zip(scene.bodies, flights, strict=True):
        rows = np.searchsorted(scene.time, each.flight.time)
        position = np.stack(body.position)[:, rows] + np.array(scene.origin)[:, None]
        expected = np.stack([each.flight.signals[f"ship.position[{k}]"] for k in (1, 2, 3)])
        np.testing.assert_allclose(position, expected, atol=1e-9)
        axis = np.stack([each.flight.signals[f"ship.axis[{k}]"] for k in (1, 2, 3)])
        rotated = Rotation.from_quat(np.stack(body.attitude)[:, rows].T, scalar_first=True).apply([0.0, 0.0, 1.0])
        np.testing.assert_allclose(rotated, (axis / np.linalg.norm(axis, axis=0)).T, atol=1e-12)


def test_a_flight_stays_where_it_ended():
    short, long = recorded(0, 20), recorded(1, 33)
    scene = view_of([short, long]).scene
    after = scene.time >= short.flight.time[-1]
    assert after.sum() == 14
    for column in (*scene.bodies[0].position, *scene.bodies[0].attitude):
        assert np.ptp(column[after]) == 0.0


def test_between_samples_positions_are_on_straight_lines():
    even, odd = recorded(0, 21), recorded(1, 21)
    odd.flight.time = odd.flight.time + 0.2
    scene = view_of([even, odd]).scene
    assert scene.time.size == 42
    x = scene.bodies[0].position[0] + scene.origin[0]
    np.testing.assert_allclose(x, np.interp(scene.time, even.flight.time, even.flight.signals["ship.position[1]"]))


def test_what_is_not_recorded_is_left_out_and_named():
    axis = [f"ship.axis[{k}]" for k in (1, 2, 3)]
    flights = [recorded(0, 20, without=axis), recorded(1, 20, without=axis)]
    view = view_of(flights, sites=(Site("goal", vector("pilot.goal", 3)), Site("flag", (1.0, 2.0, 3.0))))
    assert all(len(body.attitude) == 0 for body in view.scene.bodies)
    assert [site.name for site in view.scene.sites] == ["flag"]
    assert "The attitude of ship is not recorded." in view.notes
    assert "The position of goal differs between trials or is not recorded." in view.notes
    assert not any(note.startswith("To scale") for note in view.notes)


def test_a_body_at_the_origin_is_there_and_not_missing():
    _, scene = descent(rows=20)
    target = replace(scene.bodies[0], name="target", position=None)
    view = flights_view(replace(scene, bodies=(*scene.bodies, target)), [recorded(0, 20)])
    assert not [note for note in view.notes if "target" in note]
    (site,) = [site for site in view.scene.sites if site.name == "target"]
    np.testing.assert_array_equal(np.stack(site.position)[:, 0], -np.array(view.scene.origin))


def test_without_positions_there_is_no_scene():
    assert view_of([recorded(0, 20, without=["ship.position[2]"])]) is None
    assert view_of([]) is None


@pytest.mark.parametrize(("shift", "there"), [(0.0, True), (5.0, False)])
def test_a_recorded_site_is_shown_where_all_flights_have_it(shift, there):
    flights = [recorded(0, 20), recorded(1, 20)]
    for each, more in zip(flights, (0.0, shift), strict=True):
        each.flight.signals |= {f"pilot.goal[{k}]": np.full(20, k + more) for k in (1, 2, 3)}
    sites = view_of(flights, sites=(Site("goal", vector("pilot.goal", 3)),)).scene.sites
    assert [site.name for site in sites] == (["goal"] if there else [])
