"""Magnetometer: each error separately, limits, and random numbers.

Truth: numbers by hand and a matrix by numpy for constant errors, chi-square intervals (99.9 %) for random errors.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from perilune.fmus_src.sensors.magnetometer import Magnetometer, MagnetometerStatus

PERFECT = {"sigma": 0.0, "bias_sigma": 0.0, "scale_sigma": 0.0, "quantum": 0.0}
FIELD = [2.1e-5, -9.5e-6, 2.92e-5]


def magnetometer(field=FIELD, dipole=(0.0, 0.0, 0.0), **settings):
    block = Magnetometer(**settings)
    block.magnetic_field_body, block.applied_dipole = list(field), list(dipole)
    block.initialize()
    return block


def assert_variance(values, sigma):
    low, high = stats.chi2.interval(0.999, np.size(values))
    assert low < np.sum(np.square(np.asarray(values) / sigma)) < high


def test_scale_factors_coupling_and_bias():
    block = magnetometer(
        dipole=(1.0, -2.0, 3.0),
        scale=[2e-3, 1e-3, 0.0, 0.0, -1e-3, -2e-3, 5e-4, 0.0, 1e-3],
        coupling=[2e-7, 0.5e-7, 0.0, 0.5e-7, 3e-7, 0.2e-7, 0.0, 0.2e-7, 1e-7],
        bias=[2e-7, -1e-7, 3e-7],
        **PERFECT,
    )
    assert [*block.measured_field] == pytest.approx([2.13325e-05, -1.01389e-05, 2.97997e-05], rel=1e-13)


def test_a_dipole_adds_a_column_of_the_coupling():
    coupling = 1e-8 * np.arange(9.0).reshape(3, 3)
    for k in range(3):
        block = magnetometer([0.0, 0.0, 0.0], dipole=np.eye(3)[k], coupling=coupling.ravel().tolist(), **PERFECT)
        assert [*block.measured_field] == pytest.approx(coupling[:, k], rel=1e-14)


@given(st.lists(st.floats(-2e-4, 2e-4), min_size=3, max_size=3))
def test_limits_and_steps(field):
    """A component leaves its true one by half a step, but for the range; on the half it goes up."""
    block = magnetometer(field, **PERFECT | {"quantum": 1e-8})
    limited = np.clip(field, -1e-4, 1e-4)
    assert np.abs(np.subtract(block.measured_field, limited)).max() <= 0.5e-8 * (1.0 + 1e-9)
    steps = np.divide(block.measured_field, 1e-8)
    assert steps == pytest.approx(np.round(steps), abs=1e-9)
    expected = MagnetometerStatus.SATURATED if np.abs(field).max() > 1e-4 else MagnetometerStatus.GOOD
    assert block.status == expected


def test_a_half_step_goes_up():
    block = magnetometer([0.5, -0.5, 1.5], **PERFECT | {"quantum": 1.0, "range": 10.0})
    assert [*block.measured_field] == [1.0, 0.0, 2.0]


@pytest.mark.parametrize("name", ["magnetic_field_body", "applied_dipole"])
def test_an_input_that_is_not_finite_is_no_sample(name):
    block = magnetometer(**PERFECT)
    setattr(block, name, [0.0, math.nan, 0.0])
    block.step(0.0, 1.0)
    assert (block.status, block.sample_count) == (MagnetometerStatus.NOT_FINITE, 1)
    assert [*block.measured_field] == FIELD
    setattr(block, name, [0.0, 0.0, 0.0])
    block.step(1.0, 1.0)
    assert (block.status, block.sample_count) == (MagnetometerStatus.GOOD, 2)


def test_sizes_of_random_errors():
    """Per flight a bias and nine elements of S, which stay; per sample the noise."""
    flights = [magnetometer([0.0, 0.0, 0.0], stream=k, **PERFECT | {"bias_sigma": 2e-7}) for k in range(200)]
    assert_variance([[*block.measured_field] for block in flights], 2e-7)
    flights = [magnetometer(stream=k, **PERFECT | {"scale_sigma": 2e-3}) for k in range(200)]
    assert_variance([block.total_scale.rows for block in flights], 2e-3)
    errors = [np.subtract(block.measured_field, FIELD) for block in flights]
    assert_variance(errors, 2e-3 * np.linalg.norm(FIELD))
    first = [*flights[0].measured_field]
    flights[0].step(0.0, 1.0)
    assert [*flights[0].measured_field] == first
    block, white = magnetometer(**PERFECT | {"sigma": 5e-8}), []
    for k in range(1000):
        block.step(float(k), 1.0)
        white.append(np.subtract(block.measured_field, FIELD))
    assert_variance(white, 5e-8)
    assert np.abs(np.mean(np.multiply(white[1:], white[:-1]), axis=0)).max() < 4.0 * 5e-8**2 / math.sqrt(1000)
