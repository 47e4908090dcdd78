"""`perilune.fmus_src.mathlib.lunar.terminal`: thrust acceleration linear in time that meets boundary conditions.

Truth: coasting motion by scipy's integrator and the six boundary conditions, solved by numpy as a linear system for a0
and a1 and integrated in closed form (numpy polynomials); times to go compared with `numpy.roots` of |A|^2 T^2 = 4 |B|^2
multiplied out from A(T) and B(T) as polynomials, with the integral of the squared thrust acceleration by Gauss-Legendre
quadrature, and with the printed test state. Tolerance 1e-9 relative unless a test states otherwise; printed numbers to
half a unit of their last digit.
"""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.polynomial import Polynomial
from scipy.integrate import solve_ivp

from perilune.fmus_src.mathlib.lunar import terminal
from perilune.fmus_src.mathlib.vectors import vector
from tests.support.flights.linear_thrust import GRAVITY, TARGET, UP, states_of_the_box
from tests.support.flights.terminal_guidance import box
from tests.support.lengths import either

ZERO = [0.0, 0.0, 0.0]


def on_sequences(function):
    """Return a kernel function that takes any sequences for its vectors."""
    return lambda *arguments: function(*[vector(*each) if np.ndim(each) else each for each in arguments])


cubic_time = on_sequences(terminal.cubic_time)
effort_rises = on_sequences(terminal.effort_rises)
impulse_and_miss = on_sequences(terminal.impulse_and_miss)
least_effort_time = on_sequences(terminal.least_effort_time)
linear_thrust = on_sequences(terminal.linear_thrust)
quadratic_time = on_sequences(terminal.quadratic_time)
keeps_direction = on_sequences(terminal.keeps_direction)
arrivals = st.lists(st.integers(-20000, 20000).map(lambda number: number / 1000.0), min_size=3, max_size=3)
# Starts anywhere around a target at rest, at most as fast as a lunar orbit.
places = st.lists(st.integers(-20000, 20000).map(float), min_size=3, max_size=3)
speeds = st.lists(st.integers(-1700, 1700).map(float), min_size=3, max_size=3)


def impulse(dr, v, dv, time, g=GRAVITY):
    a, b = impulse_and_miss(dr, v, dv, g, time)
    return np.array(a), np.array(b)


def polynomials(dr, v, dv, g=GRAVITY):
    """Return A and B, component by component, as polynomials of time-to-go."""
    impulses = [Polynomial([dv[i], g * UP[i]]) for i in range(3)]
    misses = [Polynomial([dr[i], -v[i], 0.5 * g * UP[i]]) for i in range(3)]
    return impulses, misses


def condition(dr, v, dv, g=GRAVITY):
    """Return |A|^2 T^2 - 4 |B|^2 multiplied out; its highest coefficient vanishes."""
    impulses, misses = polynomials(dr, v, dv, g)
    time = Polynomial([0.0, 1.0])
    return sum((a * a * time * time for a in impulses), Polynomial([0.0])) - 4.0 * sum(
        (b * b for b in misses), Polynomial([0.0])
    )


def roots_of(coefficients):
    """Return real roots by numpy, each improved by one step of Newton's method."""
    actual = np.roots(np.asarray(coefficients)[::-1])
    real = actual[abs(actual.imag) < 1e-6 * abs(actual)].real
    whole = Polynomial(coefficients)
    return real - whole(real) / whole.deriv()(real)


@given(box, st.floats(1.0, 300.0))
@settings(max_examples=either(25, 8), deadline=None)
def test_impulse_and_miss_are_those_of_coasting(state, time):
    position, velocity = state
    coast = solve_ivp(
        lambda _, y: [*y[3:], 0.0, 0.0, -GRAVITY], (0.0, time), [*position, *velocity], rtol=1e-12, atol=1e-9
    ).y[:, -1]
    a, b = impulse(TARGET - position, velocity, -velocity, time)
    assert a == pytest.approx(-coast[3:], abs=1e-7)
    assert b == pytest.approx(TARGET - coast[:3], abs=1e-4)


@given(box, st.floats(20.0, 400.0), arrivals)
@settings(max_examples=either(100, 8), deadline=None)
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
@settings(max_examples=either(200, 16), deadline=None)
def test_quadratic_time_is_the_positive_root_without_the_cubic_term(state):
    position, velocity = state
    dr = TARGET - position
    coefficients = condition(dr, velocity, -velocity).coef
    positive = [root for root in roots_of(coefficients[:3]) if root > 0.0]
    actual = quadratic_time(dr.tolist(), velocity.tolist(), (-velocity).tolist(), GRAVITY)
    assert min(abs(actual - root) for root in positive) < 1e-9 * actual


def falling_roots(dr, v, dv, g=GRAVITY):
    """Return positive roots of |A|^2 T^2 - 4 |B|^2 at which it falls, and how steep it is at the flattest root."""
    whole = Polynomial(condition(dr, v, dv, g).coef[:4])
    roots = roots_of(np.trim_zeros(whole.coef, "b"))
    steepness = abs(roots * whole.deriv()(roots)) / Polynomial(abs(whole.coef))(abs(roots))
    return sorted(root for root in roots if root > 0.0 and whole.deriv()(root) < 0.0), min(steepness, default=1.0)


