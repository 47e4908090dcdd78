"""perilune.analysis.documents.common.round_body, compared with spherical trigonometry.

Truth: orbits with known angles along and across a great circle, rotated about the body's centre.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.analysis.documents.common.round_body import altitude_over, downrange, radius_of, track_angles

MOON = 1.7374e6  # m


def placed(along, across, altitude, azimuth=0.0, radius=MOON):
    """Return positions (m) at these angles (rad) of a great circle through the origin that goes off along
    ``azimuth``."""
    direction = np.stack([np.sin(along) * np.cos(across), np.sin(across), np.cos(along) * np.cos(across)])
    turned = Rotation.from_euler("z", azimuth).apply(direction.T).T
    return (radius + altitude) * turned - np.array([0.0, 0.0, radius])[:, None]


@given(st.floats(-6.0, -0.2), st.floats(-math.pi, math.pi), st.floats(1e5, 1e7), st.floats(0.0, 1e5))
def test_a_flight_to_the_origin(start, azimuth, radius, altitude):
    """Along goes from where it began to 0, beyond half the circumference too; downrange is its length."""
    along = np.linspace(start, 0.0, 500)
    position = placed(along, np.zeros(500), altitude, azimuth, radius)
    actual, across = track_angles(position, radius)
    np.testing.assert_allclose(actual, along, atol=1e-7)
    np.testing.assert_allclose(across, 0.0, atol=1e-7)
    np.testing.assert_allclose(downrange(position, radius), radius * along, atol=1e-6 * radius)
    np.testing.assert_allclose(altitude_over(position, radius), altitude, atol=1e-8 * radius)


def test_rows_that_are_not_finite_are_left_out():
    position = placed(np.linspace(-1.0, 0.0, 50), np.zeros(50), 1e3)
    position[:, 20] = np.nan
    actual, _ = track_angles(position, MOON)
    assert np.isnan(actual[20])
    np.testing.assert_allclose(np.delete(actual, 20), np.delete(np.linspace(-1.0, 0.0, 50), 20), atol=1e-9)


@given(st.floats(0.01, 6.0), st.floats(1e5, 1e7))
def test_the_radius_shows_in_altitudes(way, radius):
    along = np.linspace(-way, 0.0, 200)
    altitude = 1e3 + 2e4 * np.abs(along)
    assert radius_of(placed(along, np.zeros(200), altitude, 0.3, radius), altitude) == pytest.approx(radius, rel=1e-6)


def test_no_radius_without_curvature_or_with_another_altitude():
    position = np.stack([np.linspace(-3e5, 0.0, 100), np.zeros(100), np.linspace(2e4, 0.0, 100)])
    assert radius_of(position, position[2]) is None  # a flat ground
    assert radius_of(position, position[2] + 500.0) is None  # another origin
    assert radius_of(position, position[2] + 1e-3 * np.abs(position[0])) is None  # a cone
    assert radius_of(position, np.full(100, np.nan)) is None
