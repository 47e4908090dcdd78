"""`perilune.fmus_src.mathlib.hover.transfer_polynomial`: transfers of degree 7 and their thrust.

Truth: scipy's BPoly from the derivatives at both ends, which determine it; its differences and quadrature; the closed
form 140 s^3 (1 - s)^3 of a transfer from rest to rest; the rocket equation.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.interpolate import BPoly
from scipy.optimize import minimize_scalar

from perilune.fmus_src.kernel.records import replace
from perilune.fmus_src.mathlib.hover.transfer_polynomial import (
    FIRST,
    GROWTH,
    TRIALS,
    TransferLimits,
    capture,
    expense,
    slow_duration,
    thrust_along,
    transfer,
    transfer_acceleration,
    transfer_jerk,
    transfer_position,
    transfer_snap,
    transfer_velocity,
)
from perilune.fmus_src.mathlib.vectors import vector

triples = st.lists(st.floats(-100.0, 100.0), min_size=3, max_size=3)
durations = st.floats(5.0, 200.0)
LIFT = vector(0.1, -0.05, 1.6)
LIMITS = TransferLimits.of_elements([0.9 * 5099.0, 0.1 * 5099.0, math.radians(0.7), 319.0 * 9.80665])


DERIVATIVES = (transfer_position, transfer_velocity, transfer_acceleration, transfer_jerk, transfer_snap)


def make_transfer(start, goal, duration):
    """Return the transfer, and scipy's polynomial."""
    c = transfer(*(vector(*v) for v in start), vector(*goal), duration)
    ends = [list(map(np.array, start)), [np.array(goal), np.zeros(3), np.zeros(3), np.zeros(3)]]
    return c, BPoly.from_derivatives([0.0, duration], ends)


@given(triples, triples, triples, triples, triples, durations, st.floats(0.0, 1.0))
def test_position_and_derivatives(place, speed, acceleration, jerk, goal, duration, s):
    c, truth = make_transfer([place, speed, acceleration, jerk], goal, duration)
    scale = 1.0 + max(abs(x) for x in c.elements())
    for order, derivative in enumerate(DERIVATIVES):
        expected = (truth.derivative(order) if order else truth)(s * duration)
        unit = scale / duration**order
        assert derivative(c, s * duration, duration) == pytest.approx(expected, abs=1e-9 * unit)


START = [[-500.0, 300.0, 2800.0], [-100.0, 5.0, -20.0], [2.0, 0.1, 1.0], [0.02, -0.03, -0.01]]
GOAL = [-1500.0, 100.0, 2400.0]


@pytest.mark.parametrize("t", [0.0, 3.0, 17.0, 40.0])
def test_thrust_its_direction_and_rates(t):
    c, truth = make_transfer(START, GOAL, 40.0)

    def direction(time):
        f = truth.derivative(2)(time) + np.array(LIFT)
        return f / np.linalg.norm(f)

    thrust = thrust_along(c, t, 40.0, LIFT)
    h = 1e-3
    points = [direction(t + k * h) for k in (-2, -1, 0, 1, 2)]
    assert thrust.size == pytest.approx(np.linalg.norm(truth.derivative(2)(t) + np.array(LIFT)), rel=1e-12)
    assert thrust.direction == pytest.approx(points[2], abs=1e-12)
    slope = (points[0] - 8.0 * points[1] + 8.0 * points[3] - points[4]) / (12.0 * h)
    curve = (-points[0] + 16.0 * points[1] - 30.0 * points[2] + 16.0 * points[3] - points[4]) / (12.0 * h * h)
    assert thrust.rate == pytest.approx(slope, abs=1e-9)
    assert thrust.bend == pytest.approx(curve, abs=1e-6)


def test_no_thrust_points_up():
    c = transfer(*[vector(0.0, 0.0, 0.0)] * 5, 10.0)
    thrust = thrust_along(c, 5.0, 10.0, vector(0.0, 0.0, 0.0))
    assert (thrust.size, thrust.direction) == (0.0, (0.0, 0.0, 1.0))
    c = replace(c, c2=vector(0.0, 0.0, -0.5 * 1.6 * 100.0))  # falls freely at the start
    thrust = thrust_along(c, 0.0, 10.0, vector(0.0, 0.0, 1.6))
    assert (thrust.size, thrust.direction, thrust.rate) == (0.0, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0))


