"""`perilune.fmus_src.mathlib.spline`: splines of degree 5 and 6, and the rotation between directions.

Truth: the conditions at both ends, by numpy's polynomials and their derivatives, which determine the spline (six
conditions for degree 5, seven for degree 6, solved as a linear system); the turn of the paper, s^3 (20 - 45 s + 36 s^2
- 10 s^3); rotations by scipy.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial
from scipy.spatial.transform import Rotation

from perilune.fmus_src.mathlib.attitude.rotation import rotation_between
from perilune.fmus_src.mathlib.spline import spline, spline_acceleration, spline_rate, spline_value
from perilune.fmus_src.mathlib.vectors import vector

ordinary = st.floats(-1e3, 1e3)
durations = st.floats(0.1, 1e4)
directions = st.lists(st.floats(-10.0, 10.0), min_size=3, max_size=3).filter(lambda v: np.linalg.norm(v) > 1e-3)


def coefficients(*arguments):
    c = [0.0] * 7
    spline(*arguments, c)
    return c


def by_conditions(value, slope, end_value, end_slope, duration, degree):
    """Return coefficients in s from the linear equations of the ends."""
    rows, desired = [], []

    def condition(s, order, what):
        powers = [Polynomial.basis(k).deriv(order)(s) if order else Polynomial.basis(k)(s) for k in range(degree + 1)]
        rows.append(powers)
        desired.append(what)

    for s, place, speed in ((0.0, value, slope), (1.0, end_value, end_slope)):
        condition(s, 0, place)
        condition(s, 1, speed * duration)
        condition(s, 2, 0.0)
    if degree == 6:
        condition(1.0, 3, 0.0)
    return np.linalg.solve(np.array(rows), np.array(desired))


@given(ordinary, ordinary, ordinary, ordinary, durations, st.sampled_from([5, 6]))
def test_conditions_at_both_ends(value, slope, end_value, end_slope, duration, degree):
    actual = coefficients(value, slope, end_value, end_slope, duration, degree)
    expected = by_conditions(value, slope, end_value, end_slope, duration, degree)
    scale = 1.0 + max(abs(value), abs(end_value), abs(slope * duration), abs(end_slope * duration))
    assert actual[: degree + 1] == pytest.approx(expected, abs=1e-9 * scale)
    assert actual[degree + 1 :] == [0.0] * (6 - degree)


@given(ordinary, ordinary, ordinary, ordinary, durations, st.sampled_from([5, 6]), st.floats(0.0, 1.0))
def test_value_rate_and_acceleration_are_those_of_the_polynomial(
    value, slope, end_value, end_slope, duration, degree, s
):
    c = coefficients(value, slope, end_value, end_slope, duration, degree)
    polynomial = Polynomial(c)
    scale = 1.0 + max(abs(x) for x in c)
    assert spline_value(c, s) == pytest.approx(polynomial(s), abs=1e-13 * scale)
    assert spline_rate(c, s, duration) * duration == pytest.approx(polynomial.deriv()(s), abs=1e-12 * scale)
    actual = spline_acceleration(c, s, duration) * duration * duration
    assert actual == pytest.approx(polynomial.deriv(2)(s), abs=1e-11 * scale)


def test_turn_of_the_paper():
    assert coefficients(0.0, 0.0, 2.0, 0.0, 100.0, 6) == [0.0, 0.0, 0.0, 40.0, -90.0, 72.0, -20.0]


@given(directions, directions)
def test_rotation_turns_one_direction_into_the_other(start, goal):
    axis, angle = rotation_between(vector(*start), vector(*goal))
    assert np.linalg.norm(axis) == pytest.approx(1.0, abs=1e-14)
    assert 0.0 <= angle <= math.pi
    turned = Rotation.from_rotvec(angle * np.array(axis)).apply(np.array(start) / np.linalg.norm(start))
    assert turned == pytest.approx(np.array(goal) / np.linalg.norm(goal), abs=1e-11)
    assert np.dot(axis, start) == pytest.approx(0.0, abs=1e-9)  # the shortest way


@pytest.mark.parametrize("goal", [[2.0, 0.0, 0.0], [-3.0, 0.0, 0.0]])
def test_parallel_directions(goal):
    axis, angle = rotation_between(vector(1.0, 0.0, 0.0), vector(*goal))
    assert angle == (0.0 if goal[0] > 0.0 else math.pi)
    assert axis[0] == 0.0
    assert np.linalg.norm(axis) == pytest.approx(1.0, abs=1e-15)
