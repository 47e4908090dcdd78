"""Control of a thrust axis: the law, its linear response, and large rotations along the braking curve.

Truth: the law in numpy; python-control's discrete closed loop of a double integrator for small angles; the bang-bang
rotation in closed form for large angles, whose braking is a quarter of the limit; a command that rotates at a constant
rate, which is followed without error.
"""

import math

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.control.thrust_axis_control import ThrustAxisControl
from perilune.fmus_src.plants.attitude_moon_lander import AttitudeMoonLander

DEGREE = math.pi / 180.0
STEP = 0.1
small = st.floats(-0.2, 0.2)
vectors = st.tuples(small, small, small)


def flown(seconds, direction, rate=(0.0, 0.0, 0.0), **settings):
    """Return tilts of a lander off z, its rates and accelerations, a row per communication point."""
    plant = AttitudeMoonLander(initial_position=[0.0, 0.0, 1e5])
    law = ThrustAxisControl(thrust_direction=list(direction), thrust_direction_rate=list(rate), **settings)
    rows = []
    for k in range(round(seconds / STEP) + 1):
        if k == 0:
            plant.initialize()
        else:
            plant.angular_acceleration = law.angular_acceleration
            plant.step((k - 1) * STEP, STEP)
        law.attitude, law.angular_rate = plant.attitude, plant.angular_rate
        if k == 0:
            law.initialize()
        else:
            law.step((k - 1) * STEP, STEP)
        rows.append([plant.tilt, *plant.attitude, *plant.angular_rate, np.linalg.norm(law.angular_acceleration)])
    return np.array(rows)


@given(vectors, vectors, vectors, vectors, st.floats(0.0, 2.0))
def test_the_command_is_that_of_the_law(axis, rate, turning, feed, since):
    """Without limits, small enough for the linear closing rate to be the least or not."""
    attitude = np.array([axis[0], axis[1], 1.0]) / np.linalg.norm([axis[0], axis[1], 1.0])
    block = ThrustAxisControl(
        attitude=attitude.tolist(),
        angular_rate=list(rate),
        thrust_direction=[0.0, 0.6, 0.8],
        thrust_direction_rate=list(turning),
        angular_acceleration_feed=list(feed),
        command_time=-since,
        maximum_angular_acceleration=0.0,
    )
    block.initialize()
    raw = np.array([0.0, 0.6, 0.8]) + since * np.array(turning)
    goal = raw / np.linalg.norm(raw)
    step = 1e-6
    later = raw + step * np.array(turning)
    derivative = (later / np.linalg.norm(later) - goal) / step
    around = np.cross(attitude, goal)
    angle = math.atan2(np.linalg.norm(around), attitude @ goal)
    speed = min(0.8 * angle, math.sqrt(0.5 * DEGREE * angle), 10.0 * DEGREE)
    desired = np.cross(goal, derivative) + speed * around / np.linalg.norm(around)
    assert block.angular_acceleration == pytest.approx(np.array(feed) + 1.5 * (desired - rate), abs=1e-5)
    assert block.direction_error == pytest.approx(angle, abs=1e-12)
    assert block.status == 0


def test_small_angles_close_as_the_linear_loop_does():
    """angle'' = -1.5 (0.8 angle + angle'), sampled: python-control's zero-order hold and feedback."""
    plant = control.c2d(control.ss([[0.0, 1.0], [0.0, 0.0]], [[0.0], [1.0]], np.eye(2), np.zeros((2, 1))), STEP, "zoh")
    closed = plant.A - plant.B @ np.array([[1.5 * 0.8, 1.5]])
    goal = 1e-4
    actual = flown(12.0, [math.sin(goal), 0.0, math.cos(goal)])
    state = np.array([goal, 0.0])  # error, and minus the rate
    for row in actual:
        assert goal - row[0] == pytest.approx(state[0], abs=1e-11)
        assert -row[5] == pytest.approx(state[1], abs=1e-11)
        state = closed @ state


