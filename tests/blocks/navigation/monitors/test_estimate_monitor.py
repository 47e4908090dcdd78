"""Estimate monitor compared with numpy's linear solver and the chi-square distribution.

Truth: `numpy.linalg.solve` of random positive covariances, to 1e-9; errors drawn from a covariance have
a normalised square that is chi-square distributed with six degrees of freedom.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats

from perilune.fmus_src.navigation.estimate_monitor import EstimateMonitor
from tests.support.lengths import either

UPPER = np.triu_indices(6)


def monitored(error, covariance):
    """Return a monitor of an estimate with that error at (1e5, -2e3, 1e4) m, (-900, 3, 5) m/s."""
    true = np.array([1e5, -2e3, 1e4, -900.0, 3.0, 5.0])
    block = EstimateMonitor(
        position=true[:3].tolist(),
        velocity=true[3:].tolist(),
        estimated_position=(true + error)[:3].tolist(),
        estimated_velocity=(true + error)[3:].tolist(),
        estimate_covariance=covariance[UPPER].tolist(),
    )
    block.initialize()
    return block


def random_covariance(generator):
    root = generator.normal(size=(6, 6))
    scale = np.array([30.0, 30.0, 20.0, 0.5, 0.5, 0.1])
    return (root @ root.T + 0.1 * np.eye(6)) * np.outer(scale, scale)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=either(50, 16), deadline=None)
def test_normalised_square_is_that_of_numpy(seed):
    generator = np.random.default_rng(seed)
    covariance = random_covariance(generator)
    # as the block sees it: differences of large numbers
    error = np.round(generator.normal(size=6) * 8.0) / 8.0
    block = monitored(error, covariance)
    expected = error @ np.linalg.solve(covariance, error)
    assert block.normalised_error_square == pytest.approx(expected, rel=1e-9, abs=1e-12)
    actual = [*block.position_error_ratio, *block.velocity_error_ratio]
    assert actual == pytest.approx(error / np.sqrt(covariance.diagonal()), rel=1e-12, abs=1e-12)


def test_errors_of_the_covariance_are_chi_square():
    generator = np.random.default_rng(1)
    covariance = random_covariance(generator)
    draws = generator.multivariate_normal(np.zeros(6), covariance, size=500)
    squares = [monitored(error, covariance).normalised_error_square for error in draws]
    assert stats.kstest(squares, "chi2", args=(6,)).pvalue > 1e-3


@pytest.mark.parametrize("flaw", ["zero", "a zero variance", "a negative variance", "a correlation of one"])
def test_a_covariance_that_is_not_positive_gives_zero(flaw):
    covariance = random_covariance(np.random.default_rng(2))
    if flaw == "zero":
        covariance[:] = 0.0
    elif flaw == "a zero variance":
        covariance[2, :] = covariance[:, 2] = 0.0
    elif flaw == "a negative variance":
        covariance[4, 4] *= -1.0
    else:
        covariance[0, 1] = covariance[1, 0] = np.sqrt(covariance[0, 0] * covariance[1, 1])
        covariance[0, 0] = covariance[0, 1] ** 2 / covariance[1, 1] * (1.0 - 1e-9)
    block = monitored(np.ones(6), covariance)
    assert block.normalised_error_square == 0.0
    ratios = [*block.position_error_ratio, *block.velocity_error_ratio]
    for ratio, variance in zip(ratios, covariance.diagonal(), strict=True):
        assert ratio == pytest.approx(1.0 / np.sqrt(variance) if variance > 0.0 else 0.0, rel=1e-10)


def test_it_compares_at_every_step():
    block = monitored(np.zeros(6), np.eye(6))
    assert block.normalised_error_square == 0.0
    x, y, z = block.position
    block.position = [x, y + 2.0, z]
    block.step(0.0, 0.1)
    assert block.normalised_error_square == 4.0
    assert block.position_error_ratio == [0.0, -2.0, 0.0]


def test_declared_starts_alone_run():
    block = EstimateMonitor()
    block.initialize()
    block.step(0.0, 0.1)
    assert block.normalised_error_square == 0.0