@given(st.floats(1.0, 1e4), st.floats(0.1, 100.0), st.floats(0.01, 5.0))
def test_slow_duration_keeps_speed_and_acceleration(way, speed, acceleration):
    duration = slow_duration(way, speed, acceleration)
    fastest = way / duration * 140.0 / 64.0
    peak = minimize_scalar(lambda s: -420.0 * s**2 * (1 - s) ** 2 * (1 - 2 * s), bounds=(0.0, 0.5), method="bounded")
    hardest = -peak.fun * way / duration**2
    assert duration >= 10.0
    assert fastest <= speed * (1.0 + 1e-9)
    assert hardest <= acceleration * (1.0 + 1e-4)
    at_limit = [fastest == pytest.approx(speed), hardest == pytest.approx(acceleration, rel=1e-4), duration == 10.0]
    assert any(at_limit)


def excess_by_hand(truth, duration, mass):
    """Return integral of thrust over mass, and the largest excess on a fine grid, by scipy and numpy."""
    up = np.array(LIFT)

    def push(t):
        return float(np.linalg.norm(truth.derivative(2)(t) + up))

    times = np.linspace(0.0, duration, 41)
    spent = solve_ivp(lambda t, _: [push(t)], (0.0, duration), [0.0], t_eval=times, rtol=1e-9, atol=1e-9).y[0]
    actual = 0.0
    for k, t in enumerate(times):
        force = mass * math.exp(-spent[k] / LIMITS.exhaust_speed) * push(t)
        actual = max(actual, force / LIMITS.maximum_thrust - 1.0, 1.0 - force / LIMITS.minimum_thrust)
        if k:
            f, df, ddf = (truth.derivative(n)(t) for n in (2, 3, 4))
            d, a = (f + up) / push(t), push(t)
            swing = np.cross(d, ddf / a - 2.0 * (df @ d) / a * (df / a - (df @ d) / a * d))
            actual = max(actual, np.linalg.norm(swing) / LIMITS.angular_acceleration - 1.0)
    return spent[-1], actual


@pytest.mark.parametrize("duration", [15.0, 40.0, 120.0])
def test_expense(duration):
    c, truth = make_transfer(START, GOAL, duration)
    actual = expense(c, duration, LIFT, 560.0, LIMITS, math.inf)
    expected, worst = excess_by_hand(truth, duration, 560.0)
    assert actual.impulse == pytest.approx(expected, rel=2e-3)
    assert actual.excess == pytest.approx(worst, abs=3e-3 * (1.0 + worst))


def test_capture_is_the_cheapest_of_all_durations():
    start = [vector(*v) for v in START]
    flown = capture(*start, vector(*GOAL), LIFT, 560.0, LIMITS)
    duration, price = flown.duration, flown.expense.impulse + 1000.0 * flown.expense.excess
    prices = {}
    for k in range(TRIALS):
        trial = FIRST * GROWTH**k
        expected, worst = (
            excess_by_hand(make_transfer(START, GOAL, trial)[1], trial, 560.0) if k % 10 == 0 else (None, None)
        )
        other = transfer(*start, vector(*GOAL), trial)
        actual = expense(other, trial, LIFT, 560.0, LIMITS, math.inf)
        prices[trial] = actual.impulse + 1000.0 * actual.excess
        if expected is not None:
            assert price <= (expected + 1000.0 * worst) * 1.01
    best = min(prices, key=prices.__getitem__)
    assert duration == pytest.approx(best, rel=1e-12)
    assert price == pytest.approx(prices[best], rel=1e-12)
    assert transfer_position(flown.transfer, duration, duration) == pytest.approx(GOAL, abs=1e-9)
    assert transfer_jerk(flown.transfer, 0.0, duration) == pytest.approx(START[3], abs=1e-12)


@pytest.mark.parametrize("bad", [math.nan, math.inf, 1e200])
def test_no_capture(bad):
    start = [vector(bad, 0.0, 0.0), *(vector(*v) for v in START[1:])]
    assert capture(*start, vector(*GOAL), LIFT, 560.0, LIMITS).duration == 0.0
