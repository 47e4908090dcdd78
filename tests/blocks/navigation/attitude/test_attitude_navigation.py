"""Multiplicative filter of attitude and gyro bias: steady state, consistency, missing samples.

Truth: Farrenkopf's closed form (1978, as in Markley and Crassidis 2014, section 6.3.3) and scipy's algebraic Riccati
equation for the steady covariance; a chi-square test of the normalised error of simulations.
"""

import math

import numpy as np
import pytest
from scipy import stats
from scipy.linalg import solve_discrete_are
from scipy.spatial.transform import Rotation

from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.mathlib.estimation.attitude_errors import random_walks, transition
from perilune.fmus_src.mathlib.vectors import vector
from perilune.fmus_src.navigation.attitude_navigation import AttitudeNavigationStatus
from perilune.fmus_src.navigation.attitude_navigation_filter import AttitudeNavigationFilter
from tests.support.lengths import either

SIGMA, WALK, DRIFT, PERIOD = 3e-5, 1e-6, 1e-8, 1.0
NO_TURN = [1.0, 0.0, 0.0, 0.0]


def navigation(**settings):
    settings = {"star_sigma": SIGMA, "gyro_random_walk": WALK, "bias_random_walk": DRIFT} | settings
    block = AttitudeNavigationFilter(**settings)
    block.star_count = block.gyro_count = 1
    block.initialize()
    return block


def tick(block, time, step, gyros=(0.0, 0.0, 0.0), star=None):
    block.measured_angular_velocity = list(map(float, gyros))
    block.gyro_count += 1
    if star is not None:
        block.measured_quaternion = list(map(float, star))
        block.star_count += 1
    block.step(time, step)


def farrenkopf(sigma, walk, drift, period):
    """Return standard deviations of the angle before and after a sample."""
    u, v = drift * period**1.5 / sigma, walk * math.sqrt(period) / sigma
    gamma = math.sqrt(1.0 + 0.25 * v * v + u * u / 48.0)
    zeta = gamma + 0.25 * u + 0.5 * math.sqrt(2.0 * gamma * u + v * v + u * u / 3.0)
    return sigma * math.sqrt(zeta * zeta - 1.0), sigma * math.sqrt(1.0 - 1.0 / (zeta * zeta))


def riccati(sigma, walk, drift, period):
    """Return covariance of angle and bias before a sample, about one axis."""
    f = np.array([[1.0, -period], [0.0, 1.0]])
    cross = -0.5 * drift**2 * period**2
    q = np.array([[walk**2 * period + drift**2 * period**3 / 3.0, cross], [cross, drift**2 * period]])
    scale = np.diag([1.0 / sigma, period / sigma])  # so that the equation is well conditioned
    h = np.array([[1.0], [0.0]])
    fs = scale @ f @ np.linalg.inv(scale)
    p = solve_discrete_are(fs.T, h, scale @ q @ scale, np.eye(1))
    back = np.linalg.inv(scale)
    return back @ p @ back


@pytest.mark.parametrize("drift", either([1e-8, 3e-7], [3e-7]))
def test_the_steady_state_is_farrenkopfs(drift):
    """Without turns the axes are three filters of an angle and a bias, predicted in eight steps between samples."""
    block, step = navigation(bias_random_walk=drift, first_bias_sigma=1e-6), PERIOD / 8.0
    for n in range(8 * 1200 if drift < 1e-7 else 8 * 300):
        if (n + 1) % 8 == 0:
            before = predicted_sigma(block, step)
        tick(block, n * step, step, star=NO_TURN if (n + 1) % 8 == 0 else None)
    expected = farrenkopf(SIGMA, WALK, drift, PERIOD)
    p = riccati(SIGMA, WALK, drift, PERIOD)
    assert math.sqrt(p[0, 0]) == pytest.approx(expected[0], rel=1e-8)  # both truths agree
    np.testing.assert_allclose(before, expected[0], rtol=1e-6)
    np.testing.assert_allclose([*block.attitude_sigma], expected[1], rtol=1e-6)
    corrected = p - np.outer(p[:, 0], p[0]) / (p[0, 0] + SIGMA**2)
    np.testing.assert_allclose([*block.bias_sigma], math.sqrt(corrected[1, 1]), rtol=1e-6)


def predicted_sigma(block, step):
    """Return the standard deviation of the angle a step ahead, by the walks."""
    p = np.array(block.covariance.rows)
    f = np.array(transition(vector(0.0, 0.0, 0.0), step).rows)
    q = np.array(random_walks(block.gyro_random_walk, block.bias_random_walk, step).rows)
    return np.sqrt(np.diag(f @ p @ f.T + q))[:3]


