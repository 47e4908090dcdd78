"""Input `free_flight` of the navigation interface and parameter `gravity_gradient` of the filters.

Truth: a navigation whose inertial sensor measures zero and has no assumed errors, to the bit; a circular orbit in
closed form; the linear differential equation of the errors, solved by scipy; and, over 100 seeds of a coast of 3000 s,
the chi-square distribution, with which the covariance agrees only with the gradient.
"""

import math

import numpy as np
import pytest
from scipy import stats
from scipy.linalg import expm

from perilune.fmus_src.navigation.ideal import IdealNavigation
from perilune.fmus_src.navigation.kalman import KalmanNavigation
from perilune.fmus_src.navigation.kalman_filterpy import KalmanNavigationFilterpy
from perilune.fmus_src.navigation.noisy import NoisyNavigation
from perilune.fmus_src.navigation.raw import RawNavigation
from tests.support.flights.braking_flight import MOON_RADIUS, MU, measurements
from tests.support.flights.navigation_runs import plain, state_of

FILTERS = [KalmanNavigation, KalmanNavigationFilterpy]
RADIUS = MOON_RADIUS + 1e5
RATE = math.sqrt(MU / RADIUS**3)
NO_SENSOR_ERRORS = {
    "bias_sigma": 0.0,
    "scale_factor_sigma": 0.0,
    "attitude_sigma": 0.0,
    "velocity_random_walk": 0.0,
}


def on_circle(t):
    """Return position and velocity on a circular orbit of 100 km over the site at t = 0."""
    p = -RATE * t
    place = RADIUS * np.array([math.sin(p), 0.0, math.cos(p)]) - [0.0, 0.0, MOON_RADIUS]
    return place, RATE * RADIUS * np.array([-math.cos(p), 0.0, math.sin(p)])


def coast(block_class, duration, step=0.5, errors=(1e-3, 2e-4, -5e-4), **settings):
    """Return the block at the end of a coast, fed with increments that are an inertial sensor's
    errors and nothing else."""
    place, speed = on_circle(0.0)
    block = block_class(position=place.tolist(), velocity=speed.tolist(), **settings)
    block.initialize()
    for k in range(round(duration / step)):
        block.velocity_increment = [step * error for error in errors]
        block.inertial_count = k + 1
        block.step(k * step, step)
    return block


@pytest.mark.parametrize("block_class", FILTERS)
def test_a_free_filter_is_one_with_a_perfect_sensor_that_measures_nothing(block_class):
    values = {"seed": 3, "stream": 9, "gravity_gradient": True}
    free = coast(block_class, 20.0, free_flight=True, **values)
    perfect = coast(block_class, 20.0, errors=(0.0, 0.0, 0.0), **values, **NO_SENSOR_ERRORS)
    assert state_of(free).tolist() == state_of(perfect).tolist()
    assert list(free.estimate_covariance) == list(perfect.estimate_covariance)
    assert free.sample_count == perfect.sample_count
    retained = np.reshape(free.covariance, (15, 15))
    assert np.sqrt(retained.diagonal()[6:]) == pytest.approx([1e-3] * 3 + [3e-4] * 3 + [math.radians(0.02)] * 3)
    assert not retained[:6, 6:].any()


def test_free_raw_navigation_follows_the_orbit():
    free = coast(RawNavigation, 1000.0, free_flight=True, first_position_sigma=0.0, first_velocity_sigma=0.0)
    place, speed = on_circle(1000.0)
    assert free.estimated_position == pytest.approx(place, abs=0.2)
    assert free.estimated_velocity == pytest.approx(speed, abs=1e-3)


def test_free_noisy_navigation_knows_no_thrust():
    flown = []
    for settings in ({"free_flight": True, "specific_force": [3.0, 1.0, 2.0]}, {"specific_force": [0.0] * 3}):
        block = NoisyNavigation(position=[1e4, 0.0, 5e3], position_sigma=20.0, position_period=5.0, **settings)
        block.initialize()
        for k in range(40):
            block.step(0.5 * k, 0.5)
        flown.append([*block.estimated_position, *block.estimated_velocity, *block.estimate_covariance])
    assert flown[0] == flown[1]


