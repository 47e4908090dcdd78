"""Slews between attitudes and angular velocities within limits of rate, acceleration and jerk.

Truth: the limits, for random slews and boundary rates; the attitude integrated from the angular velocity; closed forms
of ramps about an axis; bounds by the slew without a jerk limit, which is faster, and by the polynomial, which is
slower.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.guidance.slew_bang_coast import SlewBangCoast
from perilune.fmus_src.guidance.slew_guidance import SlewPhase
from perilune.fmus_src.guidance.slew_jerk_limited import SlewJerkLimited, SlewStatus
from perilune.fmus_src.guidance.slew_quintic import SlewQuintic
from perilune.fmus_src.mathlib.jerk_limited import JerkLimits, plan_turn
from tests.support.lengths import either

SAMPLES = 60
seeds = st.integers(0, 2**32 - 1)
START = 5.0


def guidance(kind=SlewJerkLimited, turn=(0.7, -0.4, 1.1), start=(1.0, 0.0, 0.0, 0.0), **settings):
    """Return a guidance at its start, for a turn (a rotation vector) from an attitude."""
    first = Rotation.from_quat(start, scalar_first=True)
    block = kind(**{"slew_start": START, "rate_limit": 0.3, "acceleration_limit": 0.2, **settings})
    block.estimated_quaternion = list(map(float, start))
    block.target_quaternion = (first * Rotation.from_rotvec(turn)).as_quat(scalar_first=True).tolist()
    block.initialize()
    return block


def references(block, times, period):
    """Return attitudes, angular velocities and mean accelerations until a period later, at these times."""
    rows = []
    for time in times:
        block.refer(time, period)
        r = block.reference
        rows.append([*r.reference_quaternion, *r.reference_angular_velocity, *r.reference_angular_acceleration])
    rows = np.array(rows)
    return Rotation.from_quat(rows[:, :4], scalar_first=True), rows[:, 4:7], rows[:, 7:]


def random_turn(random):
    """Draw a guidance with random attitudes and limits; boundary rates are 0, along the eigenaxis, or in any
    direction."""
    rate, acceleration, jerk = 10.0 ** random.uniform(-2.0, 0.0, 3)
    axis, first, last = (v / np.linalg.norm(v) for v in random.normal(size=(3, 3)))
    size = rate * random.uniform(0.0, 1.0, 2)
    kind = random.integers(3)
    if kind == 0:
        size = 0.0 * size
    if kind == 1:
        first, last = axis, -axis
    settings = {"start_angular_velocity": (size[0] * first).tolist(), "end_angular_velocity": (size[1] * last).tolist()}
    limits = {"rate_limit": rate, "acceleration_limit": acceleration, "jerk_limit": jerk}
    start = random.normal(size=4)
    start = start / np.linalg.norm(start)
    # the turn is about the eigenaxis between the attitudes at its own start and end
    waiting = Rotation.from_rotvec(START * size[0] * first)
    turn = (waiting * Rotation.from_rotvec(random.uniform(0.01, math.pi) * axis)).as_rotvec()
    return guidance(turn=turn, start=start, **settings, **limits)


@pytest.mark.parametrize("batch", range(either(100, 1)))
def test_no_limit_is_exceeded(batch):
    """Over 100 random turns (10 000 in all of the long tests), sampled from before the start until after the end."""
    random = np.random.default_rng(batch)
    for _ in range(100):
        block = random_turn(random)
        assert block.status == SlewStatus.GOOD
        period = (block.duration + 1e-3) / SAMPLES
        times = START + period * np.arange(-2, SAMPLES + 3)
        _, rates, accelerations = references(block, times, period)
        jerks = np.diff(accelerations, axis=0) / period
        for rows, limit in (
            (rates, block.rate_limit),
            (accelerations, block.acceleration_limit),
            (jerks, block.jerk_limit),
        ):
            # differences of rates over a period carry their rounding
            assert np.linalg.norm(rows, axis=1).max() <= limit * (1.0 + 1e-9) + 1e-15 / period**2
        target = Rotation.from_quat(block.target_quaternion, scalar_first=True)
        block.proceed(START + block.duration)
        end = Rotation.from_quat(block.start_quaternion, scalar_first=True)
        assert (target.inv() * end).magnitude() < 2e-9
        np.testing.assert_allclose(rates[-1], block.end_angular_velocity, atol=1e-12)
        np.testing.assert_allclose(rates[0], block.start_angular_velocity, atol=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_angular_velocities_add_up_to_the_attitude(seed):
    """Rates of the middles of short steps lead from each attitude to the next, to third order of the step."""
    block = random_turn(np.random.default_rng(1000 + seed))
    step = (block.duration + 2.0) / 4000
    times = START - 1.0 + step * np.arange(4000)
    attitudes, _, _ = references(block, times, step)
    _, rates, _ = references(block, times[:-1] + 0.5 * step, step)
    gained = (attitudes[:-1].inv() * attitudes[1:]).as_rotvec()
    bound = step**3 * (block.jerk_limit + block.rate_limit * block.acceleration_limit) + 1e-14
    np.testing.assert_allclose(gained, step * rates, atol=bound)


@given(st.floats(1e-3, math.pi - 1e-3), st.floats(0.01, 1.0), st.floats(0.01, 1.0), st.floats(0.01, 10.0))
def test_between_the_other_slews(angle, rate, acceleration, jerk):
    """Slower than without a limit of jerk, which it tends to; faster than the polynomial with that of its own jerk."""
    limits = {"turn": [angle, 0.0, 0.0], "rate_limit": rate, "acceleration_limit": acceleration}
    fastest = guidance(SlewBangCoast, **limits).duration
    quintic = guidance(SlewQuintic, **limits).duration
    assert guidance(**limits, jerk_limit=jerk).duration > fastest
    assert guidance(**limits, jerk_limit=1e9).duration == pytest.approx(fastest, rel=1e-3)
    assert guidance(**limits, jerk_limit=60.0 * angle / quintic**3).duration < quintic


def test_rates_along_the_eigenaxis_save_time_and_others_cost_it():
    """From 0.1 rad/s to 0.2 rad/s by hand: ramps to the limit of 0.3 rad/s and back, and a coast."""
    axis = np.array([0.6, 0.0, 0.8])
    still = guidance(turn=2.5 * axis, jerk_limit=1.0, slew_start=0.0)
    along = guidance(
        turn=2.5 * axis,
        jerk_limit=1.0,
        slew_start=0.0,
        start_angular_velocity=0.1 * axis,
        end_angular_velocity=0.2 * axis,
    )
    ramps = 0.2 / 0.2 + 0.2 / 1.0, 0.1 / 0.2 + 0.2 / 1.0
    coast = (2.5 - 0.5 * (0.1 + 0.3) * ramps[0] - 0.5 * (0.3 + 0.2) * ramps[1]) / 0.3
    assert along.duration == pytest.approx(sum(ramps) + coast, rel=1e-12)
    assert along.duration < still.duration
    aside = guidance(turn=2.5 * axis, jerk_limit=1.0, slew_start=0.0, start_angular_velocity=[0.0, 0.1, 0.0])
    assert aside.stop.profile.duration == pytest.approx(0.1 / 0.2 + 0.2 / 1.0, rel=1e-12)
    assert aside.duration > still.duration


def test_against_a_fast_rate_it_goes_on_round():
    """The shorter way to -0.4 rad would stop first; at 1 rad/s and slow brakes 2 pi - 0.4 is sooner."""
    block = guidance(
        turn=[-0.4, 0.0, 0.0],
        slew_start=0.0,
        rate_limit=1.0,
        jerk_limit=0.2,
        start_angular_velocity=[1.0, 0.0, 0.0],
        end_angular_velocity=[1.0, 0.0, 0.0],
    )
    assert block.slew_angle == pytest.approx(2.0 * math.pi - 0.4, rel=1e-12)
    assert block.duration == pytest.approx(2.0 * math.pi - 0.4, rel=1e-12)


@pytest.mark.parametrize("velocity", ["start_angular_velocity", "end_angular_velocity"])
def test_a_boundary_rate_beyond_the_limit_has_no_plan(velocity):
    """The attitude is kept, at rest, and the status says so; at the limit there is a plan."""
    block = guidance(**{velocity: [0.0, 0.3001, 0.0]})
    assert block.status == SlewStatus.BEYOND_RATE_LIMIT
    attitudes, rates, accelerations = references(block, np.arange(0.0, 30.0, 0.5), 0.5)
    assert not rates.any()
    assert not accelerations.any()
    assert attitudes.magnitude().max() == 0.0
    assert guidance(**{velocity: [0.0, 0.3, 0.0]}).status == SlewStatus.GOOD


def test_no_turn_at_all():
    block = guidance(turn=[0.0, 0.0, 0.0])
    assert block.duration == block.slew_angle == 0.0
    assert block.reference.reference_quaternion == [1.0, 0.0, 0.0, 0.0]


def test_a_turn_without_an_angle_is_about_the_rate():
    """It stops where it is when the turn begins: past it and back, about the axis of the rate."""
    block = guidance(turn=[0.1 * START, 0.0, 0.0], start_angular_velocity=[0.1, 0.0, 0.0], jerk_limit=0.1)
    profile = plan_turn(0.0, 0.1, 0.0, JerkLimits(rate=0.3, acceleration=0.2, jerk=0.1))
    assert block.duration == pytest.approx(profile.duration, rel=1e-6)
    attitudes, rates, _ = references(block, np.linspace(0.0, START + block.duration, 50), 0.1)
    assert not rates[:, 1:].any()
    assert attitudes[-1].as_rotvec() == pytest.approx([0.1 * START, 0.0, 0.0], abs=1e-8)


def test_phases():
    block = guidance(slew_start=0.5)
    assert block.phase == SlewPhase.WAITING
    block.step(0.375, 0.125)
    assert block.phase == SlewPhase.SLEWING
    block.step(0.5 + block.duration, 0.125)
    assert block.phase == SlewPhase.HOLDING
