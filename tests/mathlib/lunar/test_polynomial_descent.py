"""Polynomial descent: profiles of `polynomial_descent` meet the conditions at both ends.

Truth: the profile as the solution of its boundary conditions by numpy, integrated by DOP853 with gravity linear in
time; the classic laws written out (ZEM/ZEV, constant acceleration, Klumpp's quartic); roots by numpy. Printed numbers
are from a separate program.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from perilune.fmus_src.mathlib.lunar import polynomial_descent
from perilune.fmus_src.mathlib.lunar.polynomial_descent import DescentShape
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.descent.laws import A1, C1, C2, HIGH
from tests.support.descent.polynomial_laws import UP, Leg, central

TIMES = {"C1": (C1, 200.0), "C2": (C2, 300.0), "A1": (A1, 60.0)}
PRINTED = [  # gamma, kr, final thrust acceleration, start, thrust acceleration
    (1.0, 6.0, (0.0, 0.0, 0.0), "C1", (4.009731143654703, 0.0, 0.5865450657706721)),
    (1.0, 6.0, (0.0, 0.0, 0.0), "C2", (4.808602005546344, 0.0, -0.94896966759962)),
    (1.0, 6.0, (0.0, 0.0, 0.0), "A1", (1.0011181535528728, -0.5008386151646544, 0.620670395425804)),
    (1.0, 12.0, (0.0, 0.0, 2.0), "C1", (-1.5727216534255497, 0.0, -0.0005690375465188247)),
    (1.0, 12.0, (0.0, 0.0, 2.0), "C2", (-1.7989817482230634, 0.0, -1.706599211270989)),
    (1.0, 12.0, (0.0, 0.0, 2.0), "A1", (0.5011181535528735, -0.0008386151646542217, -1.0033614869819378)),
    (1.0, 9.0, (0.5, -0.25, 2.0), "C1", (1.4685047451145756, -0.125, 0.29298801411207664)),
    (1.0, 9.0, (0.5, -0.25, 2.0), "C2", (1.7548101286616387, -0.125, -1.3277844394353036)),
    (1.0, 9.0, (0.5, -0.25, 2.0), "A1", (1.0011181535528726, -0.37583861516465467, -0.19134554577806673)),
    (0.5, 7.0, (0.0, 0.0, 2.0), "C1", (2.919452611795746, 0.0, 0.5024650623996758)),
    (0.5, 7.0, (0.0, 0.0, 2.0), "C2", (3.5170682839295164, 0.0, -1.038718922812711)),
    (0.5, 7.0, (0.0, 0.0, 2.0), "A1", (0.8927661843269914, -0.4008246382452434, 0.3459200437272878)),
]
positions = st.lists(st.floats(-2e4, 2e4), min_size=3, max_size=3).map(np.array)
speeds = st.lists(st.floats(-1500.0, 1500.0), min_size=3, max_size=3).map(np.array)
finals = st.lists(st.floats(-5.0, 5.0), min_size=3, max_size=3).map(np.array)
times = st.floats(5.0, 400.0)


def arguments(leg, time):
    way, gain = leg.errors(time)
    return vector(*way), vector(*leg.velocity), vector(*gain), leg.gravity, time


def feedback(leg, time, gamma, kr, final):
    shape = DescentShape(final=vector(*final), gamma=gamma, kr=kr)
    return np.array(polynomial_descent.feedback(*arguments(leg, time), shape))


def profile(leg, time, gamma, kr, final):
    shape = DescentShape(final=vector(*final), gamma=gamma, kr=kr)
    assert polynomial_descent.is_regular(shape)
    return polynomial_descent.descent_profile(*arguments(leg, time), shape)


def thrust(flown, s):
    return np.array(polynomial_descent.thrust_at(flown, s))


@pytest.mark.parametrize(("gamma", "kr", "final", "start", "expected"), PRINTED)
def test_the_feedback_law_is_the_printed_one(gamma, kr, final, start, expected):
    leg, time = TIMES[start]
    actual = feedback(leg, time, gamma, kr, final)
    assert np.linalg.norm(actual - expected) < 1e-12 * np.linalg.norm(expected) + 1e-13


@given(
    position=positions,
    speed=speeds,
    final=finals,
    time=times,
    shape=st.sampled_from([(1, 6), (1, 12), (0.5, 7), (2, 16)]),
)
@settings(deadline=None)
def test_feedback_is_the_profile_of_both_ends(position, speed, final, time, shape):
    """The profile solves the boundary conditions, which numpy does with a matrix; the law is its start."""
    if shape == (2, 16):  # both exponents are 2
        return
    leg = Leg(position, speed, HIGH)
    whole = (*map(float, shape), final)
    flown = profile(leg, time, *whole)
    expected = leg.thrust(time, whole, np.array([1.0, 0.6, 0.25, 0.0]))
    size = 1.0 + np.max(np.abs(expected))
    for s, row in zip((1.0, 0.6, 0.25, 0.0), expected, strict=True):
        assert thrust(flown, s) == pytest.approx(row, abs=1e-10 * size)
    assert feedback(leg, time, *whole) == pytest.approx(expected[0], abs=1e-10 * size)


@pytest.mark.parametrize("shape", [(1.0, 6.0), (1.0, 9.5), (1.0, 12.0), (0.5, 7.0), (0.0, 4.5)])
@pytest.mark.parametrize("start", TIMES)
def test_the_profile_flown_arrives_at_rest(start, shape):
    """By DOP853 in gravity that is linear in time from the start's to the target's."""
    leg, time = TIMES[start]
    flown = profile(leg, time, *shape, (0.3, -0.2, 2.0))
    here, there = central(leg.position), central(leg.target)

    def motion(t, state):
        gravity = here + (there - here) * t / time
        return np.concatenate([state[3:], thrust(flown, 1.0 - t / time) + gravity])

    start_state = np.concatenate([leg.position, leg.velocity])
    path = solve_ivp(motion, (0.0, time), start_state, method="DOP853", rtol=1e-11, atol=1e-7)
    assert path.y[:3, -1] == pytest.approx(leg.target, abs=1e-3)
    assert path.y[3:, -1] == pytest.approx(np.zeros(3), abs=1e-5)


def test_positions_of_the_profile_are_those_of_constant_gravity():
    leg, time = Leg(A1.position, A1.velocity, A1.target, round_moon=False), 60.0
    flown = profile(leg, time, 0.5, 7.0, (0.0, 0.0, 2.0))
    path = solve_ivp(
        lambda t, state: np.concatenate([state[3:], thrust(flown, 1.0 - t / time) - leg.gravity * UP]),
        (0.0, time),
        np.concatenate([leg.position, leg.velocity]),
        method="DOP853",
        rtol=1e-11,
        atol=1e-8,
        t_eval=[0.0, 20.0, 45.0],
    )
    for t, position in zip(path.t, path.y[:3].T, strict=True):
        offset = polynomial_descent.offset_at(flown, vector(0.0, 0.0, 0.0), leg.gravity, time, 1.0 - t / time)
        assert np.array(offset) == pytest.approx(position - leg.target, abs=1e-5)


@given(position=positions, speed=speeds, final=finals, time=times)
@settings(deadline=None)
def test_the_classic_laws_are_special_cases(position, speed, final, time):
    leg = Leg(position, speed, HIGH)
    way, gain = leg.errors(time)
    down = -leg.gravity * UP
    miss, change = way - speed * time - 0.5 * down * time**2, gain - down * time
    expected = 6.0 / time**2 * miss - 2.0 / time * change
    size = 1.0 + np.linalg.norm(expected) + np.linalg.norm(speed) / time
    assert feedback(leg, time, 1.0, 6.0, final) == pytest.approx(expected, abs=1e-11 * size)
    expected = final + 12.0 / time**2 * way - 6.0 / time * (2.0 * speed + gain)
    size += np.linalg.norm(way) / time**2
    assert feedback(leg, time, 1.0, 12.0, final) == pytest.approx(expected, abs=1e-11 * size)
    expected = 2.0 / time**2 * (way - speed * time) - down
    assert feedback(leg, time, 0.0, 2.0, final) == pytest.approx(expected, abs=1e-11 * size)


@given(speed=speeds, acceleration=finals, time=times, gamma=st.floats(0.0, 3.0), kr=st.floats(1.0, 30.0))
def test_where_a_constant_acceleration_arrives_every_law_is_that(speed, acceleration, time, gamma, kr):
    way = speed * time + 0.5 * acceleration * time**2
    leg = Leg(-way, speed, np.zeros(3), round_moon=False)
    thrust_acceleration = acceleration + leg.gravity * UP
    dr, v, dv = vector(*way), vector(*speed), vector(*(acceleration * time))
    shape = DescentShape(final=vector(*thrust_acceleration), gamma=gamma, kr=kr)
    actual = np.array(polynomial_descent.feedback(dr, v, dv, leg.gravity, time, shape))
    assert actual == pytest.approx(thrust_acceleration, abs=1e-11 * (1.0 + kr) * (10.0 + np.linalg.norm(speed) / time))


@pytest.mark.parametrize(("gamma", "kr"), [(-0.1, 6.0), (1.0, 5.9), (1.0, 9.0), (2.0, 16.0)])
def test_shapes_without_a_profile(gamma, kr):
    """A negative exponent, or two equal ones: the conditions' matrix is singular."""
    assert not polynomial_descent.is_regular(DescentShape(final=vector(0.0, 0.0, 0.0), gamma=gamma, kr=kr))