@pytest.mark.parametrize("degrees", [15.0, 40.0, 90.0])
def test_large_turns_follow_the_braking_curve(degrees):
    """Between two bang-bang turns in closed form: full limit up and down, and up with it but down with a quarter."""
    angle = degrees * DEGREE
    actual = flown(90.0, [math.sin(angle), 0.0, math.cos(angle)])
    left = angle - actual[:, 0]
    up, down = DEGREE, 0.25 * DEGREE
    top = math.sqrt(2.0 * angle / (1.0 / up + 1.0 / down))
    assert 0.95 * top < actual[:, 5].max() < top
    late = np.flatnonzero(np.abs(left) > 0.5 * DEGREE)[-1] * STEP
    assert 2.0 * math.sqrt(angle / up) < late < top / up + top / down
    assert left.min() > -0.1 * DEGREE  # hardly a swing to the other side
    assert actual[:, 7].max() <= DEGREE * (1.0 + 1e-12)
    braking = (left < 0.6 * angle) & (left > 2.0 * DEGREE)
    # the rate follows the curve 1/rate_gain late
    assert actual[braking, 5] == pytest.approx(np.sqrt(2.0 * down * left[braking]) + down / 1.5, rel=0.06)
    assert np.median(actual[braking, 7]) == pytest.approx(down, rel=0.1)


def test_opposite_directions_turn_too():
    actual = flown(120.0, [0.0, 0.0, -1.0])
    assert actual[-1][0] == pytest.approx(math.pi, abs=1e-3)


def test_a_command_that_turns_steadily_is_followed_without_error():
    """As the direction is not normalised its rate falls; it still is the goal's own derivative that is followed."""
    rate = 0.01
    actual = flown(40.0, [0.0, 0.0, 1.0], [rate, 0.0, 0.0])
    goal = np.arctan(rate * STEP * np.arange(len(actual)))
    assert np.abs(actual[200:, 0] - goal[200:]).max() < 0.05 * DEGREE


@given(vectors, st.floats(0.1, 50.0))
def test_status_tells_a_shortened_command(rate, times):
    block = ThrustAxisControl(angular_rate=[times * x for x in rate])
    block.initialize()
    demanded = 1.5 * times * np.linalg.norm(rate)
    assert block.status == int(demanded > DEGREE)
    assert np.linalg.norm(block.angular_acceleration) == pytest.approx(min(demanded, DEGREE), abs=1e-12)


@pytest.mark.parametrize("direction", [[0.0, 0.0, 0.0], [1e200, 1e200, 0.0], [1e-300, 0.0, 0.0]])
def test_a_direction_without_length_damps_the_rate_only(direction):
    block = ThrustAxisControl(
        thrust_direction=direction, angular_rate=[0.001, -0.002, 0.0], angular_acceleration_feed=[0.0, 0.0, 0.003]
    )
    block.initialize()
    assert block.angular_acceleration == pytest.approx([-0.0015, 0.003, 0.003])
    assert block.direction_error == 0.0


def test_no_number_stays_none():
    block = ThrustAxisControl(thrust_direction=[math.nan, 0.0, 1.0])
    block.initialize()
    assert all(math.isnan(x) for x in block.angular_acceleration)


def test_the_law_does_not_depend_on_the_frame():
    turn = Rotation.from_rotvec([0.4, -1.1, 0.7])

    def command(rotation):
        block = ThrustAxisControl(
            attitude=rotation.apply([0.0, 0.0, 1.0]).tolist(),
            angular_rate=rotation.apply([0.01, 0.02, 0.0]).tolist(),
            thrust_direction=rotation.apply([0.2, 0.1, 0.9]).tolist(),
            thrust_direction_rate=rotation.apply([0.01, 0.0, 0.02]).tolist(),
        )
        block.initialize()
        return np.array(block.angular_acceleration)

    assert command(turn) == pytest.approx(turn.apply(command(Rotation.identity())), abs=1e-15)
