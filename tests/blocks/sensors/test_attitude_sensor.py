"""Sensor of thrust axis and angular rate.

Truth: the true axis if all sigmas are 0; scipy's rotations for one small error; chi-square intervals (99.9 %) for error
magnitudes, over simulations for the constant error and over one simulation for white noise.
"""

import numpy as np
import pytest
from scipy import stats
from scipy.spatial.transform import Rotation

from perilune.fmus_src.sensors.attitude_sensor import AttitudeSensor

AXIS = np.array([0.36, -0.48, 0.8])
RATE = np.array([0.02, 0.03, 0.009])
PERFECT = {"constant_sigma": 0.0, "attitude_sigma": 0.0, "rate_sigma": 0.0}


def sensor(**settings):
    block = AttitudeSensor(attitude=AXIS.tolist(), angular_rate=RATE.tolist(), **settings)
    block.initialize()
    return block


def samples(block, count):
    """Return errors of axis and rate, a row per sample."""
    rows = []
    for k in range(count):
        rows.append([*np.subtract(block.measured_attitude, AXIS), *np.subtract(block.measured_angular_rate, RATE)])
        block.step(0.1 * k, 0.1)
    return np.array(rows)


def assert_variance(values, sigma):
    low, high = stats.chi2.interval(0.999, values.size)
    assert low < np.sum(np.square(values / sigma)) < high


def test_without_sigmas_it_is_the_truth():
    assert np.abs(samples(sensor(**PERFECT), 5)).max() < 1e-15


def test_the_constant_error_is_a_rotation_that_stays():
    block = sensor(**PERFECT | {"constant_sigma": 1e-3})
    errors = samples(block, 5)
    assert (errors == errors[0]).all()
    turned = Rotation.from_rotvec(block.misalignment).apply(AXIS)
    assert block.measured_attitude == pytest.approx(turned, abs=1e-5)
    assert np.linalg.norm(block.measured_attitude) == pytest.approx(1.0, abs=1e-15)


def test_sizes_of_the_errors():
    """An error of axis is perpendicular to it: two components of three."""
    e1 = np.cross(AXIS, [1.0, 0.0, 0.0])
    e1 /= np.linalg.norm(e1)
    across = np.array([e1, np.cross(AXIS, e1)]).T
    constant = [samples(sensor(**PERFECT | {"constant_sigma": 1e-3}, seed=4, stream=k), 1)[0] for k in range(500)]
    assert_variance((np.array(constant)[:, :3] @ across).ravel(), 1e-3)
    white = samples(sensor(constant_sigma=0.0, attitude_sigma=2e-4, rate_sigma=3e-4, seed=5), 1000)
    assert_variance((white[:, :3] @ across).ravel(), 2e-4)
    assert_variance(white[:, 3:].ravel(), 3e-4)
    lagged = np.mean(white[1:] * white[:-1], axis=0) / np.mean(white**2, axis=0)
    assert np.abs(lagged).max() < 4.0 / np.sqrt(len(white))
