"""Attitude on an orbit: rates, accelerations, derivatives and the linear model.

Truth: direction cosines by numpy and scipy (tests/support/flights/orbital_motion.py), differences of the functions
(within truncation errors), and the equations of a body with principal axes, written out.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.mathlib.orbits.attitude import (
    angle_rate_derivatives,
    angle_rates,
    angular_acceleration,
    evaluate_angles,
    linear_model,
    radial_direction,
)
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.flights.orbital_motion import INERTIA, ORBITAL_RATE, acceleration, body_from_orbital

angle = st.floats(-1.2, 1.2)
rate = st.floats(-0.1, 0.1)
triples = st.tuples(angle, angle, angle), st.tuples(rate, rate, rate)


def model(inertia):
    return np.array(linear_model(Matrix(inertia.tolist()), Matrix(np.linalg.inv(inertia).tolist()), ORBITAL_RATE))


@settings(max_examples=50)
@given(*triples)
def test_up_and_acceleration(angles, w):
    up = radial_direction(evaluate_angles(vector(*angles)))
    assert [*up] == pytest.approx(body_from_orbital(angles)[:, 1], abs=1e-15)
    inverse = Matrix(np.linalg.inv(INERTIA).tolist())
    torque = (3.0, -2.0, 1.0)
    actual = angular_acceleration(
        evaluate_angles(vector(*angles)), vector(*w), vector(*torque), Matrix(INERTIA.tolist()), inverse, ORBITAL_RATE
    )
    assert [*actual] == pytest.approx(acceleration(body_from_orbital(angles), np.array(w), torque), abs=1e-15)


@settings(max_examples=50)
@given(*triples)
def test_derivatives_of_the_rates_are_those_of_differences(angles, w):
    by_angles, by_rates = angle_rate_derivatives(evaluate_angles(vector(*angles)), vector(*w), ORBITAL_RATE)
    h = 1e-5
    for k in range(3):
        step = np.eye(3)[k] * h
        moved = [
            angle_rates(evaluate_angles(vector(*(angles + s * step))), vector(*w), ORBITAL_RATE) for s in (1.0, -1.0)
        ]
        driven = [
            angle_rates(evaluate_angles(vector(*angles)), vector(*(w + s * step)), ORBITAL_RATE) for s in (1.0, -1.0)
        ]
        assert [*by_angles[:, k]] == pytest.approx((np.array([*moved[0]]) - [*moved[1]]) / (2.0 * h), abs=1e-8)
        assert [*by_rates[:, k]] == pytest.approx((np.array([*driven[0]]) - [*driven[1]]) / (2.0 * h), abs=1e-9)


def test_the_linear_model_is_the_derivative_of_the_motion():
    desired = np.array([0.0, 0.0, 0.0, 0.0, 0.0, -ORBITAL_RATE])
    inverse = Matrix(np.linalg.inv(INERTIA).tolist())

    def motion(x):
        functions, w = evaluate_angles(vector(*x[:3])), vector(*x[3:])
        turning = angle_rates(functions, w, ORBITAL_RATE)
        return np.array(
            [*turning, *angular_acceleration(functions, w, 0.0 * w, Matrix(INERTIA.tolist()), inverse, ORBITAL_RATE)]
        )

    h = 1e-4
    columns = [(motion(desired + h * e) - motion(desired - h * e)) / (2.0 * h) for e in np.eye(6)]
    assert np.abs(model(INERTIA) - np.array(columns).T).max() < 1e-10


def test_the_linear_model_of_principal_axes():
    """The three equations as textbooks have them (Hughes 1986, section 9.3), in our axes: to rounding."""
    x, y, z = 6500.0, 30000.0, 29000.0
    w0 = ORBITAL_RATE
    a = model(np.diag([x, y, z]))
    expected = np.zeros((6, 6))
    expected[0, 1], expected[1, 0] = -w0, w0
    expected[:3, 3:] = np.eye(3)
    expected[3, 0], expected[3, 4] = 3.0 * w0**2 * (y - z) / x, -w0 * (y - z) / x
    expected[4, 3] = -w0 * (z - x) / y
    expected[5, 2] = 3.0 * w0**2 * (y - x) / z
    assert np.abs(a - expected).max() < 1e-18


def test_yaw_is_hardly_seen_and_pitch_runs_away():
    a = model(INERTIA)
    c = np.delete(np.eye(6), 1, axis=0)
    assert np.linalg.svd(np.vstack([c, c @ a]))[1][-1] == pytest.approx(7.8e-4, rel=0.01)
    assert np.linalg.eigvals(a).real.max() == pytest.approx(1.7e-3, rel=0.03)
