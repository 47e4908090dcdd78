"""Sensor of path angle and altitude: errors have the declared distribution.

Truth: the uniform distribution (Kolmogorov-Smirnov test at 0.1 %), independence of the errors from sample to sample, of
each other and of other streams (correlation within 4 standard deviations of zero), and exactness without noise.
"""

import math

import numpy as np
import pytest
from scipy import stats

from perilune.fmus_src.runtime import BlockInstance
from perilune.fmus_src.sensors.planar_state_sensor import PlanarStateSensor

SAMPLES = 4000
ANGLE, ALTITUDE = -1.6, 18148.0


def sensor(**parameters):
    block = PlanarStateSensor(path_angle=ANGLE, altitude=ALTITUDE, **parameters)
    block.initialize()
    return block


def errors(count=SAMPLES, **parameters):
    """Return relative errors over the noise, two columns."""
    block = sensor(path_angle_noise=0.03, altitude_noise=0.1, **parameters)
    rows = []
    for k in range(count):
        rows.append([block.measured_path_angle / ANGLE - 1.0, block.measured_altitude / ALTITUDE - 1.0])
        block.step(0.01 * k, 0.01)
    return np.array(rows) / [0.03, 0.1]


def test_errors_are_uniform():
    for column in errors().T:
        assert stats.kstest(column, stats.uniform(-1.0, 2.0).cdf).pvalue > 1e-3


def test_errors_are_independent():
    actual = errors()
    bound = 4.0 / math.sqrt(SAMPLES)
    assert abs(np.corrcoef(actual.T)[0, 1]) < bound
    for lag in (1, 2, 7):
        for column in actual.T:
            assert abs(np.corrcoef(column[:-lag], column[lag:])[0, 1]) < bound
    assert abs(np.corrcoef(actual[:, 0], errors(stream=1)[:, 0])[0, 1]) < bound


def test_a_stream_repeats_itself():
    assert errors(50, seed=7, stream=3).tolist() == errors(50, seed=7, stream=3).tolist()


def test_without_noise_the_measurement_is_the_truth():
    block = sensor()
    for k in range(10):
        assert (block.measured_path_angle, block.measured_altitude) == (ANGLE, ALTITUDE)
        assert block.sample_count == k + 1
        block.step(0.01 * k, 0.01)


@pytest.mark.parametrize(("period", "every"), [(0.01, 1), (0.03, 3), (0.0, 1)])
def test_measurements_are_held_between_samples(period, every):
    component = BlockInstance(PlanarStateSensor)
    component.block.sample_period, component.block.altitude_noise = period, 0.1
    component.block.altitude = ALTITUDE
    component.start()
    values, counts = [component.block.measured_altitude], [component.block.sample_count]
    for k in range(12):
        component.do_step(0.01 * k, 0.01)
        values.append(component.block.measured_altitude)
        counts.append(component.block.sample_count)
    assert counts == [1 + k // every for k in range(13)]
    assert len(set(values)) == 1 + 12 // every
