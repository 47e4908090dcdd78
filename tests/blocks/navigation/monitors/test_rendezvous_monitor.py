"""Rendezvous monitor. Truth: vectors by numpy and rotations by scipy."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from perilune.fmus_src.navigation.rendezvous_monitor import ClosingStart, RendezvousMonitor

vectors = st.lists(st.floats(-500.0, 500.0), min_size=3, max_size=3)
rotations = st.lists(st.floats(-1.7, 1.7), min_size=3, max_size=3)


@given(vectors, vectors, vectors, rotations, rotations)
def test_errors_are_true_less_planned(robot, target, planned, attitude, goal):
    true, plan = Rotation.from_rotvec(attitude), Rotation.from_rotvec(goal)
    block = RendezvousMonitor()
    block.robot_position, block.target_position, block.planned_relative_position = robot, target, planned
    block.quaternion = true.as_quat(scalar_first=True).tolist()
    block.planned_quaternion = plan.as_quat(scalar_first=True).tolist()
    block.initialize()
    relative = np.subtract(target, robot)
    assert block.position_error == pytest.approx(planned - relative, abs=1e-12)
    assert block.range == pytest.approx(np.linalg.norm(relative), rel=1e-14)
    assert block.range_error == pytest.approx(np.linalg.norm(relative) - np.linalg.norm(planned), abs=1e-11)
    error = plan.inv() * true
    assert block.attitude_error_angle == pytest.approx(error.magnitude(), abs=1e-9)
    if error.magnitude() < 3.1:  # half a turn has two axes
        assert block.attitude_error == pytest.approx(error.as_rotvec(), abs=1e-7)
    if true.magnitude() < 3.1:
        assert block.rodrigues == pytest.approx(true.as_mrp(), abs=1e-9)


def test_robot_displaced_from_its_place_shows_its_own_error():
    block = RendezvousMonitor(target_position=[100.0, 0.0, 0.0], planned_relative_position=[30.0, 0.0, 0.0])
    block.robot_position = [70.2, -0.1, 0.0]  # the place is at 70, 0, 0
    block.initialize()
    block.step(0.0, 0.125)
    assert block.position_error == pytest.approx([0.2, -0.1, 0.0], abs=1e-12)


def closing(robot, velocity, **parameters):
    """Return a monitor of a robot at a position relative to an object with a velocity."""
    block = RendezvousMonitor(**parameters)
    block.target_position = [10.0, -20.0, 5.0]
    block.robot_position = np.add(block.target_position, robot).tolist()
    block.target_velocity = velocity
    block.initialize()
    return block


@pytest.mark.parametrize(
    ("degrees", "expected"), [(0.0, ClosingStart.WITHIN_CONE), (59.9, ClosingStart.WITHIN_CONE), (60.1, 2), (180.0, 2)]
)
def test_the_cone_is_about_the_reversed_velocity_of_the_object(degrees, expected):
    angle = np.radians(degrees)
    block = closing([-400.0 * np.cos(angle), 400.0 * np.sin(angle), 0.0], [0.1, 0.0, 0.0])
    assert block.cone_angle == pytest.approx(angle, abs=1e-12)
    assert block.closing_start == expected


def test_the_closing_begins_once():
    block = closing([-502.0, 0.0, 0.0], [0.1, 0.0, 0.0])
    assert block.closing_start == ClosingStart.AWAITED
    block.robot_position = np.add(block.target_position, [0.0, 500.0, 0.0]).tolist()
    block.step(0.0, 0.125)
    assert block.closing_start == ClosingStart.OUTSIDE_CONE
    block.robot_position = np.add(block.target_position, [-30.0, 0.0, 0.0]).tolist()
    block.step(0.125, 0.125)
    assert (block.cone_angle, block.closing_start) == (0.0, ClosingStart.OUTSIDE_CONE)


@pytest.mark.parametrize(("robot", "velocity"), [([0.0] * 3, [0.1, 0.0, 0.0]), ([30.0, 0.0, 0.0], [0.0] * 3)])
def test_no_direction(robot, velocity):
    block = closing(robot, velocity)
    assert (block.cone_angle, block.closing_start) == (0.0, ClosingStart.NO_DIRECTION)
