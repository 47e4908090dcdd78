"""gravity_correction: laws for constant gravity in a central field.

Truth: gravity linear in time between vehicle and target, integrated as numpy polynomials, with which the commanded
thrust must meet all six end conditions; a field of so large a radius that gravity is constant; and descents in the
central field by a separately written Runge-Kutta integration, from 1689 m/s nearly horizontally at 18.148 km towards
the site.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from perilune.fmus_src.guidance.analytic_exact import AnalyticExactGuidance
from perilune.fmus_src.guidance.astar import AstarGuidance
from tests.support.flights.linear_thrust import GRAVITY, POSITION, VELOCITY, states_of_the_box
from tests.support.flights.terminal_guidance import (
    ALL,
    EXACT,
    GOOD,
    NOT_CONVERGED,
    command_of,
    commanded,
    rootless_state,
    see,
)
from tests.support.lengths import either

RADIUS = 1.7374e6
MU = 4.9028e12
CENTRE = np.array([0.0, 0.0, -RADIUS])
SITE = np.array([0.0, 0.0, 1500.0])  # 1500 m above the landing site
EXHAUST_SPEED = 319.0 * 9.80665
STEP = 0.1


def central(position):
    """Return gravity (m/s2), landing-site frame."""
    from_centre = position - CENTRE
    return -MU * from_centre / np.linalg.norm(from_centre) ** 3


def braking_start(ground_range):
    """Return position and velocity, ``ground_range`` (m) before the site; 1.6 rad from the vertical."""
    angle = ground_range / RADIUS
    up = np.array([math.sin(angle), 0.0, math.cos(angle)])
    forward = np.array([-math.cos(angle), 0.0, math.sin(angle)])
    position = (RADIUS + 18148.0) * up + CENTRE
    return position, 1689.0 * (math.cos(1.6) * up + math.sin(1.6) * forward)


def burn(state, time, duration, guidance):
    """Return the state ``duration`` (s) later, by one classic Runge-Kutta step."""

    def slope(moment, y):
        along = np.array(guidance.thrust_direction)
        along = along + np.array(guidance.thrust_direction_rate) * (moment - guidance.command_time)
        thrust = guidance.thrust_acceleration * along / np.linalg.norm(along)
        return np.concatenate([y[3:], thrust + central(y[:3])])

    k1 = slope(time, state)
    k2 = slope(time + duration / 2.0, state + duration / 2.0 * k1)
    k3 = slope(time + duration / 2.0, state + duration / 2.0 * k2)
    k4 = slope(time + duration, state + duration * k3)
    return state + duration / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)


def fly(guidance_class, position, velocity, **parameters):
    """Return miss (m), speed (m/s) at the end, largest thrust acceleration (m/s2), propellant of 940 kg (kg)."""
    guidance = commanded(guidance_class, position, velocity, target_position=SITE.tolist(), **parameters)
    state = np.concatenate([position, velocity])
    gained = largest = 0.0
    for k in range(6000):
        time = STEP * k
        left = min(STEP, guidance.command_time + guidance.burn_duration - time)
        if guidance.finished or left <= 0.0:
            break
        largest = max(largest, guidance.thrust_acceleration)
        gained += guidance.thrust_acceleration * left
        state = burn(state, time, left, guidance)
        if left < STEP:
            break
        see(guidance, state[:3], state[3:])
        guidance.step(time, STEP)
    else:
        raise AssertionError("the flight does not end")
    propellant = 940.0 * (1.0 - math.exp(-gained / EXHAUST_SPEED))
    return np.linalg.norm(state[:3] - SITE), np.linalg.norm(state[3:]), largest, propellant


# ---- commands ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("guidance_class", EXACT)
@pytest.mark.parametrize("ground_range", [150e3, 265e3, 300e3])
def test_thrust_meets_the_end_conditions_in_gravity_linear_in_time(guidance_class, ground_range):
    """And |A| T = 2 |B| with A and B in that gravity: time-to-go agrees with the time it was corrected over."""
    position, velocity = braking_start(ground_range)
    guidance = commanded(
        guidance_class, position, velocity, target_position=SITE.tolist(), gravity_correction=True, moon_radius=RADIUS
    )
    time = guidance.time_to_go
    assert guidance.expected_time == pytest.approx(time, rel=1e-9)
    here, there = central(position), central(SITE)
    pulls = [Polynomial([here[i], (there[i] - here[i]) / time]) for i in range(3)]
    gain = -velocity - [pull.integ(1)(time) for pull in pulls]
    way = SITE - position - velocity * time - [pull.integ(2)(time) for pull in pulls]
    assert np.linalg.norm(gain) * time == pytest.approx(2.0 * np.linalg.norm(way), rel=1e-8)
    conditions = np.array([[time, time**2 / 2.0], [time**2 / 2.0, time**3 / 6.0]])
    a0, a1 = np.linalg.solve(conditions, np.array([gain, way]))
    size = np.linalg.norm(a0)
    assert guidance.thrust_direction == pytest.approx(a0 / size, abs=1e-8)
    if guidance_class is AnalyticExactGuidance:
        assert guidance.thrust_acceleration == pytest.approx(np.linalg.norm(gain) / time, rel=1e-8)
        assert guidance.thrust_direction_rate == pytest.approx((a1 - (a1 @ a0) * a0 / size**2) / size, abs=1e-10)
    else:
        assert guidance.thrust_acceleration == pytest.approx(size, rel=1e-8)


@pytest.mark.parametrize("guidance_class", EXACT)
def test_the_constant_gravity_assumed_drops_out(guidance_class):
    """It is subtracted and added; the time that thrust of least effort takes would differ."""
    position, velocity = braking_start(265e3)
    commands = [
        command_of(
            commanded(
                guidance_class,
                position,
                velocity,
                target_position=SITE.tolist(),
                gravity_correction=True,
                gravity=gravity,
            )
        )
        for gravity in (0.5, 1.62, 2.0)
    ]
    assert commands[0] == pytest.approx(commands[1], rel=1e-7, abs=1e-9)
    assert commands[2] == pytest.approx(commands[1], rel=1e-7, abs=1e-9)


@pytest.mark.parametrize("guidance_class", ALL)
def test_in_a_field_so_large_that_it_is_constant_nothing_changes(guidance_class):
    radius = 1e13
    for position, velocity in states_of_the_box(either(20, 8), 16):
        plain = commanded(guidance_class, position, velocity)
        other = commanded(
            guidance_class,
            position,
            velocity,
            gravity_correction=True,
            moon_radius=radius,
            gravitational_parameter=1.62 * radius**2,
        )
        assert other.status == plain.status
        if plain.status == GOOD and plain.thrust_direction[0] > 0.1:
            assert command_of(other) == pytest.approx(command_of(plain), rel=1e-5, abs=1e-8)


@pytest.mark.parametrize("guidance_class", ALL)
@given(radius=st.floats(1.0, 1e7), parameter=st.floats(0.0, 1e14))
@settings(max_examples=either(20, 10), deadline=None)
def test_without_the_correction_the_field_does_not_matter(guidance_class, radius, parameter):
    plain = commanded(guidance_class)
    other = commanded(guidance_class, moon_radius=radius, gravitational_parameter=parameter)
    for guidance in (plain, other):
        guidance.step(0.0, 0.5)
    assert command_of(other) == command_of(plain)
    assert other.time_to_go == plain.time_to_go


# ---- states --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("guidance_class", ALL)
def test_a_cycle_later_the_correction_is_over_a_cycle_less(guidance_class):
    guidance = commanded(guidance_class, gravity_correction=True)
    time = guidance.time_to_go
    guidance.step(0.0, 0.5)
    assert guidance.expected_time == pytest.approx(time - 0.5, rel=1e-9)


def test_while_a_command_is_held_the_time_corrected_over_counts_down():
    guidance = commanded(AstarGuidance, gravity_correction=True)
    time, held = guidance.time_to_go, command_of(guidance)
    see(guidance, *rootless_state())
    for k in range(1, 6):
        guidance.step(0.5 * (k - 1), 0.5)
        assert guidance.status == NOT_CONVERGED
        assert command_of(guidance) == held
        assert guidance.expected_time == pytest.approx(time - 0.5 * k, rel=1e-9)
    see(guidance, POSITION, VELOCITY)
    guidance.step(2.5, 0.5)
    assert guidance.status == GOOD
    assert guidance.expected_time == pytest.approx(time - 3.0, rel=1e-9)


def test_a_start_without_solution_is_corrected_from_its_first_command_on():
    guidance = commanded(AstarGuidance, *rootless_state(), gravity_correction=True)
    assert guidance.status == NOT_CONVERGED
    assert guidance.thrust_acceleration == 0.0
    assert guidance.time_to_go == 0.0
    see(guidance, POSITION, VELOCITY)
    guidance.step(0.0, 0.5)
    fresh = commanded(AstarGuidance, gravity_correction=True)
    assert guidance.status == GOOD
    assert guidance.time_to_go == pytest.approx(fresh.time_to_go, rel=1e-8)
    assert command_of(guidance) == pytest.approx(command_of(fresh), rel=1e-6)


@pytest.mark.parametrize("guidance_class", EXACT)
def test_the_last_burn_is_timed_from_the_corrected_time(guidance_class):
    guidance = commanded(guidance_class, gravity_correction=True)
    assert guidance.burn_duration == guidance.time_to_go
    cycle = 0.4 * guidance.time_to_go
    guidance.step(0.0, cycle)
    assert guidance.burn_duration > 1e6
    guidance.step(cycle, 2.0 * cycle)
    assert guidance.burn_duration == guidance.time_to_go
    left = guidance.time_to_go - 2.0 * cycle
    guidance.step(3.0 * cycle, 2.0 * cycle)
    assert guidance.time_to_go == pytest.approx(left, rel=1e-9)


# ---- flights -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("ground_range", either([256e3, 300e3], [256e3]))
def test_exact_analytic_flights_arrive_with_and_without_and_need_less_thrust_with(ground_range):
    """About 0.15 m/s2 less at most, for 0.2 to 0.6 kg more propellant: the flight takes 3 to 5 s longer."""
    start = braking_start(ground_range)
    plain = fly(AnalyticExactGuidance, *start)
    corrected = fly(AnalyticExactGuidance, *start, gravity_correction=True)
    for miss, speed, _, _ in (plain, corrected):
        assert miss < 1e-3
        assert speed < 1e-3
    assert 4.8 < corrected[2] < plain[2] < 5.9
    assert plain[2] - corrected[2] == pytest.approx(0.165, abs=0.03)
    assert corrected[3] - plain[3] == pytest.approx(0.4, abs=0.2)
    assert 940.0 - plain[3] == pytest.approx(535.0, abs=2.0)


@pytest.mark.parametrize("guidance_class", ALL)
@pytest.mark.parametrize("correction", [False, True])
def test_all_laws_arrive(guidance_class, correction):
    """Laws that stop miss by less than a cycle of thrust."""
    miss, speed, largest, _ = fly(guidance_class, *braking_start(265e3), gravity_correction=correction)
    exact = guidance_class in EXACT
    assert miss < (1e-3 if exact else 0.5 * largest * STEP**2)
    assert speed < (1e-3 if exact else largest * STEP)


@pytest.mark.parametrize("guidance_class", EXACT)
def test_a_hover_transfer_arrives(guidance_class):
    miss, speed, _, _ = fly(guidance_class, SITE + np.array([2e4, 0.0, 500.0]), np.zeros(3), gravity_correction=True)
    assert miss < 1e-3
    assert speed < 1e-3


def test_the_correction_takes_the_error_of_the_model_away():
    """With gravity linear in time for model the programme hardly changes on the way; with constant gravity it does."""
    position, velocity = braking_start(265e3)
    spreads = []
    for correction in (False, True):
        guidance = commanded(
            AnalyticExactGuidance, position, velocity, target_position=SITE.tolist(), gravity_correction=correction
        )
        ends = [guidance.time_to_go]
        state = np.concatenate([position, velocity])
        for k in range(2000):
            state = burn(state, STEP * k, STEP, guidance)
            see(guidance, state[:3], state[3:])
            guidance.step(STEP * k, STEP)
            ends.append(STEP * (k + 1) + guidance.time_to_go)
        spreads.append(max(ends) - min(ends))
    assert spreads[1] < 0.5 * spreads[0]


def test_target_elsewhere_than_above_the_site():
    """The target's gravity is that of its own place."""
    target = [5e4, -3e4, 1000.0]
    position, velocity = braking_start(300e3)
    guidance = commanded(AnalyticExactGuidance, position, velocity, target_position=target, gravity_correction=True)
    dr, dv = guidance.remaining()
    time, here, there = guidance.expected_time, central(position), central(np.array(target))
    assumed = np.array([0.0, 0.0, -GRAVITY])
    assert dv == pytest.approx(-velocity - time * ((here + there) / 2.0 - assumed), rel=1e-12)
    way = np.array(target) - position - time**2 * (here / 3.0 + there / 6.0 - assumed / 2.0)
    assert dr == pytest.approx(way, rel=1e-12)