@given(box, arrivals)
@settings(max_examples=either(200, 16), deadline=None)
def test_cubic_time_is_a_root_of_the_full_condition(state, arrival):
    position, velocity = state
    dr, dv = TARGET - position, np.array(arrival) - velocity
    assert abs(condition(dr, velocity, dv).coef[4:]).max(initial=0.0) < 1e-9
    actual = cubic_time(dr.tolist(), velocity.tolist(), dv.tolist(), GRAVITY)
    assert actual == pytest.approx(falling_roots(dr, velocity, dv)[0][0], rel=1e-12)
    a, b = impulse(dr, velocity, dv, actual)
    assert np.linalg.norm(a) * actual == pytest.approx(2.0 * np.linalg.norm(b), rel=1e-9)
    assert a @ b > 0.0


@given(places, speeds, st.sampled_from([GRAVITY, 0.0, 25.0]))
@settings(max_examples=either(500, 41), deadline=None)
def test_cubic_time_of_any_start_is_the_root_where_the_condition_falls(place, speed, g):
    dr, v = np.array(place), np.array(speed)
    assume(dr.any())
    falling, steepness = falling_roots(dr, v, -v, g)
    assume(steepness > 1e-6)  # roots that almost coincide may be there or not
    actual = cubic_time(place, speed, (-v).tolist(), g)
    assert actual == pytest.approx(falling[0] if falling else 0.0, rel=1e-9)
    if actual > 0.0:
        a, b = impulse(dr, v, -v, actual, g)
        assert keeps_direction(place, speed, (-v).tolist(), g, actual) == (a @ b > 0.0)


def test_cubic_time_is_the_root_that_newton_reaches_from_the_quadratic_one_all_over_the_box():
    """100 000 states (20 000 in `make test`): the published branch, with its cubic term."""
    states = states_of_the_box(either(100_000, 20_000), 12)
    position, velocity = (np.array(part) for part in zip(*states, strict=True))
    dr = TARGET - position
    c3 = 2.0 * GRAVITY * velocity[:, 2]
    c2 = -3.0 * (velocity**2).sum(1) - 4.0 * GRAVITY * dr[:, 2]
    c1, c0 = 8.0 * (dr * velocity).sum(1), -4.0 * (dr**2).sum(1)
    time = (-c1 - np.sqrt(c1**2 - 4.0 * c2 * c0)) / (2.0 * c2)
    for _ in range(20):
        time = time - (((c3 * time + c2) * time + c1) * time + c0) / ((3.0 * c3 * time + 2.0 * c2) * time + c1)
    rows = zip(dr.tolist(), velocity.tolist(), (-velocity).tolist(), strict=True)
    actual = np.array([cubic_time(*row, GRAVITY) for row in rows])
    assert actual == pytest.approx(time, rel=1e-12)


@pytest.mark.parametrize(
    ("dr", "v"),
    [
        ([0.0, 0.0, -500.0], ZERO),  # hovering above
        ([0.0, 0.0, 500.0], ZERO),  # below
        ([-2000.0, 0.0, 0.0], ZERO),  # to the side
        ([0.0, 0.0, -500.0], [0.0, 0.0, 5.0]),  # receding upwards
        ([1000.0, 0.0, -500.0], [-300.0, 0.0, 0.0]),  # receding sideways
        (ZERO, ZERO),
        (ZERO, [10.0, 0.0, 0.0]),
    ],
)
def test_no_cubic_time_for_starts_that_do_not_approach(dr, v):
    assert cubic_time(dr, v, [-value for value in v], GRAVITY) == 0.0


@given(box, st.floats(0.01, 100.0), st.floats(0.1, 10.0))
@settings(max_examples=either(100, 8), deadline=None)
def test_times_scale_with_length_and_time(state, length, duration):
    """Units of length and time stretched: times-to-go stretch with the unit of time."""
    position, velocity = state
    dr = TARGET - position
    speed = length / duration
    plain = (dr.tolist(), velocity.tolist(), (-velocity).tolist())
    scaled = ((length * dr).tolist(), (speed * velocity).tolist(), (-speed * velocity).tolist())
    g = GRAVITY * length / duration**2
    assert quadratic_time(*scaled, g) == pytest.approx(duration * quadratic_time(*plain, GRAVITY), rel=1e-10)
    assert cubic_time(*scaled, g) == pytest.approx(duration * cubic_time(*plain, GRAVITY), rel=1e-10)
    assert least_effort_time(*scaled, g) == pytest.approx(duration * least_effort_time(*plain, GRAVITY), rel=1e-10)


def test_times_of_the_printed_test_state():
    velocity = [-950.0 * math.cos(0.05), 0.0, -950.0 * math.sin(0.05)]
    arguments = ([-1e5, 0.0, -8500.0], velocity, [-value for value in velocity])
    assert quadratic_time(*arguments, GRAVITY) == pytest.approx(217.578132, abs=5e-7)
    assert cubic_time(*arguments, GRAVITY) == pytest.approx(213.645917, abs=5e-7)


