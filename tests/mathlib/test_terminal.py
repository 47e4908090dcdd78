"""Thrust linear in time: `fmus_src.mathlib.terminal` against the boundary conditions it must meet.

Truth: coasting motion by scipy's integrator and the six boundary conditions, solved by numpy as a linear
system for a0 and a1 and integrated in closed form (numpy polynomials); the times-to-go against
`numpy.roots` of |A|^2 T^2 = 4 |B|^2 multiplied out from A(T) and B(T) as polynomials, and against the
printed test state. Tolerance 1e-9 relative unless a test says otherwise; printed figures to half a unit
of their last digit.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import Polynomial
from scipy.integrate import solve_ivp

from fmus_src.mathlib.terminal import cubic_time, impulse_and_miss, quadratic_time

GRAVITY = 1.62
TARGET = np.array([0.0, 0.0, 2000.0])
UP = np.array([0.0, 0.0, 1.0])


def declared_state(fractions):
    """A state of the published box from six numbers in [0, 1]."""
    u = list(fractions)
    ground = 0.95e5 + 1e4 * u[0]
    azimuth = -math.pi / 4 + math.pi / 2 * u[1]
    height = 0.95e4 + 2e3 * u[2]
    speed = 940.0 + 20.0 * u[3]
    climb = -math.atan2(height, ground) * u[4]
    course = azimuth + math.pi + math.pi / 18 * (2.0 * u[5] - 1.0)
    position = np.array([ground * math.cos(azimuth), ground * math.sin(azimuth), height])
    velocity = speed * np.array(
        [math.cos(climb) * math.cos(course), math.cos(climb) * math.sin(course), math.sin(climb)]
    )
    return position, velocity


millionths = st.integers(0, 10**6).map(lambda number: number / 10**6)
box = st.lists(millionths, min_size=6, max_size=6).map(declared_state)
arrivals = st.lists(st.integers(-20000, 20000).map(lambda number: number / 1000.0), min_size=3, max_size=3)


def impulse(dr, v, dv, time, g=GRAVITY):
    a, b = [0.0] * 3, [0.0] * 3
    impulse_and_miss(list(dr), list(v), list(dv), g, time, a, b)
    return np.array(a), np.array(b)


def polynomials(dr, v, dv, g=GRAVITY):
    """A and B, component by component, as polynomials of time-to-go."""
    impulses = [Polynomial([dv[i], g * UP[i]]) for i in range(3)]
    misses = [Polynomial([dr[i], -v[i], 0.5 * g * UP[i]]) for i in range(3)]
    return impulses, misses


def condition(dr, v, dv, g=GRAVITY):
    """|A|^2 T^2 - 4 |B|^2 multiplied out; its highest coefficient vanishes."""
    impulses, misses = polynomials(dr, v, dv, g)
    time = Polynomial([0.0, 1.0])
    return sum((a * a * time * time for a in impulses), Polynomial([0.0])) - 4.0 * sum(
        (b * b for b in misses), Polynomial([0.0])
    )


def roots_of(coefficients):
    """Real roots by numpy, each improved by one step of Newton's method."""
    found = np.roots(np.asarray(coefficients)[::-1])
    real = found[abs(found.imag) < 1e-6 * abs(found)].real
    whole = Polynomial(coefficients)
    return real - whole(real) / whole.deriv()(real)


@given(box, st.floats(1.0, 300.0))
@settings(max_examples=25, deadline=None)
def test_impulse_and_miss_are_those_of_coasting(state, time):
    position, velocity = state
    coast = solve_ivp(
        lambda _, y: [*y[3:], 0.0, 0.0, -GRAVITY], (0.0, time), [*position, *velocity], rtol=1e-12, atol=1e-9
    ).y[:, -1]
    a, b = impulse(TARGET - position, velocity, -velocity, time)
    assert a == pytest.approx(-coast[3:], abs=1e-7)
    assert b == pytest.approx(TARGET - coast[:3], abs=1e-4)


@given(box, st.floats(20.0, 400.0), arrivals)
@settings(max_examples=100, deadline=None)
def test_linear_acceleration_meets_all_six_boundary_conditions(state, time, arrival):
    position, velocity = state
    arrival_velocity = np.array(arrival)
    a, b = impulse(TARGET - position, velocity, arrival_velocity - velocity, time)
    a0 = -(2.0 / time**2) * (a * time - 3.0 * b)
    a1 = (6.0 / time**3) * (a * time - 2.0 * b)
    for i in range(3):
        acceleration = Polynomial([a0[i] - GRAVITY * UP[i], a1[i]])
        speed = acceleration.integ(k=[velocity[i]])
        place = speed.integ(k=[position[i]])
        assert speed(time) == pytest.approx(arrival_velocity[i], abs=1e-8)
        assert place(time) == pytest.approx(TARGET[i], abs=1e-6)
    conditions = np.array([[time, time**2 / 2.0], [time**2 / 2.0, time**3 / 6.0]])
    gain = arrival_velocity - velocity + GRAVITY * time * UP
    way = TARGET - position - velocity * time + GRAVITY * time**2 / 2.0 * UP
    solved = np.linalg.solve(conditions, np.array([gain, way]))
    assert a0 == pytest.approx(solved[0], abs=1e-9)
    assert a1 == pytest.approx(solved[1], abs=1e-10)


