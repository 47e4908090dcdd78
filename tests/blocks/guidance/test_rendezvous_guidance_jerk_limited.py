"""Plan of an approach whose turn takes the least time within limits of rate, acceleration and jerk.

Truth: the plan without these limits, which differs in the turn alone; seven segments of constant jerk by hand; scipy's
rotations.
"""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from perilune.fmus_src.guidance.rendezvous_guidance import RendezvousGuidance, RendezvousStatus
from perilune.fmus_src.guidance.rendezvous_guidance_jerk_limited import RendezvousGuidanceJerkLimited

SPIN = np.array([-0.608, 0.228, 0.760]) / np.linalg.norm([-0.608, 0.228, 0.760])
ANGLE = math.acos(SPIN[0])
RATE, ACCELERATION, JERK = 0.03, 1.8e-3, 2.6e-4


def guidance(kind=RendezvousGuidanceJerkLimited, **parameters):
    block = kind(**parameters)
    block.initialize()
    return block


def planned(block, time):
    """Return translation, and the turn, planned for a time."""
    block.publish(time)
    translation = [*block.planned_position, *block.planned_velocity, *block.planned_relative_position]
    turn = [*block.planned_quaternion, *block.planned_angular_velocity, *block.planned_angular_acceleration]
    return translation, turn


def test_only_the_turn_differs():
    ours, other = guidance(attitude_period=0.0), guidance(RendezvousGuidance, attitude_period=0.0)
    assert ours.planned_acceleration == other.planned_acceleration
    for time in (0.0, 700.0, 1420.0, 1450.0, 1520.0, 3000.0, 4250.0, 5000.0):
        (translation, turn), (expected, other_turn) = planned(ours, time), planned(other, time)
        assert translation == expected
        if time == 1450.0:
            assert turn != other_turn
        else:
            assert turn == pytest.approx(other_turn, abs=1e-15)


def test_the_turn_is_within_its_limits_and_as_long_as_by_hand():
    block = guidance(attitude_period=0.0)
    assert block.turn_duration == pytest.approx(ANGLE / RATE + RATE / ACCELERATION + ACCELERATION / JERK, rel=1e-12)
    assert block.turn_duration < 100.0
    times = np.linspace(1415.0, 1525.0, 2201)
    rows = np.array([planned(block, time)[1] for time in times])
    rates, accelerations = (np.linalg.norm(rows[:, k : k + 3], axis=1) for k in (4, 7))
    assert rates.max() == pytest.approx(RATE, rel=1e-12)
    assert accelerations.max() == pytest.approx(ACCELERATION, rel=1e-12)
    jerks = np.linalg.norm(np.diff(rows[:, 7:], axis=0), axis=1) / np.diff(times)
    assert jerks.max() == pytest.approx(JERK, rel=1e-6)
    camera = Rotation.from_quat(rows[-1, :4], scalar_first=True).apply([1.0, 0.0, 0.0])
    assert camera == pytest.approx(SPIN, abs=1e-12)


def test_acceleration_is_that_of_the_middle_of_the_attitude_period():
    ahead, now = guidance(), guidance(attitude_period=0.0)
    for time in (1419.9, 1420.0, 1444.0, 1517.0, 1520.0):
        ahead.publish(time)
        now.publish(time + 0.125)
        assert ahead.planned_angular_acceleration == pytest.approx(now.planned_angular_acceleration, abs=1e-15)


def test_a_turn_longer_than_its_phase_has_no_plan():
    block = guidance(turn_rate_limit=0.025)
    assert block.turn_duration > 100.0
    assert block.status == RendezvousStatus.TURN_TOO_LONG
    translation, turn = planned(block, 1500.0)
    assert translation[:6] == [0.0] * 6
    assert turn == [1.0, *[0.0] * 9]
    assert guidance(turn_rate_limit=0.025, turn_end=1535.0).status == RendezvousStatus.GOOD