def test_without_gravity_straight_braking_takes_twice_the_mean_time():
    """On a line, |V| T = 2 |D - V T| has the roots 2 D/V and 2 D/(3 V): the formula takes the longer one."""
    arguments = ([-1000.0, 0.0, 0.0], [-10.0, 0.0, 0.0], [10.0, 0.0, 0.0])
    assert quadratic_time(*arguments, 0.0) == pytest.approx(200.0, rel=1e-12)
    assert cubic_time(*arguments, 0.0) == pytest.approx(200.0, rel=1e-12)


def test_no_time_where_there_is_no_motion():
    assert quadratic_time(ZERO, ZERO, ZERO, GRAVITY) == 0.0
    assert cubic_time(ZERO, ZERO, ZERO, GRAVITY) == 0.0
    assert least_effort_time(ZERO, ZERO, ZERO, GRAVITY) == 0.0


# ---- least effort --------------------------------------------------------------------------------------------


def linear_acceleration(dr, v, dv, time, g=GRAVITY):
    a, b = impulse(dr, v, dv, time, g)
    conditions = np.array([[time, time**2 / 2.0], [time**2 / 2.0, time**3 / 6.0]])
    return np.linalg.solve(conditions, np.array([a, b]))


def effort(dr, v, dv, time, g=GRAVITY):
    """Return integral of |a0 + a1 t|^2 over the flight; three points are exact."""
    a0, a1 = linear_acceleration(dr, v, dv, time, g)
    points, weights = np.polynomial.legendre.leggauss(3)
    moments = 0.5 * time * (points + 1.0)
    return sum(
        0.5 * time * weight * np.sum((a0 + a1 * moment) ** 2) for weight, moment in zip(weights, moments, strict=True)
    )


@given(places, speeds, arrivals)
@settings(max_examples=either(200, 16), deadline=None)
def test_least_effort_time_is_the_first_minimum_of_the_effort(place, speed, arrival):
    dr, v = np.array(place), np.array(speed)
    assume(np.linalg.norm(dr) > 1.0)
    dv = np.array(arrival) - v
    time = least_effort_time(place, speed, dv.tolist(), GRAVITY)
    assert time > 0.0
    shorter = time * np.geomspace(0.01, 0.999, 60)
    efforts = [effort(dr, v, dv, value) for value in [*shorter, time]]
    assert np.all(np.diff(efforts) < 1e-9 * np.array(efforts[1:]))
    assert effort(dr, v, dv, 1.001 * time) > efforts[-1] * (1.0 - 1e-9)
    arguments = (place, speed, dv.tolist(), GRAVITY)
    assert not effort_rises(*arguments, 0.999 * time)


@pytest.mark.parametrize("height", [1e-3, 1.0, 500.0, 2e4])
@pytest.mark.parametrize("direction", [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.6, -0.8, 0.0]])
def test_least_effort_time_of_hovering_starts(height, direction):
    """At rest J = g^2 T + 12 h^2/T^3, least where g T^2 = 6 h."""
    dr = [height * value for value in direction]
    assert least_effort_time(dr, ZERO, ZERO, GRAVITY) == pytest.approx(math.sqrt(6.0 * height / GRAVITY), rel=1e-12)


def test_least_effort_without_gravity_has_no_time_at_rest():
    assert least_effort_time([0.0, 0.0, -500.0], ZERO, ZERO, 0.0) == 0.0


@given(box, st.floats(0.0, 1.0))
@settings(max_examples=either(100, 8), deadline=None)
def test_linear_thrust_is_the_mean_and_the_turn_of_the_linear_acceleration(state, share):
    position, velocity = state
    arguments = (TARGET - position, velocity, -velocity)
    time = cubic_time(*[value.tolist() for value in arguments], GRAVITY)
    a0, a1 = linear_acceleration(*arguments, time)
    a, b = impulse(*arguments, time)
    thrust = linear_thrust(a, b, time, share * time, ZERO, ZERO)
    assert thrust.size == pytest.approx(np.linalg.norm(a0 + 0.5 * share * time * a1), rel=1e-9)
    assert thrust.direction == pytest.approx(a0 / np.linalg.norm(a0), abs=1e-12)
    step = 1e-3
    after, before = a0 + step * a1, a0 - step * a1
    turn = (after / np.linalg.norm(after) - before / np.linalg.norm(before)) / (2.0 * step)
    assert thrust.rate == pytest.approx(turn, abs=1e-10)


def test_linear_thrust_that_begins_at_zero_points_where_it_grows_to():
    """A T = 3 B, with exact numbers: a0 = 0."""
    a, b, held, turning = [0.0, 0.0, 3.0], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0], [9.0, 9.0, 9.0]
    thrust = linear_thrust(a, b, 2.0, 1.0, held, turning)
    assert thrust.size == pytest.approx(0.75)
    assert (thrust.direction, thrust.rate) == ([0.0, 0.0, 1.0], ZERO)
    still = linear_thrust(a, b, 2.0, 0.0, held, turning)  # no thrust at all
    assert (still.size, still.direction, still.rate) == (0.0, held, turning)