@given(box)
@settings(max_examples=200, deadline=None)
def test_quadratic_time_is_the_positive_root_without_the_cubic_term(state):
    position, velocity = state
    dr = TARGET - position
    coefficients = condition(dr, velocity, -velocity).coef
    positive = [root for root in roots_of(coefficients[:3]) if root > 0.0]
    found = quadratic_time(dr.tolist(), velocity.tolist(), (-velocity).tolist(), GRAVITY)
    assert min(abs(found - root) for root in positive) < 1e-9 * found


@given(box, arrivals)
@settings(max_examples=200, deadline=None)
def test_cubic_time_is_a_root_of_the_full_condition(state, arrival):
    position, velocity = state
    arrival_velocity = np.array(arrival)
    dr, dv = TARGET - position, arrival_velocity - velocity
    full = condition(dr, velocity, dv)
    coefficients = full.coef
    assert abs(coefficients[4:]).max(initial=0.0) < 1e-9
    found = cubic_time(dr.tolist(), velocity.tolist(), dv.tolist(), arrival, GRAVITY)
    positive = [root for root in roots_of(coefficients[:4]) if root > 0.0]
    assert found == pytest.approx(min(positive, key=lambda root: abs(root - found)), rel=1e-9)
    a, b = impulse(dr, velocity, dv, found)
    assert np.linalg.norm(a) * found == pytest.approx(2.0 * np.linalg.norm(b), rel=1e-9)


@given(box)
@settings(max_examples=100, deadline=None)
def test_cubic_time_is_the_root_nearest_to_the_quadratic_one(state):
    """The shortest flight that brakes: no other positive root lies nearer to the quadratic one."""
    position, velocity = state
    dr = (TARGET - position).tolist()
    arguments = (dr, velocity.tolist(), (-velocity).tolist())
    start = quadratic_time(*arguments, GRAVITY)
    positive = [root for root in roots_of(condition(*map(np.array, arguments)).coef[:4]) if root > 0.0]
    nearest = min(positive, key=lambda root: abs(root - start))
    assert cubic_time(*arguments, [0.0] * 3, GRAVITY) == pytest.approx(nearest, rel=1e-9)


@given(box, st.floats(0.01, 100.0), st.floats(0.1, 10.0))
@settings(max_examples=100, deadline=None)
def test_times_scale_with_length_and_time(state, length, duration):
    """Units of length and time stretched: times-to-go stretch with the unit of time."""
    position, velocity = state
    dr = TARGET - position
    speed = length / duration
    plain = (dr.tolist(), velocity.tolist(), (-velocity).tolist())
    scaled = ((length * dr).tolist(), (speed * velocity).tolist(), (-speed * velocity).tolist())
    g = GRAVITY * length / duration**2
    assert quadratic_time(*scaled, g) == pytest.approx(duration * quadratic_time(*plain, GRAVITY), rel=1e-10)
    assert cubic_time(*scaled, [0.0] * 3, g) == pytest.approx(
        duration * cubic_time(*plain, [0.0] * 3, GRAVITY), rel=1e-10
    )


def test_times_of_the_printed_test_state():
    velocity = [-950.0 * math.cos(0.05), 0.0, -950.0 * math.sin(0.05)]
    arguments = ([-1e5, 0.0, -8500.0], velocity, [-value for value in velocity])
    assert quadratic_time(*arguments, GRAVITY) == pytest.approx(217.578132, abs=5e-7)
    assert cubic_time(*arguments, [0.0] * 3, GRAVITY) == pytest.approx(213.645917, abs=5e-7)


def test_without_gravity_straight_braking_takes_twice_the_mean_time():
    """On a line, |V| T = 2 |D - V T| has the roots 2 D/V and 2 D/(3 V): the formula takes the longer one."""
    arguments = ([-1000.0, 0.0, 0.0], [-10.0, 0.0, 0.0], [10.0, 0.0, 0.0])
    assert quadratic_time(*arguments, 0.0) == pytest.approx(200.0, rel=1e-12)
    assert cubic_time(*arguments, [0.0] * 3, 0.0) == pytest.approx(200.0, rel=1e-12)


def test_no_time_where_there_is_no_motion():
    zero = [0.0, 0.0, 0.0]
    assert quadratic_time(zero, zero, zero, GRAVITY) == 0.0
    assert cubic_time(zero, zero, zero, zero, GRAVITY) == 0.0
