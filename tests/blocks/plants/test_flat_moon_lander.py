"""Lander over a flat Moon, compared with closed forms and an adaptive integrator.

Truth: parabolas under constant thrust, motion in two pieces when thrust ends inside a step, and scipy's DOP853 at 1e-13
relative for a turning thrust direction. Tolerance 1e-12 relative against closed forms, 1e-11 against DOP853; the fourth
order of the integrator is measured, and results may depend on the communication steps by no more than 1e-12 relative.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from perilune.fmus_src.plants.flat_moon_lander import FlatMoonLander
from tests.support.lengths import either

GRAVITY = 1.62
MASS = 940.0
START = [1.0e5, -2.0e4, 1.05e4]
SPEED = [-930.0, 180.0, -40.0]
UP = np.array([0.0, 0.0, 1.0])
THRUST = 4500.0
DIRECTION = [0.8, -0.36, 0.48]
TURNING = [-0.0036, -0.0048, 0.0024]  # 1/s, perpendicular to DIRECTION, 6.5e-3 rad/s


def lander(**settings_):
    plant = FlatMoonLander(initial_position=START, initial_velocity=SPEED, initial_mass=MASS, **settings_)
    plant.initialize()
    return plant


def state(plant):
    return np.array([*plant.position, *plant.velocity])


def thrusting(plant, thrust=THRUST, direction=DIRECTION, rate=(0.0, 0.0, 0.0), since=0.0, duration=1e9):
    plant.thrust = thrust
    plant.thrust_direction = direction
    plant.thrust_direction_rate = rate
    plant.command_time = since
    plant.burn_duration = duration
    return plant


def parabola(initial, acceleration, time):
    """Return position and velocity after ``time`` under constant thrust acceleration and gravity."""
    total = np.asarray(acceleration) - GRAVITY * UP
    return np.concatenate([initial[:3] + initial[3:] * time + 0.5 * total * time**2, initial[3:] + total * time])


def integrated(initial, thrust, direction, rate, since, start, end):
    """Integrate the same motion by DOP853."""

    def slope(t, y):
        along = np.add(direction, np.multiply(rate, t - since))
        return np.concatenate([y[3:], thrust / MASS * along / np.linalg.norm(along) - GRAVITY * UP])

    return solve_ivp(slope, (start, end), initial, method="DOP853", rtol=1e-13, atol=1e-10).y[:, -1]


def assert_states_agree(actual, expected, tolerance=1e-12):
    """Assert position relative to its length, velocity relative to its own."""
    assert np.linalg.norm(actual[:3] - expected[:3]) <= tolerance * np.linalg.norm(expected[:3])
    assert np.linalg.norm(actual[3:] - expected[3:]) <= tolerance * np.linalg.norm(expected[3:])


def test_start_is_the_initial_state():
    plant = lander()
    assert plant.position == START
    assert plant.velocity == SPEED
    assert plant.mass == MASS
    assert plant.specific_force == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("step", [0.05, 0.1, 0.7, 10.0])
def test_free_fall_is_a_parabola(step):
    plant = lander()
    for k in range(20):
        plant.step(k * step, step)
        assert_states_agree(state(plant), parabola(np.array(START + SPEED), np.zeros(3), (k + 1) * step))
        assert plant.specific_force == pytest.approx([0.0, 0.0, 0.0], abs=1e-11)
        assert plant.mass == MASS


@pytest.mark.parametrize("step", [0.05, 0.1, 0.7, 10.0])
def test_constant_thrust_is_a_parabola(step):
    plant = thrusting(lander())
    acceleration = THRUST / MASS * np.array(DIRECTION)
    for k in range(20):
        plant.step(k * step, step)
        assert_states_agree(state(plant), parabola(np.array(START + SPEED), acceleration, (k + 1) * step))
        assert plant.specific_force == pytest.approx(acceleration, abs=1e-11)


@given(st.integers(1, 999), st.sampled_from([0.3, 1.0, 4.0]), st.sampled_from([0.0, 123.4]))
@settings(max_examples=either(60, 20), deadline=None)
def test_thrust_ends_inside_a_step(thousandths, step, since):
    """Thrust to command_time + burn_duration, then a free fall to the end of the step."""
    duration = thousandths / 1000.0 * step
    plant = thrusting(lander(), since=since, duration=duration)
    plant.step(since, step)
    acceleration = THRUST / MASS * np.array(DIRECTION)
    burnt = parabola(np.array(START + SPEED), acceleration, duration)
    assert_states_agree(state(plant), parabola(burnt, np.zeros(3), step - duration))
    assert plant.specific_force == pytest.approx(acceleration * duration / step, abs=1e-9)
    plant.step(since + step, step)
    assert_states_agree(state(plant), parabola(burnt, np.zeros(3), 2.0 * step - duration))
    assert plant.specific_force == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)


@given(st.integers(1, 3999))
@settings(max_examples=either(60, 20), deadline=None)
def test_latch_keeps_the_state_where_thrust_ends(thousandths):
    duration = thousandths / 1000.0
    plant = thrusting(lander(latch_at_burn_end=True), duration=duration)
    for k in range(4):
        plant.step(float(k), 1.0)
    expected = parabola(np.array(START + SPEED), THRUST / MASS * np.array(DIRECTION), duration)
    assert_states_agree(state(plant), expected)
    thrusting(plant, since=4.0)  # a later command moves nothing
    plant.step(4.0, 1.0)
    assert_states_agree(state(plant), expected)
    assert plant.specific_force == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("step", [0.25, 0.5, 1.0, 2.0])
def test_latch_holds_when_thrust_ends_at_a_communication_point(step):
    plant = thrusting(lander(latch_at_burn_end=True), duration=2.0)
    for k in range(int(6.0 / step)):
        plant.step(k * step, step)
    assert_states_agree(state(plant), parabola(np.array(START + SPEED), THRUST / MASS * np.array(DIRECTION), 2.0))


def test_latch_holds_when_the_thrust_command_goes_to_zero():
    plant = thrusting(lander(latch_at_burn_end=True))
    plant.step(0.0, 1.0)
    retained = state(plant)
    thrusting(plant, thrust=0.0)
    plant.step(1.0, 1.0)
    assert state(plant).tolist() == retained.tolist()
    assert plant.specific_force == [0.0, 0.0, 0.0]


def test_latch_waits_for_the_first_burn():
    plant = lander(latch_at_burn_end=True)
    plant.step(0.0, 1.0)
    thrusting(plant, since=1.0, duration=0.25)
    plant.step(1.0, 1.0)
    coasted = parabola(np.array(START + SPEED), np.zeros(3), 1.0)
    assert_states_agree(state(plant), parabola(coasted, THRUST / MASS * np.array(DIRECTION), 0.25))


def test_specific_force_of_a_latched_step_is_thrust_over_the_whole_step():
    plant = thrusting(lander(latch_at_burn_end=True), duration=0.25)
    plant.step(0.0, 1.0)
    assert plant.specific_force == pytest.approx(0.25 * THRUST / MASS * np.array(DIRECTION), abs=1e-11)


@pytest.mark.parametrize("step", [0.1, 1.0, 20.0])
def test_turning_direction_follows_dop853(step):
    plant = thrusting(lander(), rate=TURNING, since=-3.0)
    end = 20.0
    for k in range(round(end / step)):
        plant.step(k * step, step)
    expected = integrated(START + SPEED, THRUST, DIRECTION, TURNING, -3.0, 0.0, end)
    assert_states_agree(state(plant), expected, 1e-11)


def test_commands_of_successive_cycles_follow_dop853():
    """Ten cycles of 2 s, each with another direction, rate and thrust."""
    generator = np.random.default_rng(3)
    plant = lander()
    expected = np.array(START + SPEED)
    for k in range(10):
        t = 2.0 * k
        direction = generator.normal(size=3)
        direction /= np.linalg.norm(direction)
        rate = 0.02 * np.cross(direction, generator.normal(size=3))
        thrust = float(generator.uniform(1000.0, 9000.0))
        thrusting(plant, thrust, direction.tolist(), rate.tolist(), since=t)
        expected = integrated(expected, thrust, direction, rate, t, t, t + 2.0)
        for part in range(4):
            plant.step(t + 0.5 * part, 0.5)
    assert_states_agree(state(plant), expected, 1e-11)


def test_direction_need_not_be_a_unit_vector():
    plant = thrusting(lander(), direction=[5.0 * x for x in DIRECTION])
    plant.step(0.0, 1.0)
    assert plant.specific_force == pytest.approx(THRUST / MASS * np.array(DIRECTION), abs=1e-11)


def test_integrator_is_of_fourth_order():
    """A fast turn, 0.13 rad/s; position and velocity errors fall by 16 per halved step."""
    rate = [20.0 * x for x in TURNING]
    exact = integrated(START + SPEED, THRUST, DIRECTION, rate, 0.0, 0.0, 16.0)
    errors = []
    for internal in (2.0, 1.0, 0.5, 0.25):
        plant = thrusting(lander(internal_step=internal), rate=rate)
        plant.step(0.0, 16.0)
        difference = state(plant) - exact
        errors.append([np.linalg.norm(difference[:3]), np.linalg.norm(difference[3:])])
    orders = np.log2(np.array(errors)[:-1] / np.array(errors)[1:])
    assert orders[-1] == pytest.approx([4.0, 4.0], abs=0.15)
    assert orders[-2] == pytest.approx([4.0, 4.0], abs=0.4)


@given(st.lists(st.integers(1, 400), min_size=1, max_size=12), st.integers(100, 9999))
@settings(max_examples=either(40, 13), deadline=None)
def test_results_do_not_depend_on_how_communication_cuts_them(cuts, burn_thousandths):
    """Random communication points over one command of 10 s, thrust ending anywhere in it."""
    duration = burn_thousandths / 1000.0
    whole = thrusting(lander(), rate=TURNING, duration=duration)
    whole.step(0.0, 10.0)
    points = sorted({0.0, 10.0, *(10.0 * value / 401.0 for value in np.cumsum(cuts) % 401)})
    cut = thrusting(lander(), rate=TURNING, duration=duration)
    for first, second in itertools.pairwise(points):
        cut.step(first, second - first)
    assert_states_agree(state(cut), state(whole))


@given(st.floats(-math.pi, math.pi))
@settings(max_examples=either(60, 20), deadline=None)
def test_motion_turns_with_the_frame_about_the_vertical(azimuth):
    turn = np.array(
        [
            [math.cos(azimuth), -math.sin(azimuth), 0.0],
            [math.sin(azimuth), math.cos(azimuth), 0.0],
            [0.0, 0.0, 1.0],
        ]
    )
    plain = thrusting(lander(), rate=TURNING)
    turned = FlatMoonLander(initial_position=(turn @ START).tolist(), initial_velocity=(turn @ SPEED).tolist())
    turned.initialize()
    thrusting(turned, direction=(turn @ DIRECTION).tolist(), rate=(turn @ TURNING).tolist())
    for k in range(3):
        plain.step(float(k), 1.0)
        turned.step(float(k), 1.0)
    assert_states_agree(state(turned), np.concatenate([turn @ plain.position, turn @ plain.velocity]))


def test_declared_starts_alone_run():
    plant = FlatMoonLander()
    plant.initialize()
    plant.step(0.0, 0.1)
    expected = parabola(np.array([1.0e5, 0.0, 1.05e4, -950.0, 0.0, 0.0]), np.zeros(3), 0.1)
    assert_states_agree(state(plant), expected)
