"""Infrared vertical and rate gyros: errors have the declared distributions.

Truth: normal and uniform distributions (Kolmogorov-Smirnov at 0.1 %), white or first-order errors (correlations within
4 standard deviations), exactness without errors.
"""

import math

import numpy as np
import pytest
from scipy import stats

from perilune.fmus_src.runtime import BlockInstance
from perilune.fmus_src.sensors.infrared_vertical import InfraredVertical
from perilune.fmus_src.sensors.rate_gyros import RateGyros

SAMPLES = 3000
TRUE = [0.02, 0.3, -0.01]
SIGMA = 1e-3


def vertical_errors(count=SAMPLES, **parameters):
    block = InfraredVertical(angles=TRUE, sigma=SIGMA, **parameters)
    block.initialize()
    rows = []
    for k in range(count):
        rows.append([block.measured_roll - TRUE[0], block.measured_pitch - TRUE[2]])
        block.step(0.2 * k, 0.2)
    return np.array(rows) / SIGMA


def gyro_errors(count=SAMPLES, **parameters):
    block = RateGyros(angular_velocity=TRUE, **({"sigma": SIGMA} | parameters))
    block.initialize()
    rows = []
    for k in range(count):
        rows.append(np.array([*block.measured_angular_velocity]) - TRUE)
        block.step(0.2 * k, 0.2)
    return np.array(rows) / SIGMA, np.array([*block.true_bias])


def correlation(column, lag):
    return np.corrcoef(column[:-lag], column[lag:])[0, 1]


def test_errors_are_normal_and_white():
    bound = 4.0 / math.sqrt(SAMPLES)
    columns = [*vertical_errors().T, *gyro_errors()[0].T]
    for column in columns:
        assert stats.kstest(column, "norm").pvalue > 1e-3
        assert all(abs(correlation(column, lag)) < bound for lag in (1, 2, 7))
    others = vertical_errors(stream=1)
    assert abs(np.corrcoef(columns[0], others[:, 0])[0, 1]) < bound
    assert abs(np.corrcoef(columns[0], columns[1])[0, 1]) < bound


def test_correlated_errors_are_a_first_order_process():
    """exp(-lag T/tau) between samples; the sigma is that of white ones within 10 % over 300 correlation times."""
    errors = vertical_errors(15000, correlation_time=2.0)[:, 0]
    for lag in (1, 5, 10):
        assert correlation(errors, lag) == pytest.approx(math.exp(-0.2 * lag / 2.0), abs=0.07)
    assert errors.std() == pytest.approx(1.0, abs=0.1)


def test_biases():
    assert vertical_errors(5, bias=[0.1, -0.2]) - vertical_errors(5) == pytest.approx(
        np.array([[100.0, -200.0]] * 5), rel=1e-9
    )
    sampled = np.array([gyro_errors(1, bias_limit=0.5, stream=stream)[1] for stream in range(400)])
    for column in sampled.T:
        assert stats.kstest(column, stats.uniform(-0.5, 1.0).cdf).pvalue > 1e-3
    errors, bias = gyro_errors(3, sigma=0.0, bias=[0.1, 0.2, 0.3], bias_limit=0.5)
    assert errors * SIGMA == pytest.approx(np.array([bias] * 3), rel=1e-12)


def test_a_stream_repeats_itself():
    assert vertical_errors(20, seed=7, stream=3).tolist() == vertical_errors(20, seed=7, stream=3).tolist()
    assert gyro_errors(20, seed=7)[0].tolist() == gyro_errors(20, seed=7)[0].tolist()


@pytest.mark.parametrize("kind", [InfraredVertical, RateGyros])
def test_samples_are_counted_and_held(kind):
    component = BlockInstance(kind)
    component.block.sample_period, component.block.sigma = 0.4, 1e-3
    component.start()
    counts, values = [], []
    for k in range(6):
        counts.append(component.block.sample_count)
        values.append(
            component.block.measured_roll if kind is InfraredVertical else component.block.measured_angular_velocity
        )
        component.do_step(0.2 * k, 0.2)
    assert counts == [1, 1, 2, 2, 3, 3]
    assert len(set(values)) == 3
