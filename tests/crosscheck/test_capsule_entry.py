"""Perilune's side of the cross-check of the entry.

Truth: Newton's law in inertial axes and the kinematics of quaternions, on central differences of sixth order.
"""

import numpy as np
import pytest

from crosscheck.case import ATTITUDE, POSITION, RATE, VELOCITY
from crosscheck.cases.capsule_entry import case
from crosscheck.cases.capsule_entry.ours import simulate

STEP = 0.05  # s
WEIGHTS = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / (60.0 * STEP)
INNER = slice(3, -3)  # rows that have a central difference


def derivative(rows):
    return sum(weight * rows[k : rows.shape[0] - 6 + k] for k, weight in enumerate(WEIGHTS))


@pytest.fixture(scope="module")
def flight(fmus):
    """Return position, velocity, quaternion, rate: a row per time."""
    table = simulate(STEP)
    return [np.stack([table[name] for name in names], axis=1) for _, names in (POSITION, VELOCITY, ATTITUDE, RATE)]


def test_acceleration_is_gravity_and_drag(flight):
    """Against air that rotates with the Earth, of exponential density: 1e-6 of 42 m/s2."""
    position, velocity, _, _ = flight
    radius = np.linalg.norm(position, axis=1, keepdims=True)
    against = velocity - np.cross([0.0, 0.0, case.EARTH_RATE], position)
    (low, high), (dense, thin) = case.HEIGHTS, case.DENSITIES
    density = case.DENSITY_FACTOR * dense * (thin / dense) ** ((radius - case.EARTH_RADIUS - low) / (high - low))
    pressure = 0.5 * density * np.linalg.norm(against, axis=1, keepdims=True)
    drag = -pressure * case.AREA * case.DRAG_COEFFICIENT / case.MASS * against
    expected = drag - case.MU * position / radius**3
    assert np.abs(derivative(velocity) - expected[INNER]).max() < 4e-5
    assert np.linalg.norm(drag, axis=1).max() > 40.0


def test_velocity_and_rate_are_derivatives(flight):
    """Derivatives of position and quaternion: r' = v to 1e-6 m/s, 2 q* q' = w to 1e-6 rad/s."""
    position, velocity, quaternion, rate = flight
    assert np.abs(derivative(position) - velocity[INNER]).max() < 1e-6
    change, (scalar, vector) = derivative(quaternion), np.split(quaternion[INNER], [1], axis=1)
    twice = 2.0 * (scalar * change[:, 1:] - change[:, :1] * vector - np.cross(vector, change[:, 1:]))
    assert np.abs(twice - rate[INNER]).max() < 1e-6