def test_free_ideal_navigation_passes_the_truth_on():
    block = IdealNavigation(position=[1.0, 2.0, 3.0], velocity=[4.0, 5.0, 6.0], free_flight=True)
    block.initialize()
    assert state_of(block).tolist() == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]


@pytest.mark.parametrize("block_class", [RawNavigation, *FILTERS])
def test_not_free_and_without_gradient_nothing_changes(block_class):
    """To the bit, over 30 s of the braking flight with all sensors."""
    settings = {} if block_class is RawNavigation else {"gravity_gradient": False}
    flights = [
        plain(block_class, measurements(5), seed=2, **values) for values in ({}, {"free_flight": False, **settings})
    ]
    for (k, one), (_, other) in zip(*flights, strict=True):
        assert state_of(one).tolist() == state_of(other).tolist()
        assert list(one.estimate_covariance) == list(other.estimate_covariance)
        if k == 300:
            break


def test_thrust_after_free_flight_is_sensed_at_once():
    """Increments passed over do not come back, and the first one with thrust counts whole."""
    block = coast(KalmanNavigation, 10.0, free_flight=True, first_position_sigma=0.0, first_velocity_sigma=0.0)
    before = np.array(block.estimated_velocity)
    block.free_flight = False
    block.velocity_increment = [5.0, 0.0, 0.0]
    block.inertial_count = 21
    block.step(10.0, 0.5)
    gravity = -MU / RADIUS**2 * 0.5
    gained = np.array(block.estimated_velocity) - before
    assert gained[0] == pytest.approx(5.0, abs=0.01)
    assert gained[2] == pytest.approx(gravity, abs=0.01)


@pytest.mark.parametrize("block_class", FILTERS)
def test_the_gradient_is_that_of_the_exponential(block_class):
    """To 1e-4 of what it adds, in a field 1e4 times as strong, in which one step is not lost in rounding."""
    place, speed = on_circle(0.0)
    moved = []
    for gradient in (True, False):
        block = block_class(
            position=place.tolist(),
            velocity=speed.tolist(),
            free_flight=True,
            gravity_gradient=gradient,
            gravitational_parameter=1e4 * MU,
        )
        block.initialize()
        block.estimated_velocity = [0.0, 0.0, 0.0]
        block.estimated_position = [0.0, 0.0, 1e5]
        block.predict(0.05)
        moved.append(np.reshape(block.covariance, (15, 15))[:6, :6])
    system = np.zeros((6, 6))
    system[:3, 3:] = np.eye(3)
    system[3:, :3] = 1e4 * RATE**2 * np.diag([-1.0, -1.0, 2.0])
    transition = expm(0.05 * system)
    first = np.diag([500.0**2] * 3 + [1.0] * 3)
    added = transition @ first @ transition.T - moved[1]
    assert moved[0] - moved[1] == pytest.approx(added, abs=1e-4 * abs(added).max())


def squares(gradient, flights=100):
    """Return NEES of coasts of 3000 s, by the block's own covariance; the same coast without first errors is the
    truth."""
    settings = {"step": 10.0, "errors": (0.0, 0.0, 0.0), "free_flight": True, "gravity_gradient": gradient}
    truth = state_of(coast(KalmanNavigation, 3000.0, first_position_sigma=0.0, first_velocity_sigma=0.0, **settings))
    actual = []
    for stream in range(flights):
        block = coast(
            KalmanNavigation, 3000.0, stream=stream, first_position_sigma=100.0, first_velocity_sigma=0.1, **settings
        )
        covariance = np.zeros((6, 6))
        covariance[np.triu_indices(6)] = block.estimate_covariance
        covariance = covariance + covariance.T - np.diag(covariance.diagonal())
        error = state_of(block) - truth
        actual.append(error @ np.linalg.solve(covariance, error))
    return np.array(actual)


@pytest.mark.slow
def test_over_half_an_orbit_only_the_gradient_makes_the_covariance_right():
    low, high = stats.chi2.interval(0.999, 6 * 100)
    assert low < squares(True).sum() < high
    assert squares(False, 20).mean() > 20.0
