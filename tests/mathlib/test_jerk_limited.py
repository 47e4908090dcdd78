"""`perilune.fmus_src.mathlib.jerk_limited`: profiles of least time within limits of rate, acceleration and jerk.

Truth: seven arcs of constant jerk in closed form; linear programmes over 120 arcs (HiGHS), for which the rotation is
infeasible in less time and extreme in this time; polynomials, which are slower within their own limits.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial
from scipy.optimize import linprog

from perilune.fmus_src.mathlib.jerk_limited import JerkLimits, follow_profile, plan_axis, plan_ramp, plan_turn
from tests.support.lengths import either

ARCS = 120
LIMITS = st.builds(JerkLimits, rate=st.floats(0.01, 2.0), acceleration=st.floats(0.01, 2.0), jerk=st.floats(0.01, 2.0))
FRACTIONS = st.floats(-1.0, 1.0)
ANGLES = st.floats(-8.0, 8.0)
QUINTIC = Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
WITHOUT_JERK_AT_THE_END = Polynomial([0.0, 0.0, 0.0, 20.0, -45.0, 36.0, -10.0])


def motions(profile, count=400):
    """Return times, and angle, rate and acceleration at each of them."""
    times = np.linspace(0.0, profile.duration, count)
    return times, np.array([follow_profile(profile, time).elements() for time in times])


def seven_arcs(angle, limits):
    """Return least time from rest to rest, by which of the limits are reached."""
    w, a, j = limits.rate, limits.acceleration, limits.jerk
    if w * j >= a * a:
        if angle >= w * (w / a + a / j):
            return angle / w + w / a + a / j
        if angle >= 2.0 * a**3 / j**2:
            return a / j + math.sqrt((a / j) ** 2 + 4.0 * angle / a)
    elif angle >= 2.0 * w * math.sqrt(w / j):
        return angle / w + 2.0 * math.sqrt(w / j)
    return 4.0 * (angle / (2.0 * j)) ** (1.0 / 3.0)


@given(st.floats(1e-6, 8.0), LIMITS)
def test_without_boundary_rates_it_takes_as_long_as_seven_arcs(angle, limits):
    for signed in (angle, -angle):
        assert plan_axis(signed, 0.0, 0.0, limits).duration == pytest.approx(seven_arcs(angle, limits), rel=1e-9)


def extreme_angles(duration, first, last, limits):
    """Return smallest and largest angle in a time, between rates and within limits; None where there is no such
    motion."""
    h, one = duration / ARCS, np.eye(ARCS)
    before = np.eye(ARCS, k=-1)
    acceleration = h * np.tril(np.ones((ARCS, ARCS)))
    rate = np.cumsum(h * before @ acceleration + 0.5 * h * h * one, axis=0)
    angle = np.cumsum(h * before @ rate + 0.5 * h * h * before @ acceleration + h**3 / 6.0 * one, axis=0)
    a, w = acceleration * (limits.jerk / limits.acceleration), rate * (limits.jerk / limits.rate)
    room = np.ones(ARCS)
    bounds = [room, room, (1.0 - first / limits.rate) * room, (1.0 + first / limits.rate) * room]
    ends = []
    for sign in (1.0, -1.0):
        solution = linprog(
            sign * limits.jerk * angle[-1],
            A_ub=np.vstack([a, -a, w, -w]),
            b_ub=np.concatenate(bounds),
            A_eq=np.vstack([a[-1], w[-1]]),
            b_eq=[0.0, (last - first) / limits.rate],
            bounds=(-1.0, 1.0),
        )
        if solution.status == 2:
            return None
        assert solution.status == 0, solution.message
        ends.append(sign * solution.fun + first * duration)
    return ends


@pytest.mark.parametrize("seed", range(either(200, 4)))
def test_no_motion_about_the_axis_is_faster(seed):
    """In less time the angle is outside of what linear programmes reach; in that time it is the last they reach."""
    random = np.random.default_rng(seed)
    rate, acceleration, jerk = 10.0 ** random.uniform(-2.0, 0.3, 3)
    limits = JerkLimits(rate=rate, acceleration=acceleration, jerk=jerk)
    first, last = limits.rate * random.uniform(-1.0, 1.0, 2)
    angle = random.uniform(-7.0, 7.0)
    profile = plan_axis(angle, first, last, limits)
    for fraction in (0.4, 0.8, 0.97):
        ends = extreme_angles(fraction * profile.duration, first, last, limits)
        assert ends is None or not ends[0] <= angle <= ends[1]
    smallest, largest = extreme_angles(profile.duration, first, last, limits)
    # the programmes' jerk changes at multiples of their arcs only
    assert min(abs(angle - smallest), abs(angle - largest)) < 5.0 / ARCS * limits.rate * profile.duration


@given(ANGLES, FRACTIONS, FRACTIONS, LIMITS)
def test_limits_and_ends(angle, first, last, limits):
    profile = plan_axis(angle, first * limits.rate, last * limits.rate, limits)
    times, motion = motions(profile)
    scale = limits.rate * profile.duration + abs(angle)
    assert np.abs(motion[:, 1]).max() <= limits.rate * (1.0 + 1e-12)
    assert np.abs(motion[:, 2]).max() <= limits.acceleration * (1.0 + 1e-12)
    assert np.abs(np.diff(motion[:, 2])).max() <= limits.jerk * np.diff(times).max() * (1.0 + 1e-9) + 1e-12
    assert motion[0] == pytest.approx([0.0, first * limits.rate, 0.0], abs=1e-11 * (1.0 + scale))
    assert motion[-1] == pytest.approx([angle, last * limits.rate, 0.0], abs=1e-11 * (1.0 + scale))
    # errors of the trapezoidal rule: of a rate with a limited second derivative, of an acceleration with bends
    step = times[1]
    gained = 0.5 * step * (motion[1:, 1:] + motion[:-1, 1:])
    error = np.abs(np.diff(motion[:, :2], axis=0) - gained).max(axis=0)
    assert error[0] <= step**3 / 12.0 * limits.jerk + 1e-11 * (1.0 + scale)
    assert error[1] <= step**2 / 4.0 * limits.jerk + 1e-11 * (1.0 + scale)


@given(FRACTIONS, FRACTIONS, LIMITS)
def test_the_angle_of_the_direct_ramp_needs_nothing_else(first, last, limits):
    ramp = plan_ramp(first * limits.rate, last * limits.rate, limits)
    assert plan_axis(ramp.angle, ramp.first_rate, ramp.last_rate, limits) == ramp


@given(ANGLES, FRACTIONS, FRACTIONS, LIMITS)
def test_of_all_whole_turns_the_fastest(angle, first, last, limits):
    first, last = first * limits.rate, last * limits.rate
    direct = plan_ramp(first, last, limits).angle
    turns = round((direct - angle) / (2.0 * math.pi)) + np.arange(-4, 5)
    durations = [plan_axis(angle + 2.0 * math.pi * k, first, last, limits).duration for k in turns]
    assert plan_turn(angle, first, last, limits).duration == pytest.approx(min(durations), rel=1e-6)


@pytest.mark.parametrize(("polynomial", "fraction"), [(QUINTIC, 0.9543), (WITHOUT_JERK_AT_THE_END, 0.8050)])
@pytest.mark.parametrize("angle", [0.01, 2.2246, 6.0])
def test_a_polynomial_is_slower_within_its_own_limits(polynomial, fraction, angle):
    """Its largest rate, acceleration and jerk over 100 s, by search."""
    s = np.linspace(0.0, 1.0, 10001)
    rate, acceleration, jerk = (angle * np.abs(polynomial.deriv(k)(s)).max() / 100.0**k for k in (1, 2, 3))
    limits = JerkLimits(rate=rate, acceleration=acceleration, jerk=jerk)
    duration = plan_axis(angle, 0.0, 0.0, limits).duration
    assert duration == pytest.approx(seven_arcs(angle, limits), rel=1e-12)
    assert duration == pytest.approx(100.0 * fraction, abs=0.01)