@pytest.mark.parametrize(("leg", "seed", "printed"), [(C1, 195.0, 192.52401661214432), (C2, 300.0, 297.8123304167862)])
def test_the_time_of_a_jerk_is_the_root_of_klumpp_s_cubic(leg, seed, printed):
    """The quartic about the target has this jerk along the forward axis; the cubic by numpy."""
    way, gain = leg.errors(seed)
    forward = np.array([-1.0, 0.0, 0.0])
    constant = np.array([5.0, 0.0, 2.2 - leg.gravity])
    actual = polynomial_descent.jerk_time(*arguments(leg, seed)[:3], vector(*constant), vector(*forward), 0.029, seed)
    arrival = leg.velocity + gain
    cubic = [0.029, 6.0 * constant @ forward, (18.0 * arrival + 6.0 * leg.velocity) @ forward, 24.0 * way @ forward]
    roots = np.roots(cubic)
    assert np.min(np.abs(roots + actual)) < 1e-7
    assert actual == pytest.approx(printed, abs=1e-8)
    # the quartic: position, velocity, acceleration and jerk at the target, snap from the position now
    t = -actual
    x = -way @ forward
    v_end, a_end = arrival @ forward, constant @ forward
    snap = (x - v_end * t - a_end * t**2 / 2.0 - 0.029 * t**3 / 6.0) * 24.0 / t**4
    velocity = v_end + a_end * t + 0.029 * t**2 / 2.0 + snap * t**3 / 6.0
    assert velocity == pytest.approx(leg.velocity @ forward, rel=1e-8)


@pytest.mark.parametrize("jerk", [-0.5, -0.2])
def test_a_jerk_without_a_time(jerk):
    """A jerk of the wrong sign: the only real root of the cubic is after the target."""
    way, gain = C1.errors(200.0)
    forward = np.array([-1.0, 0.0, 0.0])
    constant = np.array([5.0, 0.0, 2.2 - C1.gravity])
    time = polynomial_descent.jerk_time(*arguments(C1, 200.0)[:3], vector(*constant), vector(*forward), jerk, 200.0)
    arrival = C1.velocity + gain
    cubic = [jerk, 6.0 * constant @ forward, (18.0 * arrival + 6.0 * C1.velocity) @ forward, 24.0 * way @ forward]
    roots = np.roots(cubic)
    assert not any(abs(root.imag) < 1e-9 and root.real < 0.0 for root in roots)
    assert time == 0.0
