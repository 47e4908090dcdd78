"""Plans of hover guidance: kinds, statuses, reference and feedforward, and arrival of a point mass that follows them.

Truth: a point mass integrated by scipy under the block's commands; the paper's full equations by scipy, rotated into
space by numpy; closed forms of a slow transfer and of a descent with a speed ramp; numerical differences of the planned
direction.
"""

import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from perilune.fmus_src.interfaces.ports.landing import HoverMode
from perilune.fmus_src.mathlib.hover.motion import HoverVehicle
from tests.support.flights.hover_equations import flown
from tests.support.flights.hover_flight import EXHAUST, GRAVITY, MASS, START, TARGET, H, begun, fly, last

RADIUS, MU = 1.7374e6, 4.9028e12


def test_a_point_mass_flies_the_plan():
    block = begun()
    assert (block.status, block.plan_kind) == (0, 3)
    assert list(block.programme) == pytest.approx([18.430, 64.428, 1.5178, 11.309, 82.186], abs=0.005)
    assert block.predicted_propellant == pytest.approx(600.0 * 0.052518, abs=1e-3)
    duration = block.programme[4]
    worst = 0.0
    for t, state in fly(block, duration + 10.0):
        worst = max(worst, np.linalg.norm(state[:3] - block.reference_position))
        assert not block.saturated
        assert block.finished == (t >= duration - 1e-9)
        if abs(t - duration) <= 0.5 * H:
            assert state[:3] == pytest.approx(TARGET, abs=0.05)
            assert np.linalg.norm(state[3:5]) < 0.005
            assert MASS - state[6] == pytest.approx(block.predicted_propellant, abs=0.05)
    assert worst < 0.15
    assert block.thrust_factor == pytest.approx(1.0, abs=1e-4)
    assert state[:6] == pytest.approx([*TARGET, 0.0, 0.0, 0.0], abs=0.03)
    assert block.thrust_direction == pytest.approx([0.0, 0.0, 1.0], abs=1e-3)


@pytest.mark.parametrize("t", [0.0, 12.0, 19.0, 40.0, 75.0])
def test_the_reference_is_the_programme_in_space(t):
    """Off the site's vertical, in a central field: the plane through start and target, with the target's vertical."""
    start, target = np.array([-700.0, 900.0, 2500.0]), np.array([400.0, -300.0, 90.0])
    block = begun(uniform_gravity=0.0, position=start, target_position=target)
    block.reference(t)
    centre = np.array([0.0, 0.0, -RADIUS])
    up = (target - centre) / np.linalg.norm(target - centre)
    way = target - start
    side = way - (way @ up) * up
    along = side / np.linalg.norm(side)
    gravity = np.mean([MU / np.sum((r - centre) ** 2) for r in (start, target)])
    limits = [0.9 * 4707.192 / MASS, 0.1 * 4707.192 / MASS]
    vehicle = HoverVehicle.of_elements([*limits, EXHAUST, gravity, math.radians(0.7)])
    x, vx, y, vy, _, pitch, rate = flown(block.programme, vehicle.elements(), until=t)
    assert block.reference_position == pytest.approx(start + x * along + y * up, abs=1e-5)
    assert block.reference_velocity == pytest.approx(vx * along + vy * up, abs=1e-6)
    turning = block.plan_direction(t)
    assert turning.direction == pytest.approx(math.cos(pitch) * along + math.sin(pitch) * up, abs=1e-8)
    assert turning.rate == pytest.approx(rate * (-math.sin(pitch) * along + math.cos(pitch) * up), abs=1e-8)
    end = flown(block.programme, vehicle.elements())
    assert [end[0], end[2]] == pytest.approx([np.linalg.norm(side), way @ up], abs=1e-5)


