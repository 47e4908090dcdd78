"""GPS receiver: magnitude and correlation of errors, latency, sample times, outages.

Truth: the true motion without errors; chi-square intervals (99.9 %); e^(-t/tau) for the autocorrelation, within
Bartlett's standard deviations (1946) for a first-order process.
"""

import math

import numpy as np
import pytest
from scipy import stats

from perilune.fmus_src.sensors.gps_receiver import GpsReceiver, ReceiverStatus
from tests.support.lengths import either

PERFECT = {"position_sigma": 0.0, "velocity_sigma": 0.0, "markov_sigma": 0.0}


def receiver(**settings):
    block = GpsReceiver(**settings)
    move(block, 0.0)
    block.initialize()
    return block


def move(block, time):
    block.position, block.velocity = [7e6 + 10.0 * time, 20.0 * time, 0.0], [10.0, 20.0, time]


def fly(block, count):
    """Return a sample per second: true time by its components, times as reported, counts, statuses."""
    rows = []
    for k in range(count):
        move(block, k + 1.0)
        block.step(float(k), 1.0)
        rows.append((block.measured_velocity.z, block.sample_time, block.sample_count, block.status))
    return rows


def assert_variance(values, sigma):
    low, high = stats.chi2.interval(0.999, np.size(values))
    assert low < np.sum(np.square(np.asarray(values) / sigma)) < high


@pytest.mark.parametrize("latency", range(5))
def test_a_sample_arrives_late_with_its_time(latency):
    block = receiver(latency=latency, clock_error=1e-3, **PERFECT)
    assert block.sample_count == (1 if latency == 0 else 0)
    for k, (time, reported, count, status) in enumerate(fly(block, 8)):
        arrived = k + 1 - latency
        assert (count, status) == (max(arrived + 1, 0), ReceiverStatus.GOOD)
        if arrived >= 0:
            assert (time, reported) == (arrived, arrived + 1e-3)
            assert block.measured_velocity.y == 20.0
    assert block.measured_position.y == 20.0 * (8 - latency)


def test_an_outage_keeps_the_last_sample():
    """One under way arrives yet; so does the first one after the outage, a period late."""
    block = receiver(**PERFECT)
    fly(block, 3)
    block.outage = True
    assert [row[2] for row in fly(block, 3)] == [4, 4, 4]
    assert block.status == ReceiverStatus.OUTAGE
    block.outage = False
    rows = fly(block, 3)
    assert [row[2] for row in rows] == [4, 5, 6]
    assert [row[3] for row in rows] == [ReceiverStatus.GOOD] * 3


@pytest.mark.parametrize("name", ["position", "velocity"])
def test_what_is_not_finite_is_no_sample(name):
    block = receiver(latency=0, **PERFECT)
    setattr(block, name, [0.0, math.nan, 0.0])
    block.step(0.0, 1.0)
    assert (block.status, block.sample_count, block.sample_time) == (ReceiverStatus.NOT_FINITE, 1, 0.0)
    assert [*block.measured_position] == [7e6, 0.0, 0.0]


def test_sizes_of_white_errors():
    block, errors = receiver(latency=0, markov_sigma=0.0), []
    for k in range(1000):
        block.step(float(k), 1.0)
        errors.append(np.subtract([*block.measured_position, *block.measured_velocity], [7e6, 0, 0, 10, 20, 0]))
    errors = np.array(errors)
    assert_variance(errors[:, :3], 3.0)
    assert_variance(errors[:, 3:], 0.03)
    assert np.abs(np.mean(errors[1:] * errors[:-1], axis=0) / np.var(errors, axis=0)).max() < 4.0 / math.sqrt(1000)


def test_the_slow_error_begins_in_its_steady_state():
    first = [
        np.subtract(receiver(stream=k, latency=0, position_sigma=0.0).measured_position, [7e6, 0.0, 0.0])
        for k in range(300)
    ]
    assert_variance(first, 5.0)


def test_the_slow_error_has_its_autocorrelation():
    """Over three axes; an error of velocity has none of it."""
    count, lag, period = either(20_000, 4_000), 10.0, 2.0
    block = receiver(**PERFECT | {"markov_sigma": 5.0, "markov_time": lag}, latency=0)
    errors = np.empty((count, 3))
    for k in range(count):
        block.step(period * k, period)
        errors[k] = np.subtract(block.measured_position, [7e6, 0.0, 0.0])
    assert [*block.measured_velocity] == [10.0, 20.0, 0.0]

    def rho(j):
        return np.exp(-np.abs(j) * period / lag)

    all_lags = np.arange(-200, 201)
    for k in (0, 1, 3, 5, 10):
        spread = np.sum(rho(all_lags) ** 2 + rho(all_lags + k) * rho(all_lags - k)) / (3 * count)
        measured = np.mean(errors[k:] * errors[: count - k]) / 25.0
        assert measured == pytest.approx(rho(k), abs=4.0 * math.sqrt(spread))
