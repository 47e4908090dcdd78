"""Thrust allocation against closed forms of its throttle, lag and slew limit.

Truth: mass times acceleration, the exact response of a first-order lag to a staircase (a sum of
exponentials), scipy rotations for the slew-limited direction, a chi-square interval (99.9 %) for the
random thrust error. Tolerance 1e-11 relative for thrust, 1e-12 for unit vectors.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats
from scipy.spatial.transform import Rotation

from fmus_src.actuators.thrust_allocation import ThrustAllocation

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
    """The direction the plant flies at ``time``."""
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
@settings(max_examples=60, deadline=None)
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


@pytest.mark.parametrize("limit", [0.02, 0.3])
def test_slew_turns_at_the_limit_along_the_great_circle(limit):
    """The demand jumps by 1.2 rad: the flown direction trails at limit * time until it arrives."""
    step = 0.1
    block = allocation(slew_rate_limit=limit)
    goal = Rotation.from_rotvec([0.0, 1.2, 0.0]).apply(DEMAND)
    block.demanded_direction[:] = goal
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
@settings(max_examples=60, deadline=None)
def test_slew_never_exceeds_its_limit(seed, limit, step):
    generator = np.random.default_rng(seed)
    block = allocation(slew_rate_limit=limit)
    last = np.array(block.thrust_direction)
    for k in range(15):
        block.demanded_direction[:] = unit(generator.normal(size=3))
        block.demanded_direction_rate[:] = np.cross(block.demanded_direction, 0.1 * generator.normal(size=3))
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
    block.demanded_direction[:] = goal
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


def test_declared_starts_alone_run():
    block = ThrustAllocation()
    block.initialize()
    block.step(0.0, 0.1)
    assert (block.thrust, block.status) == (0.0, 0)
    limited = ThrustAllocation(slew_rate_limit=0.1, thrust_lag=0.1, maximum_thrust=1.0, thrust_error=0.1)
    limited.initialize()
    limited.step(0.0, 0.1)
    assert (limited.thrust, limited.status) == (0.0, 0)
