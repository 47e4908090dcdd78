"""Complete landing from dispersed orbital elements, as in the outlook of Fomichev and Li (2017).

Truth: elements computed back from position and velocity at the start by the two-body formulas (vectors of angular
momentum, node and eccentricity; Bate, Mueller and White 1971, section 2.4), in axes of the equator and the pole.
"""

import numpy as np
import pytest

import perilune
from tests.support.lengths import either

SYSTEM, CAMPAIGN = "landing_mission", "orbits"
RADIUS, MU = 1.7374e6, 4.9028e12
LATITUDE = np.radians(-80.0)
# Rows: outwards at the site's meridian on the equator, east, the pole; in the landing-site frame x north, y west, z up.
AXES = np.array(
    [
        [-np.sin(LATITUDE), 0.0, np.cos(LATITUDE)],
        [0.0, -1.0, 0.0],
        [np.cos(LATITUDE), 0.0, np.sin(LATITUDE)],
    ]
)
pytestmark = pytest.mark.usefixtures("fmus")


def elements(position, velocity):
    """Return inclination, node (rad), argument of pericentre (rad), altitudes of pericentre and apocentre (m)."""
    r = AXES @ np.add(position, [0.0, 0.0, RADIUS])
    v = AXES @ np.asarray(velocity)
    momentum = np.cross(r, v)
    node = np.cross([0.0, 0.0, 1.0], momentum)
    eccentricity = np.cross(v, momentum) / MU - r / np.linalg.norm(r)
    semi_major = 1.0 / (2.0 / np.linalg.norm(r) - v @ v / MU)
    e = np.linalg.norm(eccentricity)
    along = np.cross(momentum, node)
    argument = np.arctan2(eccentricity @ along / np.linalg.norm(along), eccentricity @ node / np.linalg.norm(node))
    return {
        "inclination": np.arccos(momentum[2] / np.linalg.norm(momentum)),
        "node": np.arctan2(node[1], node[0]),
        "pericentre_argument": argument,
        "pericentre": semi_major * (1.0 - e) - RADIUS,
        "apocentre": semi_major * (1.0 + e) - RADIUS,
    }


def test_flights_start_on_the_dispersed_orbits():
    trials = either(6, 2)
    rows = perilune.batch(SYSTEM, CAMPAIGN, trials=trials, stop_time=0.1, workers=1).table().to_pylist()
    for trial, row in enumerate(rows):
        start = perilune.replay(SYSTEM, trial, campaign=CAMPAIGN, stop_time=0.1)
        actual = elements(start["plant.position"][0], start["plant.velocity"][0])
        apses = sorted([row["draw.first_apsis"], row["draw.second_apsis"]])
        assert (actual["pericentre"], actual["apocentre"]) == pytest.approx(apses, abs=1e-3)
        assert actual["inclination"] == pytest.approx(row["draw.inclination"], abs=1e-9)
        for name in ("node", "pericentre_argument"):
            turn = actual[name] - row[f"draw.{name}"]
            assert np.angle(np.exp(1j * turn)) == pytest.approx(0.0, abs=1e-6)


def test_landings_from_dispersed_orbits_are_within_limits():
    rows = perilune.batch(SYSTEM, CAMPAIGN, trials=either(60, 2), workers=1).table().to_pylist()
    assert all(row["success"] for row in rows)
