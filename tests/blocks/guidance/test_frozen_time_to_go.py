"""Commands of the terminal guidances with a frozen time to go, as feedback laws of position and velocity.

Truth: with A and B linear in position and velocity the derivatives of every law follow by hand (below, in numpy);
central differences of the blocks' commands are compared with them. A frozen time to go never ends a flight.
"""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.fmus_src.guidance.apollo import ApolloGuidance
from perilune.fmus_src.guidance.fractional import FractionalGuidance
from perilune.fmus_src.interfaces.ports.landing import UNLIMITED
from tests.support.descent.laws import TO_A_PLACE
from tests.support.flights.linear_thrust import GRAVITY, POSITION, TARGET, VELOCITY, impulse_and_miss
from tests.support.flights.terminal_guidance import (
    ALL,
    EXACT,
    GOOD,
    NOT_CONVERGED,
    AnalyticGuidance,
    AstarGuidance,
    AstarModifiedGuidance,
    commanded,
    see,
)
from tests.support.lengths import either

SIDEWAYS = np.array([0.0, 1.0, 0.0])
TIME = 230.0  # close to none of the laws' own times
MOON = {"gravitational_parameter": 4.9028e12, "moon_radius": 1.7374e6}


def command(guidance, position, velocity, step=0.0):
    """Return commanded thrust acceleration (3,), at command_time; of the next cycle of length ``step`` (s) if not 0."""
    see(guidance, position, velocity)
    if step > 0.0:
        guidance.step(0.0, step)
    else:
        guidance.initialize()
    assert guidance.status == GOOD
    return guidance.thrust_acceleration * np.array(guidance.thrust_direction)


def gains(guidance, position, velocity, step=0.0):
    """Return derivatives of the command to position and to velocity, (3, 3) each, by central differences."""
    actual = []
    for change in np.eye(6):
        small = change * np.repeat([1e-2, 1e-4], 3)
        ends = [command(guidance, position + sign * small[:3], velocity + sign * small[3:], step) for sign in (1, -1)]
        actual.append((ends[0] - ends[1]) / (2.0 * small.sum()))
    return np.array(actual[:3]).T, np.array(actual[3:]).T


@pytest.mark.parametrize("guidance_class", EXACT)
@pytest.mark.parametrize("time", [5.0, 60.0, TIME])
def test_least_effort_about_hovering(guidance_class, time):
    """a0 = 6 dr/T^2 - 4 V/T + g k in every axis; hovering at the target is at rest, with thrust g upwards."""
    guidance = commanded(guidance_class, TARGET, np.zeros(3), frozen_time_to_go=time)
    assert guidance.thrust_direction == [0.0, 0.0, 1.0]
    assert guidance.thrust_direction_rate == pytest.approx([0.0, 0.0, 0.0], abs=1e-15)
    assert guidance.thrust_acceleration == pytest.approx(GRAVITY, rel=1e-14)
    position_gain, velocity_gain = gains(guidance, TARGET, np.zeros(3))
    assert position_gain == pytest.approx(-6.0 / time**2 * np.eye(3), abs=1e-6 / time**2)
    assert velocity_gain == pytest.approx(-4.0 / time * np.eye(3), abs=1e-6 / time)


@pytest.mark.parametrize("guidance_class", [FractionalGuidance, ApolloGuidance])
@pytest.mark.parametrize("time", [5.0, 60.0])
def test_a_quartic_about_its_final_thrust(guidance_class, time):
    """a0 = a_f + 12 dr/T^2 - 6 V/T, with the gain 12 that both laws declare."""
    guidance = commanded(guidance_class, TARGET, np.zeros(3), frozen_time_to_go=time)
    assert guidance.flown_kr == 12.0
    position_gain, velocity_gain = gains(guidance, TARGET, np.zeros(3))
    assert position_gain == pytest.approx(-12.0 / time**2 * np.eye(3), abs=1e-5 / time**2)
    assert velocity_gain == pytest.approx(-6.0 / time * np.eye(3), abs=1e-5 / time)


