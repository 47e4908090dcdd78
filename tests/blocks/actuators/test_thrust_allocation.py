"""Thrust allocation, compared with closed forms of its throttle, lag and slew limit.

Truth: mass times acceleration, the exact response of a first-order lag to a staircase (a sum of exponentials), scipy
rotations for the slew-limited direction, a chi-square interval (99.9 %) for the random thrust error. Tolerance 1e-11
relative for thrust, 1e-12 for unit vectors. The effect of the leads is tested by simulation: with a lag the impulse of
a burn equals the impulse without a lag to 1e-9, and with a response time the direction equals the demanded direction to
second order in its rate.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats
from scipy.spatial.transform import Rotation

from perilune.fmus_src.actuators.thrust_allocation import ThrustAllocation
from perilune.fmus_src.plants.spherical_moon_lander import SphericalMoonLander
from tests.support.lengths import either

MASS = 940.0
DEMAND = [0.6, 0.0, 0.8]
RATE = [0.004, 0.01, -0.003]  # perpendicular to DEMAND


def allocation(acceleration=4.8, **settings_):
    block = ThrustAllocation(thrust_acceleration=acceleration, mass=MASS, demanded_direction=DEMAND, **settings_)
    block.initialize()
    return block


def unit(vector):
    return np.asarray(vector) / np.linalg.norm(vector)


def flown(block, time):
    """Return the direction the plant flies at ``time``."""
    return unit(np.add(block.thrust_direction, np.multiply(block.thrust_direction_rate, time - block.command_time)))


def angle_between(a, b):
    return 2.0 * math.atan2(np.linalg.norm(np.subtract(a, b)), np.linalg.norm(np.add(a, b)))


def test_all_limits_off_passes_the_command_through():
    block = allocation(demanded_direction_rate=RATE, demand_time=0.0, demanded_duration=7.0)
    for k in range(3):
        block.thrust_acceleration = 4.0 + k
        block.demand_time = 0.1 * k
        block.demanded_duration = 7.0 - k
        block.step(0.1 * k, 0.1)
        assert block.thrust == MASS * (4.0 + k)
        assert block.thrust_direction == DEMAND
        assert block.thrust_direction_rate == RATE
        assert block.command_time == 0.1 * k
        assert block.burn_duration == 7.0 - k
        assert block.status == 0


def test_start_is_settled_on_the_first_command():
    block = allocation(thrust_lag=3.0, slew_rate_limit=0.01, demanded_direction_rate=RATE)
    assert block.thrust == MASS * 4.8
    assert block.thrust_direction == DEMAND
    assert block.thrust_direction_rate == [0.0, 0.0, 0.0]  # at rest: the demanded rate may be above the limit
    assert allocation(demanded_direction_rate=RATE).thrust_direction_rate == RATE


@pytest.mark.parametrize(
    ("acceleration", "thrust", "status"),
    [(0.0, 0.0, 0), (0.5, 1000.0, 1), (2.0, 2.0 * MASS, 0), (9.0, 5000.0, 1), (1000.0 / MASS, 1000.0, 0)],
)
def test_thrust_is_kept_within_its_limits(acceleration, thrust, status):
    block = allocation(acceleration, minimum_thrust=1000.0, maximum_thrust=5000.0)
    assert (block.thrust, block.status) == (pytest.approx(thrust, rel=1e-15), status)
    block.step(0.0, 0.1)
    assert (block.thrust, block.status) == (pytest.approx(thrust, rel=1e-15), status)


def test_no_maximum_means_no_maximum():
    assert allocation(1e6).thrust == MASS * 1e6


def test_status_returns_to_good():
    block = allocation(9.0, maximum_thrust=5000.0)
    assert block.status == 1
    block.thrust_acceleration = 1.0
    block.step(0.0, 0.1)
    assert block.status == 0


@given(
    st.lists(st.floats(0.0, 10.0), min_size=2, max_size=12),
    st.sampled_from([0.05, 0.1, 1.0]),
    st.sampled_from([0.01, 0.1, 0.37, 5.0]),
)
@settings(max_examples=either(60, 20), deadline=None)
def test_lag_is_the_exact_response_to_a_staircase(demands, step, lag):
    """A superposition of steps: each demand holds from its communication point to the next."""
    block = allocation(demands[0], thrust_lag=lag)
    for k in range(1, len(demands)):
        block.thrust_acceleration = demands[k]
        block.step((k - 1) * step, step)
        response = demands[0]
        for j in range(1, k):
            response += (demands[j] - demands[j - 1]) * (1.0 - math.exp(-(k - j) * step / lag))
        assert block.thrust == pytest.approx(MASS * response, rel=1e-11, abs=1e-9)


def test_lag_does_not_depend_on_how_communication_cuts_it():
    coarse, fine = allocation(2.0, thrust_lag=0.4), allocation(2.0, thrust_lag=0.4)
    for block in (coarse, fine):
        block.thrust_acceleration = 6.0
        block.step(0.0, 0.1)
    coarse.step(0.1, 0.9)
    for k in range(9):
        fine.step(0.1 * (k + 1), 0.1)
    assert fine.thrust == pytest.approx(coarse.thrust, rel=1e-13)
    assert coarse.thrust == pytest.approx(MASS * (6.0 - 4.0 * math.exp(-0.9 / 0.4)), rel=1e-13)


def test_limits_act_before_the_lag():
    block = allocation(2.0, thrust_lag=0.5, maximum_thrust=5000.0)
    block.thrust_acceleration = 1e4
    for k in range(200):
        block.step(0.1 * k, 0.1)
        assert block.thrust <= 5000.0
    assert block.thrust == pytest.approx(5000.0, rel=1e-12)


def test_thrust_error_is_normal_constant_over_a_flight_and_off_by_default():
    count = 400
    factors = []
    for seed in range(count):
        block = allocation(4.8, thrust_error=0.01, seed=seed)
        factor = block.thrust / (MASS * 4.8)
        block.thrust_acceleration = 2.0
        block.step(0.0, 0.1)
        assert block.thrust == pytest.approx(factor * MASS * 2.0, rel=1e-14)
        factors.append((factor - 1.0) / 0.01)
    errors = np.array(factors)
    assert stats.kstest(errors, "norm").pvalue > 1e-3
    low, high = stats.chi2.ppf([0.0005, 0.9995], count)
    assert low < (errors**2).sum() < high
    assert allocation(4.8, seed=9).thrust == MASS * 4.8


def test_an_offset_of_thrust_is_that_of_every_flight():
    assert allocation(4.8, thrust_offset=-0.03).thrust == pytest.approx(0.97 * MASS * 4.8, rel=1e-15)
    plain, low = (allocation(4.8, thrust_error=0.01, seed=5, thrust_offset=offset).thrust for offset in (0.0, -0.03))
    assert plain - low == pytest.approx(0.03 * MASS * 4.8, rel=1e-12)


@pytest.mark.parametrize("limit", [0.02, 0.3])
def test_slew_turns_at_the_limit_along_the_great_circle(limit):
    """The demand jumps by 1.2 rad: the flown direction trails at limit * time until it arrives."""
    step = 0.1
    block = allocation(slew_rate_limit=limit)
    goal = Rotation.from_rotvec([0.0, 1.2, 0.0]).apply(DEMAND)
    block.demanded_direction = goal
    for k in range(150):
        time = step * (k + 1)
        block.demand_time = time
        block.step(step * k, step)
        turned = min(limit * step * k, 1.2)
        assert flown(block, time) == pytest.approx(Rotation.from_rotvec([0.0, turned, 0.0]).apply(DEMAND), abs=1e-12)
        turned = min(limit * step * (k + 1), 1.2)
        assert flown(block, time + step) == pytest.approx(
            Rotation.from_rotvec([0.0, turned, 0.0]).apply(DEMAND), abs=1e-12
        )
        assert np.dot(block.thrust_direction, block.thrust_direction_rate) == pytest.approx(0.0, abs=1e-13)
        assert block.command_time == pytest.approx(time, abs=1e-14)
        if abs(limit * time - 1.2) > 1e-9:
            assert block.status == int(limit * time < 1.2)


@given(st.integers(0, 2**32 - 1), st.floats(0.01, 1.0), st.sampled_from([0.05, 0.2, 1.0]))
@settings(max_examples=either(60, 20), deadline=None)
def test_slew_never_exceeds_its_limit(seed, limit, step):
    generator = np.random.default_rng(seed)
    block = allocation(slew_rate_limit=limit)
    last = np.array(block.thrust_direction)
    for k in range(15):
        block.demanded_direction = unit(generator.normal(size=3))
        block.demanded_direction_rate = np.cross(block.demanded_direction, 0.1 * generator.normal(size=3))
        block.demand_time = step * (k + 1)
        block.step(step * k, step)
        assert np.linalg.norm(block.thrust_direction) == pytest.approx(1.0, abs=1e-14)
        assert flown(block, step * (k + 1)) == pytest.approx(last, abs=1e-12)
        reached = flown(block, step * (k + 2))
        assert angle_between(last, reached) <= limit * step + 1e-12
        last = reached


def test_generous_slew_limit_flies_a_held_demand():
    """A demand held for many steps (a guidance that does not converge) turns on, and is followed."""
    block = allocation(slew_rate_limit=5.0, demanded_direction_rate=[10.0 * x for x in RATE], demand_time=0.0)
    for k in range(200):
        block.step(0.1 * k, 0.1)
        time = 0.1 * (k + 2)
        demanded = unit(np.add(DEMAND, np.multiply([10.0 * x for x in RATE], time)))
        assert flown(block, time) == pytest.approx(demanded, abs=1e-12)
        assert block.status == 0


@pytest.mark.parametrize("jump", [1.7, 3.0])
@pytest.mark.parametrize("limit", [2.0, 10.0])
def test_turns_beyond_a_right_angle_in_one_step_go_the_right_way(jump, limit):
    block = allocation(slew_rate_limit=limit)
    goal = Rotation.from_rotvec([0.0, jump, 0.0]).apply(DEMAND)
    block.demanded_direction = goal
    last = angle_between(DEMAND, goal)
    for k in range(3):
        block.demand_time = k + 1.0
        block.step(float(k), 1.0)
        left = angle_between(flown(block, k + 2.0), goal)
        assert left < max(last - 1.0, 1e-9)
        last = left
    assert last < 1e-9


def test_slew_counts_the_burn_from_its_own_command_time():
    block = allocation(slew_rate_limit=0.1, demand_time=0.0, demanded_duration=5.0)
    block.step(0.0, 0.5)
    assert block.command_time == 0.5
    assert block.command_time + block.burn_duration == pytest.approx(5.0, abs=1e-15)


@pytest.mark.parametrize("slew", [0.0, 10.0])
def test_leads_of_zero_change_nothing(slew):
    """To the bit, negative durations included."""
    settings_ = {"demanded_direction_rate": RATE, "slew_rate_limit": slew}
    plain, led = allocation(**settings_), allocation(**settings_, thrust_lead=0.0, direction_lead=0.0)
    for k in range(5):
        for block in (plain, led):
            block.demand_time = 0.3
            block.demanded_duration = 0.1 - 0.07 * k
            block.step(0.1 * k, 0.1)
        assert (plain.command_time, plain.burn_duration) == (led.command_time, led.burn_duration)
        assert plain.thrust_direction == led.thrust_direction
        if slew == 0.0:
            assert (led.command_time, led.burn_duration) == (0.3, 0.1 - 0.07 * k)


@pytest.mark.parametrize("slew", [0.0, 10.0])
@pytest.mark.parametrize(("demanded", "left"), [(7.0, 6.6), (0.4, 0.0), (0.1, 0.0), (1e9, 1e9 - 0.4)])
def test_thrust_lead_ends_the_burn_earlier_but_not_before_it_begins(slew, demanded, left):
    block = allocation(thrust_lead=0.4, demand_time=2.0, demanded_duration=demanded, slew_rate_limit=slew)
    block.step(2.4, 0.1)
    assert block.command_time + block.burn_duration == pytest.approx(2.0 + left, rel=1e-15)


def impulse_after_settling(duration, lead, lag, step):
    """Return the impulse (N s) of a plant with a lag from 4 s on, when guidance requests its
    thrust for ``duration`` more."""
    plant = SphericalMoonLander(thrust_lag=lag, direction_response=0.0, slew_rate_limit=0.0)
    plant.initialize()
    block = allocation(3.0, thrust_lead=lead, demanded_duration=1e9)
    before = 0.0
    for k in range(round(20.0 / step)):
        time = k * step
        if abs(time - 4.0) < 1e-9:
            before = plant.mass
            block.demand_time = time
            block.demanded_duration = duration
            block.step(time - step, step)
        plant.thrust = 3.0 * MASS
        plant.thrust_direction = block.thrust_direction
        plant.command_time, plant.burn_duration = block.command_time, block.burn_duration
        plant.step(time, step)
    return plant.specific_impulse * 9.80665 * (before - plant.mass)


@pytest.mark.parametrize("duration", [0.1, 1.234, 5.0])
@pytest.mark.parametrize("lag", [0.05, 0.1])
def test_thrust_lead_gives_the_impulse_that_a_lag_would_add(duration, lag):
    thrust = 3.0 * MASS
    assert impulse_after_settling(duration, 0.0, 0.0, 0.1) == pytest.approx(thrust * duration, rel=1e-9)
    assert impulse_after_settling(duration, lag, lag, 0.1) == pytest.approx(thrust * duration, rel=1e-9)
    assert impulse_after_settling(duration, 0.0, lag, 0.1) == pytest.approx(thrust * (duration + lag), rel=1e-9)


@given(st.sampled_from([0.0, 0.3, 1.1]), st.sampled_from([0.0, 10.0]), st.integers(-3, 3))
@settings(max_examples=either(30, 10), deadline=None)
def test_direction_lead_commands_the_direction_of_later(lead, slew, tenths):
    """At the next communication point, for demands of now, earlier and later."""
    block = allocation(direction_lead=lead, demanded_direction_rate=RATE, slew_rate_limit=slew, demanded_duration=5.0)
    block.demand_time = 1.0 - 0.1 * tenths
    block.step(0.9, 0.1)
    expected = unit(np.add(DEMAND, np.multiply(RATE, 1.1 + lead - block.demand_time)))
    assert flown(block, 1.1) == pytest.approx(expected, abs=1e-12)
    assert block.command_time + block.burn_duration == pytest.approx(block.demand_time + 5.0, abs=1e-12)


def test_direction_lead_makes_up_for_a_response():
    """A plant with a response of 0.5 s behind a demand that turns steadily, with the lead and without it."""
    response, turning = 0.5, 0.02
    ends = []
    for lead in (0.0, response):
        plant = SphericalMoonLander(direction_response=response)
        plant.initialize()
        block = allocation(direction_lead=lead)
        for k in range(100):
            time = 0.1 * k
            now = Rotation.from_rotvec([0.0, turning * time, 0.0])
            block.demanded_direction = now.apply(DEMAND)
            block.demanded_direction_rate = np.cross([0.0, turning, 0.0], block.demanded_direction)
            block.demand_time = time
            block.step(time - 0.1, 0.1)
            plant.thrust_direction = block.thrust_direction
            plant.thrust_direction_rate = block.thrust_direction_rate
            plant.command_time = block.command_time
            plant.step(time, 0.1)
        ends.append(angle_between(plant.attitude, Rotation.from_rotvec([0.0, turning * 10.0, 0.0]).apply(DEMAND)))
    assert ends[0] == pytest.approx(response * turning, rel=1e-3)
    assert ends[1] < 1e-6


@pytest.mark.parametrize("acceleration", [0.0, 0.5, 1.5, 9.0])
@pytest.mark.parametrize("slew", [0.0, 0.01])
def test_minimum_above_maximum_is_told_by_the_status(acceleration, slew):
    block = allocation(acceleration, minimum_thrust=3000.0, maximum_thrust=2000.0, slew_rate_limit=slew)
    for k in range(3):
        assert block.status == 2
        assert block.thrust <= 2000.0
        block.demanded_direction = [0.0, 1.0, 0.0]
        block.step(0.1 * k, 0.1)
    assert allocation(0.5, minimum_thrust=3000.0).status == 1  # no maximum
    assert allocation(2.0, minimum_thrust=2000.0, maximum_thrust=2000.0).status == 1
    assert allocation(2000.0 / MASS, minimum_thrust=2000.0, maximum_thrust=2000.0).status == 0


def test_declared_starts_alone_run():
    block = ThrustAllocation()
    block.initialize()
    block.step(0.0, 0.1)
    assert (block.thrust, block.status) == (0.0, 0)
    limited = ThrustAllocation(slew_rate_limit=0.1, thrust_lag=0.1, maximum_thrust=1.0, thrust_error=0.1)
    limited.initialize()
    limited.step(0.0, 0.1)
    assert (limited.thrust, limited.status) == (0.0, 0)


@pytest.mark.parametrize(("low", "high"), [(0.57, 0.63), (0.3, 0.9), (0.5, 0.5), (0.0, 0.4)])
@given(fractions=st.lists(st.floats(0.0, 1.3), min_size=1, max_size=30))
def test_the_dead_band_is_passed_in_full(low, high, fractions):
    """As the demand's own history says: full since the last demand above the band, until one below it or none."""
    largest = 5000.0
    block = allocation(0.0, maximum_thrust=largest, dead_band_low=low, dead_band_high=high)
    full = False
    for k, fraction in enumerate(fractions):
        block.thrust_acceleration = fraction * largest / MASS
        demand = MASS * block.thrust_acceleration / largest
        block.step(0.1 * k, 0.1)
        if demand > high:
            full = True
        elif demand < low or demand == 0.0:
            full = False
        expected = largest if full else min(demand, 1.0) * largest
        assert block.thrust == pytest.approx(expected, rel=1e-12)
        assert block.status == (block.thrust != MASS * block.thrust_acceleration)


@pytest.mark.parametrize(("low", "high", "largest"), [(0.7, 0.6, 5000.0), (0.5, 0.6, 0.0), (0.1, 0.0, 5000.0)])
def test_a_dead_band_that_cannot_be(low, high, largest):
    """In reverse, or fractions of no thrust: status 2, and thrust as demanded."""
    block = allocation(1.0, maximum_thrust=largest, dead_band_low=low, dead_band_high=high)
    assert block.status == 2
    assert block.thrust == MASS
