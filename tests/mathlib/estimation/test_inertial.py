"""`perilune.fmus_src.mathlib.estimation.inertial`: inertial navigation and its error model.

Truth: `scipy.integrate.solve_ivp` with a specific force linear in time under central gravity (1 mm and 1e-5 m/s after
280 s, and the stated 7 mm with a force that is constant in each step); F P F' + Q by numpy with derivatives of the
error model by finite differences (1e-12 of the largest element).
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.mathlib.estimation.inertial import dead_reckon, predict_errors, sensor_addition
from perilune.fmus_src.mathlib.vectors import vector

RADIUS = 1.7374e6
MU = 4.9028e12
STEP = 0.1


def force(t):
    """Return specific force (m/s2), linear in time."""
    return np.array([4.0, -0.1, -1.0]) + np.array([0.016, 0.001, 0.018]) * t


def flown(linear):
    """Return position and velocity after 280 s of dead reckoning, with the slope of the force or without."""
    position, velocity = vector(2.6e5, 1e3, -2e3), vector(-1670.0, -10.0, 250.0)
    before = vector(*force(0.5 * STEP))
    for k in range(2800):
        now = vector(*force((k + 0.5) * STEP))
        position, velocity = dead_reckon(position, velocity, now, before if linear else now, RADIUS, MU, STEP)
        before = now
    return np.array(position), np.array(velocity)


def test_dead_reckoning_follows_the_equations_of_motion():
    def slope(t, y):
        centred = y[:3] - np.array([0.0, 0.0, -RADIUS])
        return np.concatenate([y[3:], force(t) - MU * centred / np.linalg.norm(centred) ** 3])

    start = [2.6e5, 1e3, -2e3, -1670.0, -10.0, 250.0]
    end = solve_ivp(slope, (0.0, 280.0), start, method="DOP853", rtol=1e-13, atol=1e-9).y[:, -1]
    position, velocity = flown(linear=True)
    assert position == pytest.approx(end[:3], abs=1e-3)
    assert velocity == pytest.approx(end[3:], abs=1e-5)
    rough, _ = flown(linear=False)
    assert np.linalg.norm(rough - position) == pytest.approx(
        STEP**2 / 12.0 * np.linalg.norm(force(280.0) - force(0.0)), rel=0.01
    )


def measured(errors, f):
    """Return the specific force with an inertial sensor's errors (bias, scale factors, rotation), by numpy."""
    return f + errors[:3] + errors[3:6] * f + np.cross(errors[6:], f)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_sensor_addition_is_the_error_model(seed):
    generator = np.random.default_rng(seed)
    errors, f = generator.normal(size=9), generator.normal(size=3)
    added = sensor_addition(vector(*errors[0:3]), vector(*errors[3:6]), vector(*errors[6:9]), vector(*f))
    assert added == pytest.approx(measured(errors, f) - f, abs=1e-13)


@pytest.mark.parametrize("sensing", [True, False])
@pytest.mark.parametrize("gradient", [0.0, 9e-7, 0.3])
@given(seed=st.integers(0, 2**32 - 1))
@settings(max_examples=10, deadline=None)
def test_covariance_moves_as_with_full_matrices(sensing, gradient, seed):
    generator = np.random.default_rng(seed)
    f = 5.0 * generator.normal(size=3)
    h, walk, drift = generator.uniform(0.01, 1.0), *generator.uniform(0.0, 0.1, size=2)
    up = generator.normal(size=3)
    up /= np.linalg.norm(up)
    root = generator.normal(size=(15, 15))
    p = root @ root.T
    addition = np.column_stack([measured(unit, f) - measured(np.zeros(9), f) for unit in np.eye(9)])
    transition = np.eye(15)
    transition[0:3, 3:6] = h * np.eye(3)
    noise = np.zeros((15, 3))
    if sensing:
        transition[0:3, 6:] = -0.5 * h * h * addition
        transition[3:6, 6:] = -h * addition
        noise = np.vstack([0.5 * h * np.eye(3), np.eye(3), np.zeros((9, 3))])
    pull = gradient * (3.0 * np.outer(up, up) - np.eye(3)) @ np.hstack([np.eye(3), 0.5 * h * np.eye(3)])
    transition[0:3, 0:6] += 0.5 * h * h * pull
    transition[3:6, 0:6] += h * pull
    expected = transition @ p @ transition.T + walk * h * noise @ noise.T
    expected[6:9, 6:9] += drift * h * np.eye(3)
    actual = Matrix(p.tolist())
    predict_errors(actual, vector(*f), sensing, walk, drift, vector(*up), gradient, h)
    assert np.array(actual) == pytest.approx(expected, abs=1e-12 * abs(expected).max())


def test_a_gradient_of_gravity_moves_errors_as_the_motion_itself_does():
    """Half an orbit of 100 km: two dead reckonings 1 m or 1 mm/s apart, by the linear differential equation.

    G = mu/r^3 (3 u u' - 1) turns with the orbit; to 1e-4 of the largest element after 3500 s.
    """
    radius = RADIUS + 1e5
    rate = np.sqrt(MU / radius**3)

    def slope(t, y):
        up = np.array([np.sin(rate * t), 0.0, np.cos(rate * t)])
        system = np.zeros((6, 6))
        system[:3, 3:] = np.eye(3)
        system[3:, :3] = rate**2 * (3.0 * np.outer(up, up) - np.eye(3))
        return (system @ y.reshape(6, 6)).ravel()

    moved = solve_ivp(slope, (0.0, 3500.0), np.eye(6).ravel(), method="DOP853", rtol=1e-11, atol=1e-12)
    transition = moved.y[:, -1].reshape(6, 6)
    first = np.diag([100.0**2] * 3 + [0.1**2] * 3)
    p = np.zeros((15, 15))
    p[:6, :6] = first
    actual = Matrix(p.tolist())
    for k in range(3500):
        angle = rate * (k + 0.5)
        up = vector(np.sin(angle), 0.0, np.cos(angle))
        predict_errors(actual, vector(0.0, 0.0, 0.0), False, 1.0, 0.0, up, rate**2, 1.0)
    expected = transition @ first @ transition.T
    assert np.array(actual)[:6, :6] == pytest.approx(expected, abs=1e-4 * abs(expected).max())
