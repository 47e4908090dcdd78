"""Navigation with Gauss-Markov errors.

Truth: the autocorrelation sigma^2 exp(-t/T) with the white share at lag 0; chi-square intervals over independent runs;
exactness for steps of any length; the true state if all sigmas are 0.
"""

import math

import numpy as np
import pytest
from scipy import stats

from perilune.fmus_src.navigation.coloured import ColouredNavigation

POSITION = [1600.0, -20.0, 900.0]
VELOCITY = [30.0, 1.0, -50.0]
SIGMAS = np.array([2.0] * 3 + [0.1] * 3)


def navigation(**settings):
    block = ColouredNavigation(position=POSITION, velocity=VELOCITY, **settings)
    block.initialize()
    return block


def error(block):
    return np.array(
        [*np.subtract(block.estimated_position, POSITION), *np.subtract(block.estimated_velocity, VELOCITY)]
    )


def errors(step, count, **settings):
    block = navigation(**settings)
    rows = [error(block)]
    for k in range(count):
        block.step(k * step, step)
        rows.append(error(block))
    return np.array(rows) / SIGMAS


def test_without_sigmas_it_is_the_truth():
    block = navigation(position_sigma=0.0, velocity_sigma=0.0)
    for k in range(3):
        assert error(block) == pytest.approx(np.zeros(6), abs=0.0)
        block.step(0.1 * k, 0.1)
    assert block.estimate_covariance == [0.0] * 21


@pytest.mark.parametrize("step", [0.1, 7.0])
def test_flights_have_the_stated_variance_at_start_and_later(step):
    """Independent flights, so the sums are chi-square; the covariance that the block states is that one."""
    flights = np.array([errors(step, 3, seed=2, stream=k)[[0, 3]] for k in range(300)])
    low, high = stats.chi2.interval(0.999, 300)
    for values in flights.reshape(300, 12).T:
        assert low < np.sum(np.square(values)) / 1.09 < high
    block = navigation()
    assert block.position_estimate_sigma == pytest.approx([2.0 * math.sqrt(1.09)] * 3)
    upper = np.zeros((6, 6))
    upper[np.triu_indices(6)] = block.estimate_covariance
    assert upper == pytest.approx(np.diag(1.09 * SIGMAS**2))


@pytest.mark.parametrize("time", [5.0, 10.0])
def test_autocorrelation_is_exponential(time):
    """Along flights of 2000 s, axis by axis; five deviations of an estimate from 4000/20 independent pieces."""
    rows = np.vstack([errors(0.5, 4000, seed=3, stream=k, correlation_time=time) for k in range(2)]).reshape(2, -1, 6)
    for lag in (1, 10, 40):
        actual = np.mean(rows[:, lag:] * rows[:, :-lag], axis=(0, 1))
        assert actual == pytest.approx(
            np.full(6, math.exp(-0.5 * lag / time)), abs=5.0 * math.sqrt(2.0 * time / 4000.0)
        )


def test_axes_are_independent():
    rows = np.array([errors(0.1, 0, seed=6, stream=k)[0] for k in range(500)])
    across = np.corrcoef(rows.T) - np.eye(6)
    assert np.abs(across).max() < 4.0 / math.sqrt(500)


def test_the_white_share_is_new_at_every_point():
    """Without it, neighbours 0.01 s apart are all but equal; with it they differ by its size."""
    smooth = errors(0.01, 400, white_share=0.0, seed=8)
    rough = errors(0.01, 400, white_share=0.3, seed=8)
    step = math.sqrt(2.0 * (1.0 - math.exp(-0.001)))
    assert np.std(np.diff(smooth, axis=0)) == pytest.approx(step, rel=0.1)
    assert np.std(np.diff(rough, axis=0)) == pytest.approx(math.sqrt(2.0 * 0.09 + step**2), rel=0.1)