@pytest.mark.parametrize("guidance_class", EXACT)
def test_least_effort_in_flight_takes_the_mean_over_the_cycle(guidance_class):
    """Sideways the direction turns with its rate, upwards the size is that of a0 + a1 h/2."""
    time, cycle = 20.0, 0.5
    guidance = commanded(guidance_class, TARGET, np.zeros(3), frozen_time_to_go=time)
    position_gain, velocity_gain = gains(guidance, TARGET, np.zeros(3), cycle)
    sideways, upwards = np.array([1.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
    expected = np.diag(sideways + (1.0 - cycle / time) * upwards)
    assert position_gain == pytest.approx(-6.0 / time**2 * expected, abs=1e-8)
    expected = np.diag(sideways + (1.0 - 0.75 * cycle / time) * upwards)
    assert velocity_gain == pytest.approx(-4.0 / time * expected, abs=1e-7)


@pytest.mark.parametrize("guidance_class", EXACT)
def test_gravity_correction_adds_the_gradient_of_gravity(guidance_class):
    """Thrust makes up for the central field where the vehicle is: less dg/dr = mu/R^3 (3 u u - 1)."""
    time = 60.0
    guidance = commanded(guidance_class, TARGET, np.zeros(3), frozen_time_to_go=time, gravity_correction=True, **MOON)
    assert guidance.expected_time == time
    radius = MOON["moon_radius"] + TARGET[2]
    pull = MOON["gravitational_parameter"] / radius**2
    assert guidance.thrust_acceleration == pytest.approx(pull, rel=1e-12)
    position_gain, velocity_gain = gains(guidance, TARGET, np.zeros(3))
    gradient = pull / radius * np.diag([-1.0, -1.0, 2.0])
    assert position_gain == pytest.approx(-6.0 / time**2 * np.eye(3) - gradient, abs=1e-9)
    assert velocity_gain == pytest.approx(-4.0 / time * np.eye(3), abs=1e-7)


def test_analytic_gains():
    """c = (|A|/T) p/|p| with p = 3 B - A T: dA/dr = 0, dA/dv = -1, dp/dr = -3, dp/dv = -2 T."""
    guidance = commanded(AnalyticGuidance, frozen_time_to_go=TIME)
    position_gain, velocity_gain = gains(guidance, POSITION, VELOCITY)
    a, b = impulse_and_miss(POSITION, VELOCITY, TIME)
    p = 3.0 * b - a * TIME
    size, length = np.linalg.norm(a) / TIME, np.linalg.norm(p)
    along = p / length
    assert command(guidance, POSITION, VELOCITY) == pytest.approx(size * along, rel=1e-12)
    across = size / length * (np.eye(3) - np.outer(along, along))
    assert position_gain == pytest.approx(-3.0 * across, abs=1e-10)
    turned = np.outer(along, -a / np.linalg.norm(a)) / TIME
    assert velocity_gain == pytest.approx(-2.0 * TIME * across + turned, abs=1e-8)


@pytest.mark.parametrize("guidance_class", [AstarGuidance, AstarModifiedGuidance])
def test_astar_gains(guidance_class):
    """y and z of a0; along x what is left of W = 2 |B|/T^2, with dB/dr = -1 and dB/dv = -T."""
    position = POSITION + np.array([0.0, 2000.0, 0.0])
    guidance = commanded(guidance_class, position, VELOCITY, frozen_time_to_go=TIME)
    position_gain, velocity_gain = gains(guidance, position, VELOCITY)
    a, b = impulse_and_miss(position, VELOCITY, TIME)
    a0 = (6.0 * b - 2.0 * a * TIME) / TIME**2
    forward = np.sqrt((2.0 * np.linalg.norm(b) / TIME**2) ** 2 - a0[1] ** 2 - a0[2] ** 2)
    assert command(guidance, position, VELOCITY) == pytest.approx([forward, a0[1], a0[2]], rel=1e-12)
    rows = -np.eye(3)[1:]
    for actual, miss_rate, gain in [
        (position_gain, -1.0, 6.0 / TIME**2),
        (velocity_gain, -TIME, 4.0 / TIME),
    ]:
        assert actual[1:] == pytest.approx(gain * rows, abs=1e-6 * gain)
        first = (4.0 * miss_rate * b / TIME**4 - gain * (a0[1] * rows[0] + a0[2] * rows[1])) / forward
        assert actual[0] == pytest.approx(first, abs=1e-6 * gain)


@pytest.mark.parametrize("guidance_class", [*ALL, *TO_A_PLACE])
@pytest.mark.parametrize("terminal_step", [0, 1])
@pytest.mark.parametrize("correction", [False, True])
@given(
    time=st.sampled_from([0.01, 0.1, 0.5, 1.9, 2.5, 300.0]),
    states=st.lists(st.tuples(*[st.floats(-1e3, 1e3)] * 6), min_size=1, max_size=5),
)
@settings(max_examples=either(25, 8), deadline=None)
def test_a_frozen_plan_never_ends_the_flight(guidance_class, terminal_step, correction, time, states):
    """Shorter than the cycle, than the last burn, at the target or far from it, a command found or not."""
    guidance = commanded(
        guidance_class,
        states[0][:3],
        states[0][3:],
        frozen_time_to_go=time,
        terminal_step=terminal_step,
        last_burn=2.0,
        gravity_correction=correction,
    )
    assert guidance.expected_time == time
    for k, state in enumerate([*states, [*TARGET, 0.0, 0.0, 0.0]] * 3):
        see(guidance, state[:3], state[3:])
        guidance.step(0.1 * k, 0.1)
        assert not guidance.finished
        assert guidance.burn_duration == UNLIMITED
        assert guidance.expected_time == time
        if guidance.started:
            assert guidance.time_to_go == time
        if guidance.status < NOT_CONVERGED:
            assert guidance.command_time == pytest.approx(0.1 * k + 0.1, rel=1e-12)


@pytest.mark.parametrize("guidance_class", EXACT)
def test_a_flight_with_a_frozen_plan_settles_at_the_target(guidance_class):
    """Sideways x'' = -6 x/T^2 - 4 x'/T, over one cycle at a time: error of the order of cycle/T of the start's."""
    time, cycle, start = 20.0, 0.01, 10.0
    guidance = commanded(
        guidance_class, TARGET + start * SIDEWAYS, np.zeros(3), frozen_time_to_go=time, terminal_step=1, last_burn=30.0
    )
    offset, speed = start, 0.0
    for k in range(4000):
        force = guidance.thrust_acceleration * guidance.thrust_direction[1]
        offset, speed = offset + cycle * speed + 0.5 * cycle**2 * force, speed + cycle * force
        see(guidance, TARGET + offset * SIDEWAYS, speed * SIDEWAYS)
        guidance.step(k * cycle, cycle)
    decay, frequency = 2.0 / time, np.sqrt(2.0) / time
    elapsed = 4000 * cycle
    exact = (
        start * np.exp(-decay * elapsed) * (np.cos(frequency * elapsed) + np.sqrt(2.0) * np.sin(frequency * elapsed))
    )
    assert offset == pytest.approx(exact, abs=2.0 * cycle / time * start)
    assert guidance.time_to_go == time
