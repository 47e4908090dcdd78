"""Star tracker of `star_inertial`: exclusion angles, latency and sample times, error about the boresight.

Truth: geometry set up by scipy's rotations; chi-square intervals (99.9 %).
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats
from scipy.spatial.transform import Rotation

from perilune.fmus_src.mathlib.attitude.quaternion import from_rotation_vector, multiply, normalise
from perilune.fmus_src.mathlib.rng import normals, seed_streams
from perilune.fmus_src.mathlib.vectors import vector
from perilune.fmus_src.sensors.star_inertial import StarInertial, StarTrackerStatus

ATTITUDE = Rotation.from_rotvec([0.4, -1.1, 0.7])
BORESIGHT = np.array([2.0, -1.0, 2.0])  # of length 3
AIM = ATTITUDE.apply(BORESIGHT / 3.0)
RADIUS, DISTANCE = 6378137.0, 7e6
off = st.one_of(st.floats(0.0, math.pi), st.floats(-1e-3, 1e-3).map(lambda a: 0.6 + a))
seeds = st.integers(0, 2**32 - 1)


def away(angle, seed=0):
    """Return a unit vector (inertial) at an angle from the boresight."""
    side = np.cross(AIM, np.random.default_rng(seed).normal(size=3))
    return Rotation.from_rotvec(angle * side / np.linalg.norm(side)).apply(AIM)


def tracker(sun=None, moon=None, nadir=None, **settings):
    """Return a tracker with directions to Sun, nadir and a Moon nearby (inertial), after a sample."""
    block = StarInertial(boresight=BORESIGHT.tolist(), **settings)
    block.quaternion = ATTITUDE.as_quat(scalar_first=True).tolist()
    position = -DISTANCE * np.array(away(math.pi) if nadir is None else nadir)
    block.position = position.tolist()
    block.sun_direction = (away(math.pi) if sun is None else sun).tolist()
    block.moon_position = (position + 2e7 * (away(math.pi) if moon is None else moon)).tolist()
    block.initialize()
    return block


def assert_excluded(block, excluded):
    expected = (StarTrackerStatus.DAZZLED, 0) if excluded else (StarTrackerStatus.GOOD, 1)
    assert (block.status, block.sample_count) == expected


@given(off, seeds, st.sampled_from(["sun", "moon"]))
def test_sun_and_moon_near_the_boresight(angle, seed, source):
    if abs(angle - 0.6) > 1e-9:
        assert_excluded(tracker(**{source: away(angle, seed), f"{source}_exclusion": 0.6}), angle < 0.6)
    assert_excluded(tracker(**{source: away(angle, seed)}), False)


@given(off, seeds)
def test_the_limb_near_the_boresight(angle, seed):
    disk = math.asin(RADIUS / DISTANCE)
    if abs(angle - 0.6) > 1e-9:
        assert_excluded(tracker(nadir=away(disk + angle - 0.6 + 0.3, seed), limb_exclusion=0.3), angle < 0.6)
    assert_excluded(tracker(nadir=away(angle, seed)), False)


def test_inputs_that_are_not_connected_exclude_nothing():
    """At any boresight: their starts are no direction."""
    limits = {"sun_exclusion": 3.0, "moon_exclusion": 3.0, "limb_exclusion": 1.5, "rate_limit": 1e-6}
    for axis in (*np.eye(3), *-np.eye(3)):
        block = StarInertial(boresight=axis.tolist(), **limits)
        block.initialize()
        assert_excluded(block, False)


def test_turning_fast():
    block = tracker(rate_limit=0.02)
    for rate, status, count in (
        ([0.0, 0.019, 0.0], StarTrackerStatus.GOOD, 2),
        ([0.015, 0.0, -0.015], StarTrackerStatus.TOO_FAST, 2),
        ([0.0, 0.0, 0.0], StarTrackerStatus.GOOD, 3),
    ):
        block.angular_velocity = rate
        block.step(0.0, 0.5)
        assert (block.status, block.sample_count) == (status, count)


@pytest.mark.parametrize("latency", range(5))
def test_a_sample_arrives_late_with_its_time(latency):
    """While the Sun is near, no sample: those before arrive, and the count waits ``latency`` samples after it."""
    block = StarInertial(latency=latency, sun_exclusion=0.5, attitude_sigma=0.0)
    block.sun_direction = [1.0, 0.0, 0.0]
    block.initialize()
    times = [0.0]
    for k in range(12):
        time = 0.5 * (k + 1)
        dazzled = 4 <= k < 7
        block.sun_direction = [0.0, 0.0, 1.0] if dazzled else [1.0, 0.0, 0.0]
        block.quaternion = Rotation.from_rotvec([0.1 * time, 0.0, 0.0]).as_quat(scalar_first=True).tolist()
        block.step(0.5 * k, 0.5)
        if not dazzled:
            times.append(time)
        assert block.status == (StarTrackerStatus.DAZZLED if dazzled else StarTrackerStatus.GOOD)
        arrived = [instant for instant in times if instant <= time - 0.5 * latency]
        assert block.sample_count == len(arrived)
        if arrived:
            assert block.sample_time == arrived[-1]
            rotation = Rotation.from_quat([*block.measured_quaternion], scalar_first=True).as_rotvec()
            assert rotation == pytest.approx([0.1 * arrived[-1], 0.0, 0.0], abs=1e-14)


def test_errors_about_the_boresight_and_across_it():
    block, errors = tracker(attitude_sigma=1e-4, roll_sigma=6e-4), []
    for k in range(800):
        block.step(0.5 * k, 0.5)
        measured = Rotation.from_quat([*block.measured_quaternion], scalar_first=True)
        errors.append((ATTITUDE.inv() * measured).as_rotvec())
    errors = np.array(errors)
    about = errors @ BORESIGHT / 3.0
    across = errors - np.outer(about, BORESIGHT / 3.0)
    for squares, sigma, freedom in ((about**2, 6e-4, 1), ((across**2).sum(axis=1), 1e-4, 2)):
        low, high = stats.chi2.interval(0.999, freedom * len(errors))
        assert low < squares.sum() / sigma**2 < high


def test_at_defaults_a_sample_is_the_attitude_after_a_small_rotation():
    """Bit by bit, from the same stream of numbers."""
    block, stream = StarInertial(attitude_sigma=1e-2, seed=3, stream=2), [0.0] * 6
    block.quaternion = ATTITUDE.as_quat(scalar_first=True).tolist()
    block.initialize()
    seed_streams(stream, 3, 2)
    for k in range(20):
        error = from_rotation_vector(1e-2 * normals(stream))
        assert [*block.measured_quaternion] == [*normalise(multiply(vector(*block.quaternion), error))]
        block.step(0.125 * k, 0.125)
