"""`perilune.fmus_src.mathlib.lunar.gravity`: sphere and gravity of the Moon relative to the landing site.

Truth: exact cases above, below and to the side of the site, and gravity as the gradient of mu/distance by central
differences by numpy (tolerance 1e-8 relative, the error of the differences); its magnitude mu/distance^2 to 1e-14.
"""

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from perilune.fmus_src.mathlib.lunar.gravity import altitude_of, central_gravity, vertical_at
from perilune.fmus_src.mathlib.vectors import vector

RADIUS = 1.7374e6
MU = 4.9028e12
positions = st.lists(st.floats(-2e6, 2e6), min_size=3, max_size=3)


def gravity_at(position, radius=RADIUS):
    return np.array(central_gravity(vector(*position), radius, MU))


def test_altitude_is_exact_above_the_site_and_on_the_sphere():
    for height in (0.0, 500.0, 1500.0, 5e3, 2e4):
        assert altitude_of(vector(0.0, 0.0, height), RADIUS) == height
    assert altitude_of(vector(RADIUS + 1e4, 0.0, -RADIUS), RADIUS) == 1e4
    assert altitude_of(vector(0.0, -RADIUS, -RADIUS), RADIUS) == 0.0
    assert altitude_of(vector(0.0, 0.0, -2.0 * RADIUS - 3.0), RADIUS) == 3.0  # the far side
    assert altitude_of(vector(0.0, 0.0, -RADIUS), RADIUS) == -RADIUS


def test_gravity_at_the_site_points_down():
    actual = gravity_at([0.0, 0.0, 0.0])
    assert actual.tolist()[:2] == [0.0, 0.0]
    assert actual[2] == pytest.approx(-MU / RADIUS**2, rel=1e-15)
    assert actual[2] == pytest.approx(-1.6242, abs=1e-4)


@given(positions)
def test_gravity_is_the_gradient_of_the_potential(position):
    assume(altitude_of(vector(*position), RADIUS) > -0.5 * RADIUS)
    centred = np.add(position, [0.0, 0.0, RADIUS])
    distance = np.linalg.norm(centred)
    actual = gravity_at(position)
    assert np.linalg.norm(actual) == pytest.approx(MU / distance**2, rel=1e-14)
    step = 1e-4 * distance
    slope = [
        (MU / np.linalg.norm(centred + step * axis) - MU / np.linalg.norm(centred - step * axis)) / (2.0 * step)
        for axis in np.eye(3)
    ]
    assert actual == pytest.approx(np.array(slope), abs=4e-8 * np.linalg.norm(actual))


@given(positions)
def test_the_vertical_is_against_gravity(position):
    assume(np.linalg.norm(np.add(position, [0.0, 0.0, RADIUS])) > 1.0)
    down = gravity_at(position)
    assert np.array(vertical_at(vector(*position), RADIUS)) == pytest.approx(-down / np.linalg.norm(down), abs=1e-14)


def test_at_the_centre_the_vertical_is_z():
    assert vertical_at(vector(0.0, 0.0, -RADIUS), RADIUS) == vector(0.0, 0.0, 1.0)
