"""Hover guidance: control law, thrust estimate, and start of plans.

Truth: the exact acceleration of a second-order loop, and its decay in closed form; the exponential response of a
low-pass filter; a first-order engine integrated by scipy.
"""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from perilune.fmus_src.guidance.hover_guidance import HoverGuidance
from perilune.fmus_src.interfaces.ports.landing import HoverMode
from perilune.fmus_src.runtime import BlockInstance
from tests.support.flights.hover_flight import EXHAUST, GRAVITY, MASS, TARGET, H, begun, fly
from tests.support.lengths import either

small = st.floats(-5.0, 5.0)


@settings(max_examples=either(50, 16))
@given(st.tuples(small, small, small), st.tuples(small, small, small).map(lambda v: np.array(v) / 10.0))
def test_the_law_gives_the_acceleration_of_its_loop(error, slip):
    """Holding, without low-pass, the command is gravity and w^2 e + 2 damping w ev, exactly."""
    block = begun(mode=HoverMode.HOLD, position=np.array(TARGET) - error, velocity=-slip, tilt_filter=0.0)
    given_acceleration = block.thrust_acceleration * np.array(block.thrust_direction) - [0.0, 0.0, GRAVITY]
    desired = 0.12**2 * np.array(error) + 2.0 * 0.9 * 0.12 * slip
    assert given_acceleration == pytest.approx(desired, abs=1e-12)
    assert not block.saturated
    assert (block.plan_kind, block.finished, block.time_to_go) == (0, True, 0.0)


def test_holding_decays_as_the_second_order_loop():
    wn, zeta = 0.12, 0.9
    damped = wn * math.sqrt(1.0 - zeta * zeta)
    position = np.array([3.0, -2.0, 1.0])
    block = begun(mode=HoverMode.HOLD, position=position, target_position=[0.0, 0.0, 0.0], tilt_filter=0.0)
    for t, state in fly(block, 30.0, position):
        decay = math.exp(-zeta * wn * t) * (math.cos(damped * t) + zeta * wn / damped * math.sin(damped * t))
        # a command held for 0.1 s acts 0.05 s late
        assert state[:3] == pytest.approx(position * decay, abs=0.012 * 3.0)


def test_low_pass_of_the_lateral_demand():
    block = begun(mode=HoverMode.HOLD, position=np.array(TARGET) - [2.0, 0.0, 0.0], estimate_thrust=False)
    lateral = 0.12**2 * 2.0 / GRAVITY
    for n in range(20):
        assert block.tilt.x == pytest.approx(lateral * (1.0 - math.exp(-H * (n + 1) / 0.7)), rel=1e-9)
        block.step(n * H, H)
    block.plan_number = 1
    block.step(2.0, H)
    assert block.tilt.x > 0.9 * lateral  # kept over plans
    block.active = False
    block.step(2.1, H)
    block.active = True
    block.step(2.2, H)
    assert block.tilt.x == pytest.approx(lateral * (1.0 - math.exp(-H / 0.7)), rel=1e-9)


def test_errors_are_shortened():
    far = begun(mode=HoverMode.HOLD, position=np.array(TARGET) - [0.0, 0.0, 100.0], tilt_filter=0.0)
    assert far.thrust_acceleration == pytest.approx(GRAVITY + 0.12**2 * 40.0)
    assert far.saturated
    aside = begun(
        mode=HoverMode.HOLD, position=np.array(TARGET) - [39.0, 0.0, 0.0], velocity=[-5.0, 0.0, 0.0], tilt_filter=0.0
    )
    d = aside.thrust_direction
    assert d.x / d.z == pytest.approx(math.tan(math.radians(12.0)))
    assert aside.saturated
    assert begun(mode=HoverMode.HOLD, position=TARGET, mass=5000.0, maximum_thrust=1e4, minimum_thrust=9e3).saturated
    falling = begun(mode=HoverMode.HOLD, position=TARGET, velocity=[0.0, 0.0, 20.0])
    assert falling.thrust_acceleration == 0.02
    assert falling.saturated


def test_gains_of_a_programme():
    block = begun()
    _, _, _, last_burn, end = block.programme
    assert block.frequency(end - last_burn - 1.01) == 0.06
    assert block.frequency(end - last_burn - 0.99) == 0.15
    assert block.frequency(end) == 0.12
    assert begun(mode=HoverMode.SLOW).frequency(1.0) == 0.12


