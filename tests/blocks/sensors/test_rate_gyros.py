"""Rate gyros: each error separately, limits, latency, and the Allan deviation of all errors together.

Truth: numbers by hand for constant errors; the closed forms of IEEE Std 952 for the Allan variance of white noise,
quantisation, a first-order Gauss-Markov bias and a rate random walk, within chi-square intervals.
"""

import math

import numpy as np
import pytest
from scipy import stats

from perilune.fmus_src.mathlib.rng import normals, seed_streams, uniform
from perilune.fmus_src.mathlib.vectors import vector
from perilune.fmus_src.sensors.rate_gyros import RateGyros, RateGyrosStatus
from tests.support.lengths import either

RATE = [0.01, -0.02, 0.03]


def gyros(rate=RATE, **settings):
    block = RateGyros(**settings)
    block.angular_velocity = list(rate)
    block.initialize()
    return block


def fly(block, count, step=0.25):
    rows = np.empty((count, 3))
    for k in range(count):
        block.step(step * k, step)
        rows[k] = block.measured_angular_velocity
    return rows


@pytest.mark.parametrize(
    ("quantum", "expected"), [(0.0, (0.009978, -0.019993, 0.030022)), (1e-5, (0.00998, -0.01999, 0.03002))]
)
def test_scale_factors_misalignment_and_bias(quantum, expected):
    scale = [3e-4, 1e-3, -5e-4, 2e-4, -2e-4, 7e-4, -3e-4, 4e-4, 1e-4]
    block = gyros(scale=scale, bias=[1e-5, -2e-5, 3e-5], quantum=quantum)
    assert [*block.measured_angular_velocity] == pytest.approx(expected, rel=1e-12)
    assert [*block.true_bias] == [1e-5, -2e-5, 3e-5]


@pytest.mark.parametrize(
    ("rate", "measured", "status"),
    [
        ([0.1, -0.1, 0.05], [0.1, -0.1, 0.05], RateGyrosStatus.GOOD),
        ([0.11, -0.1, 0.05], [0.1, -0.1, 0.05], RateGyrosStatus.SATURATED),
        ([0.0, -7.0, 7.0], [0.0, -0.1, 0.1], RateGyrosStatus.SATURATED),
    ],
)
def test_a_component_beyond_the_range_stays_at_it(rate, measured, status):
    block = gyros(rate, range=0.1)
    assert ([*block.measured_angular_velocity], block.status) == (measured, status)
    assert gyros(rate).status == RateGyrosStatus.GOOD


def test_a_rate_that_is_not_finite_is_reported():
    block = gyros(quantum=1e-5, range=0.1)
    block.angular_velocity = [math.nan, 0.0, 0.0]
    block.step(0.0, 0.25)
    assert (block.status, block.sample_count) == (RateGyrosStatus.NOT_FINITE, 2)
    assert math.isnan(block.measured_angular_velocity.x)


@pytest.mark.parametrize("latency", range(5))
def test_a_sample_arrives_late(latency):
    block = gyros([0.0, 0.0, 0.0], latency=latency)
    for k in range(8):
        block.angular_velocity = [k + 1.0, 0.0, 0.0]
        block.step(0.25 * k, 0.25)
        arrived = k + 1 - latency
        assert block.sample_count == max(arrived + 1, 0)
        assert block.measured_angular_velocity.x == max(arrived, 0)


@pytest.mark.parametrize("walk", [0.0, 1e-4])
def test_errors_that_are_off_leave_the_stream_as_it_was(walk):
    """Latency, range, scale factors draw no number: the generator of a flight with them is that of one without."""
    plain, other = (
        gyros(sigma=1e-3, bias_limit=1e-3, bias_walk=walk, seed=3, **settings)
        for settings in ({}, {"scale": [1e-3] * 9, "range": 1.0, "quantum": 1e-9, "latency": 1})
    )
    before = fly(plain, 20)
    after = fly(other, 20)
    assert plain.generator == other.generator
    assert after[1:] == pytest.approx(before[:-1] + 1e-3 * sum(RATE), abs=1e-9)