@pytest.mark.parametrize("mode", [HoverMode.PROGRAMME, HoverMode.SLOW, HoverMode.CAPTURE])
def test_the_feed_turns_the_planned_direction(mode):
    start = {
        HoverMode.PROGRAMME: {},
        HoverMode.SLOW: {"position": [1580.0, 30.0, 140.0]},
        HoverMode.CAPTURE: {"velocity": [30.0, 5.0, -20.0], "velocity_increment": [0.0, 0.0, 0.2]},
    }
    block = begun(mode=mode, **start[mode])
    rate = np.array(block.plan_rate(0.0))
    for n in range(int(block.duration / H) - 1):
        rate = rate + H * np.array(block.angular_acceleration_feed)
        block.step(n * H, H)
        t = (n + 1) * H
        before, after = (np.array(block.plan_direction(t + k).direction) for k in (-1e-4, 1e-4))
        truth = np.cross(before, after) / 2e-4
        assert rate == pytest.approx(truth, abs=1e-5)


@pytest.mark.parametrize(
    ("target", "kind"),
    [
        ([0.0, 0.0, 100.0], 1),
        ([0.4, 0.3, 100.0], 1),
        ([200.0, 100.0, 100.0], 2),
        ([-1100.0, 1100.0, 100.0], 3),
        ([100.0, 0.0, 2500.0], 4),
    ],
)
def test_kinds_of_plans_all_arrive(target, kind):
    block = begun(target_position=target)
    assert (block.plan_kind, block.status) == (kind, 1 if kind == 4 else 0)
    assert (np.array(block.programme) == 0.0).all() == (kind == 4)
    end = last(fly(block, math.ceil(block.duration / H) * H))[1]
    assert end[:3] == pytest.approx(target, abs=0.15)
    assert np.linalg.norm(end[3:5]) < 0.03
    assert block.finished


def test_slow_transfer():
    """From rest to rest by the polynomial whose rate is 140 s^3 (1 - s)^3."""
    start, target = [0.0, 0.0, 100.0], [20.0, -10.0, 4.0]
    block = begun(mode=HoverMode.SLOW, position=start, target_position=target, mass=490.0)
    assert (block.plan_kind, block.status) == (4, 0)
    assert block.duration == pytest.approx(2.1875 * 96.0 / 4.0)
    s = 0.3
    block.reference(s * block.duration)
    way = np.array(target) - start
    rate = way / block.duration * 140.0 * s**3 * (1.0 - s) ** 3
    assert block.reference_velocity == pytest.approx(rate, abs=1e-9)
    flight = list(fly(block, math.ceil(block.duration / H) * H, start))
    end = flight[-1][1]
    assert end[:6] == pytest.approx([*target, 0.0, 0.0, 0.0], abs=0.03)
    assert 490.0 - end[6] == pytest.approx(block.predicted_propellant, rel=2e-3)


def capturing(**changes):
    """Capture from the end of a braking, the thrust axis 62 deg off the vertical and turning."""
    axis = np.array([math.sin(math.radians(62.0)), 0.0, math.cos(math.radians(62.0))])
    values = {
        "mode": HoverMode.CAPTURE,
        "uniform_gravity": 0.0,
        "position": [1700.0, 20.0, 2769.0],
        "velocity": [-120.0, -1.0, -25.0],
        "target_position": [0.0, 0.0, 2400.0],
        "attitude": axis,
        "angular_rate": [0.0, -0.004, 0.0],
        "velocity_increment": 0.49 * axis,
        "mass": 560.0,
        "maximum_thrust": 5099.0,
        "minimum_thrust": 340.0,
        "specific_impulse": 319.0,
    }
    return begun(**{**values, **changes})


