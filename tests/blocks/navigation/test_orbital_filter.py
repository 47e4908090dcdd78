"""Extended Kalman filter of the orbital attitude.

Truth: filterpy's extended Kalman filter with the derivatives by complex steps (1e-9 of the states, 1e-12 of the
covariance); the least possible variance of yaw, in closed form; the bias that is not observable next to yaw.
"""

import math

import numpy as np
import pytest

from tests.support.checks.navigation.orbital_filter import AttitudeKalman
from tests.support.flights.orbital_motion import DEGREE, ORBITAL_RATE
from tests.support.flights.orbital_runs import TICK, Run

NOISY = {
    "vertical_sigma": 0.05 * DEGREE,
    "gyro_sigma": 0.002 * DEGREE,
    "gyro_bias_sigma": 0.5 * DEGREE / 3600.0 / math.sqrt(3.0),
}


def test_it_is_the_filter_of_filterpy():
    random = np.random.default_rng(8)
    sample = (0.02, -0.01, (1e-4, -2e-4, -ORBITAL_RATE))
    run, twin = Run("orbital_filter", sample, **NOISY), AttitudeKalman(sample, **NOISY, tick=TICK)
    for _ in range(100):
        sample = (
            0.02 + random.normal(0.0, 1e-3),
            -0.01 + random.normal(0.0, 1e-3),
            tuple(np.array([1e-4, -2e-4, -ORBITAL_RATE]) + random.normal(0.0, 3e-5, 3)),
        )
        pulses = tuple(random.uniform(-0.1, 0.1, 3))
        row = run.step(sample, pulses)
        twin.step(sample, pulses)
    assert row[:3] == pytest.approx(twin.filter.x[:3], abs=1e-9)
    assert row[3:] == pytest.approx(twin.rates, abs=1e-9)
    assert [*run.block.estimated_gyro_bias] == pytest.approx(twin.filter.x[3:], abs=1e-9)
    assert np.reshape(run.block.covariance, (6, 6)) == pytest.approx(twin.filter.P, abs=1e-12)
    assert run.block.yaw_sigma == pytest.approx(math.sqrt(twin.filter.P[1, 1]), rel=1e-8)


@pytest.mark.parametrize(("time", "degrees"), [(20.0, 0.81), (60.0, 0.20), (100.0, 0.13)])
def test_yaw_is_known_as_well_as_it_can_be(time, degrees):
    """sigma^2 = (12 T sigma_h^2/t^3 + T sigma_w^2/t + sigma_b^2)/w0^2, a line through t/T samples: within 5 %."""
    minimum = math.sqrt(
        12.0 * TICK * NOISY["vertical_sigma"] ** 2 / time**3
        + TICK * NOISY["gyro_sigma"] ** 2 / time
        + NOISY["gyro_bias_sigma"] ** 2
    )
    assert minimum / ORBITAL_RATE / DEGREE == pytest.approx(degrees, abs=0.006)
    still = (0.0, 0.0, (0.0, 0.0, -ORBITAL_RATE))
    run = Run("orbital_filter", still, **NOISY)
    for _ in range(round(time / TICK)):
        run.step(still)
    assert run.block.yaw_sigma == pytest.approx(minimum / ORBITAL_RATE, rel=0.05)


def test_a_bias_of_the_roll_gyro_is_taken_for_yaw():
    """b of the roll gyro at rest looks as a yaw of b/w0: 0.25 deg per deg/h."""
    bias = 0.5 * DEGREE / 3600.0
    still = (0.0, 0.0, (bias, 0.0, -ORBITAL_RATE))
    run = Run("orbital_filter", still, **NOISY)
    for _ in range(2500):
        row = run.step(still)
    measured = row[1] + run.block.estimated_gyro_bias.x / ORBITAL_RATE
    assert measured == pytest.approx(bias / ORBITAL_RATE, rel=0.05)
    assert bias / ORBITAL_RATE / DEGREE / 0.5 == pytest.approx(0.25, abs=0.01)


def test_without_samples_it_knows_less_and_less():
    still = (0.0, 0.0, (0.0, 0.0, -ORBITAL_RATE))
    run = Run("orbital_filter", still, **NOISY)
    for _ in range(500):
        run.step(still)
    sigmas = [math.sqrt(run.block.covariance[0, 0])]
    for _ in range(100):
        run.step(still, new=False)
        sigmas.append(math.sqrt(run.block.covariance[0, 0]))
    assert np.all(np.diff(sigmas) > 0.0)
    assert run.block.status == 1
