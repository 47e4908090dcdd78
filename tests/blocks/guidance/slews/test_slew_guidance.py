"""Slews: shortest time within limits, continuity, the shorter direction of rotation, and torque in steps.

Truth: closed forms of both profiles; scipy's rotations; integrals of the outputs.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.guidance.slew_bang_coast import SlewBangCoast
from perilune.fmus_src.guidance.slew_guidance import SlewPhase
from perilune.fmus_src.guidance.slew_quintic import SlewQuintic
from perilune.fmus_src.guidance.slew_step import SlewStep

STEP = 0.125
PROFILES = (SlewBangCoast, SlewQuintic)
seeds = st.integers(0, 2**32 - 1)


def guidance(kind, turn, start=(1.0, 0.0, 0.0, 0.0), **settings):
    """Return a guidance at its start, for a turn (a rotation vector) from an attitude."""
    first = Rotation.from_quat(start, scalar_first=True)
    settings = {"slew_start": 0.5, "rate_limit": 0.3, "acceleration_limit": 0.2} | settings
    block = kind(**settings)
    block.estimated_quaternion = list(map(float, start))
    block.target_quaternion = (first * Rotation.from_rotvec(turn)).as_quat(scalar_first=True).tolist()
    block.initialize()
    return block


def follow(block, seconds, step=STEP):
    """Return quaternions, rates and accelerations at every sample, the one of the start first."""
    rows = []
    for n in range(round(seconds / step)):
        r = block.reference
        rows.append([*r.reference_quaternion, *r.reference_angular_velocity, *r.reference_angular_acceleration])
        block.step(n * step, step)
    rows = np.array(rows)
    return rows[:, :4], rows[:, 4:7], rows[:, 7:]


@given(st.floats(1e-6, math.pi), st.floats(1e-3, 1.0), st.floats(1e-3, 1.0))
def test_bang_coast_is_as_long_as_its_limits_make_it(angle, rate, acceleration):
    """a/w + w/u, or 2 sqrt(a/u) where the rate is not reached."""
    block = guidance(SlewBangCoast, [angle, 0.0, 0.0], rate_limit=rate, acceleration_limit=acceleration)
    expected = angle / rate + rate / acceleration
    if angle < rate * rate / acceleration:
        expected = 2.0 * math.sqrt(angle / acceleration)
    assert block.duration == pytest.approx(expected, rel=1e-9)


@given(st.floats(1e-6, math.pi), st.floats(1e-3, 1.0), st.floats(1e-3, 1.0))
def test_quintic_is_as_long_as_its_limits_make_it(angle, rate, acceleration):
    """Largest rate 15/8 a/T, largest acceleration 10/sqrt(3) a/T^2."""
    block = guidance(SlewQuintic, [0.0, angle, 0.0], rate_limit=rate, acceleration_limit=acceleration)
    expected = max(15.0 / 8.0 * angle / rate, math.sqrt(10.0 / math.sqrt(3.0) * angle / acceleration))
    assert block.duration == pytest.approx(expected, rel=1e-9)


@given(seeds, st.sampled_from(PROFILES))
def test_the_reference_is_a_turn_about_one_axis_within_its_limits(seed, kind):
    random = np.random.default_rng(seed)
    turn = random.uniform(0.05, 3.1) * (axis := random.normal(size=3)) / np.linalg.norm(axis)
    start = random.normal(size=4)
    start /= np.linalg.norm(start)
    block = guidance(kind, turn, start)
    quaternions, rates, accelerations = follow(block, 0.5 + block.duration + 1.0)
    first = Rotation.from_quat(start, scalar_first=True)
    rotations = (first.inv() * Rotation.from_quat(quaternions, scalar_first=True)).as_rotvec()
    for rows in (rotations, rates, accelerations):
        np.testing.assert_allclose(np.cross(rows, turn), 0.0, atol=1e-12)
    assert np.linalg.norm(rates, axis=1).max() <= 0.3 * (1.0 + 1e-12)
    assert np.linalg.norm(accelerations, axis=1).max() <= 0.2 * (1.0 + 1e-9)
    np.testing.assert_allclose(rotations[[0, -1]], [0.0 * turn, turn], atol=1e-12)
    np.testing.assert_allclose(rates[[0, -1]], 0.0, atol=1e-15)


@given(seeds, st.sampled_from(PROFILES))
def test_accelerations_in_steps_meet_the_rates(seed, kind):
    turn = np.random.default_rng(seed).uniform(-1.5, 1.5, 3)
    block = guidance(kind, turn)
    _, rates, accelerations = follow(block, 0.5 + block.duration + 1.0)
    np.testing.assert_allclose(rates[1:], np.cumsum(STEP * accelerations, axis=0)[:-1], atol=1e-12)


@pytest.mark.parametrize("kind", PROFILES)
def test_rates_add_up_to_the_angle(kind):
    """By the trapezoidal rule on fine steps."""
    block = guidance(kind, [0.0, 0.0, 1.2], sample_period=0.001)
    _, rates, _ = follow(block, 0.5 + block.duration + 0.1, 0.001)
    assert np.trapezoid(rates[:, 2], dx=0.001) == pytest.approx(1.2, rel=1e-6)


@pytest.mark.parametrize("kind", [*PROFILES, SlewStep])
def test_phases(kind):
    block = guidance(kind, [0.7, 0.0, 0.0])
    assert block.phase == SlewPhase.WAITING
    follow(block, 0.375)
    assert block.phase == SlewPhase.WAITING
    follow_from(block, 0.375, 0.5)
    expected = SlewPhase.HOLDING if kind is SlewStep else SlewPhase.SLEWING
    assert block.phase == expected
    follow_from(block, 0.5, 0.625 + block.duration)
    assert block.phase == SlewPhase.HOLDING


def follow_from(block, begin, end):
    for n in range(round(begin / STEP), math.ceil(end / STEP)):
        block.step(n * STEP, STEP)


@pytest.mark.parametrize("kind", [*PROFILES, SlewStep])
def test_no_turn_at_all(kind):
    block = guidance(kind, [0.0, 0.0, 0.0])
    quaternions, rates, accelerations = follow(block, 2.0)
    assert block.duration == block.slew_angle == 0.0
    assert (quaternions == [1.0, 0.0, 0.0, 0.0]).all()
    assert not rates.any()
    assert not accelerations.any()


@given(seeds, st.sampled_from([-1.0, -3.0, 2.0]))
def test_the_shorter_way_whatever_the_sign_and_length_of_the_target(seed, factor):
    turn = np.random.default_rng(seed).uniform(-3.0, 3.0, 3)
    block = guidance(SlewBangCoast, turn)
    block.target_quaternion = [factor * element for element in block.target_quaternion]
    block.initialize()
    assert block.slew_angle == pytest.approx(Rotation.from_rotvec(turn).magnitude(), rel=1e-12)
    assert block.slew_angle <= math.pi


def test_the_quintic_starts_and_ends_gently():
    """Its acceleration grows with the time from either end, that of the other profile is there at once."""
    largest = {}
    for kind in PROFILES:
        block = guidance(kind, [2.0, 0.0, 0.0], slew_start=0.0)
        _, _, accelerations = follow(block, 1.0)
        largest[kind] = accelerations[0, 0]
    assert largest[SlewBangCoast] == pytest.approx(0.2)
    duration = 15.0 / 8.0 * 2.0 / 0.3
    assert largest[SlewQuintic] == pytest.approx(60.0 * 2.0 / duration**3 * 0.5 * STEP, rel=0.05)