def test_the_steady_state_of_a_small_satellite():
    """Published closed forms as numbers; the covariance of Riccati's equation stays as it is over a cycle."""
    sigma, walk, drift, period = 4.848e-5, 4.4e-5, 2.4e-8, 0.5
    before, after = farrenkopf(sigma, walk, drift, period)
    assert (before, after) == pytest.approx((4.5489556659266924e-05, 3.317281551699553e-05), rel=1e-12)
    p = riccati(sigma, walk, drift, period)
    p -= np.outer(p[:, 0], p[0]) / (p[0, 0] + sigma**2)
    assert np.sqrt(np.diag(p)) == pytest.approx([after, 1.027777801328818e-06], rel=1e-8)
    block = navigation(star_sigma=sigma, gyro_random_walk=walk, bias_random_walk=drift)
    block.covariance = Matrix(np.kron(p, np.eye(3)).tolist())
    tick(block, 0.0, 0.25)
    assert [*predicted_sigma(block, 0.25)] == pytest.approx([before] * 3, rel=1e-9)
    tick(block, 0.25, 0.25, star=NO_TURN)
    assert np.array(block.covariance.rows) == pytest.approx(np.kron(p, np.eye(3)), rel=1e-7, abs=1e-22)
    assert [*block.attitude_sigma, *block.bias_sigma] == pytest.approx(
        [after] * 3 + [1.027777801328818e-06] * 3, rel=1e-8
    )


def test_errors_have_the_covariance_that_the_filter_states():
    """Normalised errors of attitude and bias of a turning satellite are chi-square of six each."""
    random, step, ticks = np.random.default_rng(2012), 0.25, 160
    rate, squares = np.array([0.02, -0.03, 0.01]), []
    for _ in range(either(60, 25)):
        bias = 1e-5 * random.normal(size=3)
        truth = Rotation.random(rng=random)
        block = AttitudeNavigationFilter(
            star_sigma=SIGMA, gyro_random_walk=WALK, bias_random_walk=DRIFT, first_bias_sigma=1e-5
        )
        block.star_count = block.gyro_count = 1
        block.measured_quaternion = measured(random, truth)
        block.measured_angular_velocity = (rate + bias).tolist()
        block.initialize()
        for n in range(ticks):
            truth = truth * Rotation.from_rotvec(step * rate)
            bias = bias + DRIFT * math.sqrt(step) * random.normal(size=3)
            noise = WALK / math.sqrt(step) * random.normal(size=3)
            star = measured(random, truth) if n % 4 == 3 else None
            tick(block, n * step, step, rate + bias + noise, star)
        estimate = Rotation.from_quat([*block.estimated_quaternion], scalar_first=True)
        error = np.concatenate([(estimate.inv() * truth).as_rotvec(), bias - np.array([*block.estimated_bias])])
        squares.append(error @ np.linalg.solve(np.array(block.covariance.rows), error))
    low, high = stats.chi2.ppf([1e-4, 1.0 - 1e-4], 6 * len(squares))
    assert low < sum(squares) < high


def measured(random, truth):
    return (truth * Rotation.from_rotvec(SIGMA * random.normal(size=3))).as_quat(scalar_first=True).tolist()


def test_a_bias_is_learned():
    block, bias = navigation(first_bias_sigma=1e-5), np.array([1e-5, -2e-5, 0.5e-5])
    for n in range(600):
        tick(block, n, 1.0, bias, NO_TURN)
    np.testing.assert_allclose([*block.estimated_bias], bias, atol=1e-8)
    np.testing.assert_allclose([*block.estimated_angular_velocity], 0.0, atol=1e-8)


def test_without_stars_gyros_carry_on():
    """Constant rates: the exact rotation."""
    block, rate = navigation(), np.array([0.1, -0.2, 0.3])
    block.rate = rate.tolist()
    for n in range(80):
        tick(block, 0.125 * n, 0.125, rate)
    estimate = Rotation.from_quat([*block.estimated_quaternion], scalar_first=True)
    np.testing.assert_allclose(estimate.as_rotvec(), Rotation.from_rotvec(10.0 * rate).as_rotvec(), atol=1e-12)
    assert block.attitude_sigma.x > SIGMA


@pytest.mark.parametrize("wrong", [math.nan, math.inf])
def test_samples_that_are_not_finite_are_reported_and_left_out(wrong):
    block = navigation()
    tick(block, 0.0, 1.0, (wrong, 0.0, 0.0), NO_TURN)
    assert block.status == AttitudeNavigationStatus.NO_GYROS
    tick(block, 1.0, 1.0, star=[wrong, 0.0, 0.0, 1.0])
    assert block.status == AttitudeNavigationStatus.NO_STARS
    np.testing.assert_allclose([*block.estimated_quaternion], NO_TURN, atol=1e-12)
    tick(block, 2.0, 1.0, star=NO_TURN)
    assert block.status == AttitudeNavigationStatus.GOOD