@pytest.mark.parametrize(("lag", "factor"), [(0.0, 1.03), (0.1, 0.97)])
def test_thrust_is_estimated_from_an_engine_with_a_lag(lag, factor):
    """Measured over commanded thrust of a first-order engine, integrated by scipy; the error falls by 0.1 or 0.02."""
    held = [0.0, 0.0, GRAVITY * H]
    block = begun(mode=HoverMode.HOLD, position=TARGET, engine_lag=lag, maximum_thrust=2000.0, velocity_increment=held)
    thrust, errors = MASS * GRAVITY, [factor - 1.0]
    for n in range(40):
        command = min(max(block.mass * block.thrust_acceleration, block.minimum_thrust), 2000.0)

        def rates(_, s, command=command):
            push = factor * (s[0] if lag > 0.0 else command)
            return [(command - s[0]) / max(lag, H), -push / EXHAUST, push / s[1]]

        thrust, mass, gained = solve_ivp(rates, (0.0, H), [thrust, block.mass, 0.0], rtol=1e-10, atol=1e-10).y[:, -1]
        block.mass, block.velocity_increment = float(mass), [0.0, 0.0, gained]
        block.step(n * H, H)
        errors.append(factor - block.thrust_factor)
    for before, after in pairwise(errors):
        assert after == pytest.approx(0.9 * before, abs=2e-6)  # 973 N are above 30 % of 2000 N
    assert abs(errors[-1]) < 5e-4


@pytest.mark.parametrize("steps", [(0.075, 0.15), (0.08, 0.08, 0.16, 0.08)])
def test_samples_that_come_late_count_with_their_own_time(steps):
    """An engine without errors, sampled at communication points that miss the sample instants: the factor stays 1."""
    block = begun(mode=HoverMode.HOLD, position=TARGET, velocity_increment=[0.0, 0.0, GRAVITY * H])
    time = 0.0
    for n in range(60):
        elapsed = steps[n % len(steps)]
        gained = -EXHAUST * math.log1p(-block.commanded_thrust * elapsed / EXHAUST / block.mass)
        block.mass *= math.exp(-gained / EXHAUST)
        block.velocity_increment = [0.0, 0.0, gained]
        block.step(time, elapsed)
        time += elapsed
        assert block.thrust_factor == pytest.approx(1.0, abs=2e-5)


def test_the_answer_is_the_number_of_the_plan_flown():
    block = begun(plan_number=3)
    assert block.answered_plan == 3
    block.plan_number = 4
    assert block.answered_plan == 3
    block.step(0.0, H)
    assert block.answered_plan == 4
    block.active = False
    block.step(H, H)
    block.plan_number = 5
    block.step(2.0 * H, H)
    assert block.answered_plan == 4  # idle, without a plan


def test_an_estimate_can_be_switched_off_and_follows_no_other_engine():
    for change in ({"estimate_thrust": False}, {}):
        block = begun(mode=HoverMode.HOLD, position=TARGET, **change)
        block.velocity_increment = [0.0, 0.0, 0.0 if not change else 0.2]
        for n in range(10):
            block.step(n * H, H)
        assert block.thrust_factor == 1.0


def test_starts_of_plans():
    block = begun(active=False)
    assert (block.thrust_acceleration, block.plan_kind, block.finished) == (0.0, 0, False)
    block.active = True
    block.step(0.0, H)
    assert (block.plan_kind, block.plan_time) == (3, 0.0)
    block.target_position = [0.0, 0.0, 100.0]
    block.step(0.1, H)
    assert (block.plan_kind, block.plan_time) == (3, pytest.approx(0.1))
    block.plan_number = 4
    block.step(0.2, H)
    assert (block.plan_kind, block.plan_time) == (1, 0.0)
    block.mode = HoverMode.HOLD
    block.step(0.3, H)
    assert (block.plan_kind, block.plan_time, block.finished) == (0, 0.0, True)
    block.mode = HoverMode.IDLE
    block.step(0.4, H)
    assert (block.thrust_acceleration, block.finished, block.saturated) == (0.0, False, False)
    assert block.angular_acceleration_feed == (0.0, 0.0, 0.0)
    assert block.command_time == pytest.approx(0.5)
    block.active = False
    block.step(0.5, H)
    assert block.thrust_acceleration == 0.0


def test_samples_at_its_period():
    component = BlockInstance(HoverGuidance)
    names = [name for name, _ in component.elements]
    for name, value in (("mode", HoverMode.HOLD), ("mass", MASS), ("uniform_gravity", GRAVITY)):
        component.set([names.index(name)], [value])
    component.start()
    observed = []
    for n in range(8):
        component.do_step(n * 0.05, 0.05)
        observed.append(component.block.command_time)
    assert observed == pytest.approx([0.0, 0.1, 0.1, 0.2, 0.2, 0.3, 0.3, 0.4])