def test_capture_begins_as_it_flies_and_ends_in_a_hover():
    block = capturing()
    assert (block.plan_kind, block.status) == (4, 0)
    assert block.plan_motion(0.0).position == pytest.approx([1700.0, 20.0, 2769.0])
    assert block.plan_motion(0.0).velocity == pytest.approx([-120.0, -1.0, -25.0])
    turning = block.plan_direction(0.0)
    assert turning.direction == pytest.approx(block.attitude, abs=1e-9)
    assert np.cross(turning.direction, turning.rate) == pytest.approx([0.0, -0.004, 0.0], abs=1e-9)
    assert block.plan_impulse(0.0, 1e-4) == pytest.approx(4.9e-4, rel=1e-4)
    end = block.duration
    assert block.plan_motion(end - 1e-6).position == pytest.approx([0.0, 0.0, 2400.0], abs=1e-6)
    assert block.plan_direction(end - 1e-6).direction == pytest.approx([0.0, 0.0, 1.0], abs=1e-6)
    impulse = quad(lambda t: block.plan_impulse(t, t + 1e-6) * 1e6, 0.0, end)[0]
    spent = 560.0 * (1.0 - math.exp(-impulse / (319.0 * 9.80665)))
    assert block.predicted_propellant == pytest.approx(spent, rel=2e-3)


def test_capture_beyond_limits():
    assert capturing(maximum_thrust=2500.0).status == 2


def test_descent():
    """The reference sinks with a ramp of speed; feedback alone follows it, as the linear loop does by scipy."""
    block = begun(mode=HoverMode.DESCEND, position=[0.0, 0.0, 4.0], target_position=[0.0, 0.0, 4.0], mass=480.0)
    assert (block.status, block.finished) == (0, False)
    w, damping = block.holding_frequency, block.damping

    def sunk(t):
        return (0.15 * t * t, 0.3 * t) if t <= 1.0 / 0.3 else (0.15 / 0.09 + (t - 1.0 / 0.3), 1.0)

    def loop(t, s):
        way, speed = sunk(t)
        return [s[1], w * (w * (4.0 - way - s[0]) + 2.0 * damping * (-speed - s[1]))]

    linear = solve_ivp(loop, (0.0, 6.0), [4.0, 0.0], rtol=1e-9, atol=1e-9, dense_output=True, max_step=0.1).sol
    for t, state in fly(block, 6.0, [0.0, 0.0, 4.0]):
        assert block.reference_thrust(t, t + 0.1) == pytest.approx(GRAVITY)
        assert block.reference_position == pytest.approx([0.0, 0.0, 4.0 - sunk(t)[0]])
        assert state[[2, 5]] == pytest.approx(linear(t), abs=0.03)  # the block samples every 0.1 s
        assert not block.finished


@pytest.mark.parametrize(
    "change", [{"maximum_thrust": 900.0}, {"mass": math.nan}, {"mass": 0.0}, {"velocity": [math.inf, 0.0, 0.0]}]
)
@pytest.mark.parametrize("mode", [HoverMode.PROGRAMME, HoverMode.SLOW, HoverMode.CAPTURE])
def test_no_plan_possible_holds_where_it_is(mode, change):
    block = begun(mode=mode, **change)
    assert (block.status, block.plan_kind, block.predicted_propellant) == (3, 0, 0.0)
    assert block.reference_position == pytest.approx(START)
    assert block.finished


def test_a_capture_at_rest_with_the_engine_off_is_short():
    """Nothing is planned but the weight where it hovers already: no limit broken, no distance lost."""
    block = capturing(
        position=[0.0, 0.0, 2400.0],
        velocity=[0.0] * 3,
        attitude=[0.0, 0.0, 1.0],
        angular_rate=[0.0] * 3,
        velocity_increment=[0.0] * 3,
    )
    assert block.status == 0
    assert block.duration < 12.0
    gravity = block.gravity_at(block.position)
    assert block.thrust_acceleration == pytest.approx(gravity, rel=0.01)
    # the weight over the time of the plan, and no more
    assert block.predicted_propellant == pytest.approx(560.0 * gravity * block.duration / (319.0 * 9.80665), rel=0.01)
    for n in range(int(block.duration / H)):
        assert block.plan_motion(n * H).position == pytest.approx([0.0, 0.0, 2400.0], abs=0.2)