def test_at_defaults_a_sample_is_rate_bias_and_noise():
    """Bit by bit, from the same stream of numbers."""
    block, stream = gyros(sigma=1e-3, bias_limit=2e-3, bias=[1e-3, 0.0, 2e-3], seed=3, stream=2), [0.0] * 6
    seed_streams(stream, 3, 2)
    bias = vector(1e-3, 0.0, 2e-3) + 2e-3 * (2.0 * vector(*(uniform(stream) for _ in range(3))) - vector(1.0, 1.0, 1.0))
    for k in range(20):
        assert [*block.measured_angular_velocity] == [*(vector(*RATE) + bias + 1e-3 * normals(stream))]
        block.step(0.2 * k, 0.2)


def allan_variance(tau, noise, instability, lag, walk):
    """Return the variance by IEEE Std 952, annex C."""
    x = tau / lag
    wandering = 2.0 * instability**2 / x * (1.0 - (3.0 - 4.0 * np.exp(-x) + np.exp(-2.0 * x)) / (2.0 * x))
    return noise**2 / tau + wandering + walk**2 * tau / 3.0


def test_the_correlated_bias_begins_in_its_steady_state():
    """Over flights, at the start and after many times of its correlation."""
    flights = [gyros(instability_sigma=1e-3, instability_time=0.5, stream=k) for k in range(200)]
    for _ in range(2):
        errors = [np.subtract(block.measured_angular_velocity, RATE) for block in flights]
        low, high = stats.chi2.interval(0.999, np.size(errors))
        assert low < np.sum(np.square(errors)) / 1e-3**2 < high
        for block in flights:
            fly(block, 20)


def test_the_closed_form_has_the_numbers_of_a_small_satellites_gyro():
    tau = np.array([0.25, 1.0, 10.0, 100.0, 300.0, 1000.0, 3000.0, 10000.0])
    deviations = np.sqrt(allan_variance(tau, 4.4e-5, 4.8e-6, 300.0, 2e-9))
    expected = [
        *(8.800007268365735e-05, 4.400058037721518e-05, 1.3931956434657865e-05, 4.835048063159127e-06),
        *(3.768206165527823e-06, 3.1358872381356964e-06, 2.1368610561835114e-06, 1.2357691262259847e-06),
    ]
    assert deviations == pytest.approx(expected, rel=1e-10)


SIGMA, QUANTUM, INSTABILITY, LAG, WALK, STEP = 1e-3, 1e-3, 1e-3, 8.0, 2e-5, 0.25
CLUSTERS = [1, 4, 16, 64, 256]


def covariances(size, count):
    """Return covariances of the differences of consecutive clusters with those 0, 1, ... pairs
    later, from sample to sample."""
    weights = np.concatenate([np.full(size, -1.0 / size), np.full(size, 1.0 / size)])
    both = np.correlate(weights, weights, "full")
    lags = np.arange(1 - 2 * size, 2 * size)[None, :] + 2 * size * np.arange(count)[:, None]
    process = INSTABILITY**2 * np.exp(-np.abs(lags) * STEP / LAG) - 0.5 * WALK**2 * np.abs(lags) * STEP
    process[lags == 0] += SIGMA**2 + QUANTUM**2 / 12.0
    return process @ both


@pytest.fixture(scope="module")
def flight():
    settings = {"sigma": SIGMA, "quantum": QUANTUM, "bias_walk": WALK, "sample_period": STEP, "seed": 8}
    block = gyros([0.0123, -0.02, 0.03], instability_sigma=INSTABILITY, instability_time=LAG, **settings)
    return fly(block, either(60_000, 12_000), STEP)


@pytest.mark.parametrize("size", CLUSTERS)
def test_a_flight_has_the_allan_deviation(flight, size):
    """Three axes, pairs of clusters that share no sample; degrees of freedom by Satterthwaite, as pairs correlate."""
    pairs = len(flight) // (2 * size)
    means = flight[: 2 * size * pairs].reshape(pairs, 2, size, 3).mean(axis=2)
    differences = means[:, 1] - means[:, 0]
    covariance = covariances(size, min(pairs, 400))
    noise = math.sqrt((SIGMA**2 + QUANTUM**2 / 12.0) * STEP)
    expected = allan_variance(size * STEP, noise, INSTABILITY, LAG, WALK)
    assert 0.5 * covariance[0] == pytest.approx(expected, rel=0.01)
    ratios = (covariance[1:] / covariance[0]) ** 2
    freedom = 3.0 * pairs / (1.0 + 2.0 * np.sum((1.0 - np.arange(1, len(covariance)) / pairs) * ratios))
    low, high = stats.chi2.interval(0.999, freedom)
    assert low < freedom * np.mean(differences**2) / covariance[0] < high
