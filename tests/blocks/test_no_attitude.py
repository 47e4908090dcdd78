"""Zero quaternions of a lost star tracker: control gives no torque, filters make no update, and both report it.

Truth: the same block without the sample, or without the command.
"""

import math

import numpy as np
import pytest

import perilune
from perilune.fmus_src.actuators.jet_allocation import JetAllocationStatus
from perilune.fmus_src.actuators.jet_allocation_pseudo_inverse import JetAllocationPseudoInverse
from perilune.fmus_src.control.quaternion_feedback import QuaternionFeedback, QuaternionFeedbackStatus
from perilune.fmus_src.guidance.slew_guidance import SlewPhase
from perilune.fmus_src.guidance.slew_quintic import SlewQuintic
from perilune.fmus_src.interfaces.ports.robot import FilterMethod, SampleStatus
from perilune.fmus_src.mathlib.attitude.quaternion import is_attitude
from perilune.fmus_src.mathlib.vectors import vector
from perilune.fmus_src.navigation.attitude_filter import AttitudeFilter
from perilune.fmus_src.navigation.attitude_navigation import AttitudeNavigationStatus
from perilune.fmus_src.navigation.attitude_navigation_filter import AttitudeNavigationFilter
from perilune.fmus_src.navigation.translation_filter import TranslationFilter
from tests.support.lengths import either

ATTITUDE = [math.cos(0.1), math.sin(0.1), 0.0, 0.0]
LOST = [[0.0] * 4, [0.3, 0.2, -0.2, 0.1]]
lost = pytest.mark.parametrize("quaternion", LOST)


@pytest.mark.parametrize(
    ("quaternion", "expected"),
    [
        (ATTITUDE, True),
        ([0.0, 0.0, 0.0, -0.5], True),
        ([0.3] * 4, True),
        ([1e300] * 4, True),
        ([0.0] * 4, False),
        ([0.24] * 4, False),
        ([math.nan] * 4, False),
    ],
)
def test_what_is_an_attitude(quaternion, expected):
    assert is_attitude(vector(*quaternion)) is expected


@lost
@pytest.mark.parametrize("connector", ["estimated_quaternion", "reference.reference_quaternion"])
def test_quaternion_feedback_gives_no_torque(quaternion, connector):
    control = QuaternionFeedback()
    control.estimated_quaternion = ATTITUDE
    control.initialize()
    assert np.linalg.norm(control.torque_command) > 0.0
    holder, name = (control.reference, connector.partition(".")[2]) if "." in connector else (control, connector)
    before = list(getattr(holder, name))
    setattr(holder, name, quaternion)
    control.step(0.0, 0.125)
    assert (list(control.torque_command), control.status) == ([0.0] * 3, QuaternionFeedbackStatus.NO_ATTITUDE)
    setattr(holder, name, before)
    control.step(0.125, 0.125)
    assert control.status == QuaternionFeedbackStatus.GOOD
    assert np.linalg.norm(control.torque_command) > 0.0


@lost
def test_a_lost_star_sample_is_no_update(quaternion):
    with_it, without = (AttitudeNavigationFilter() for _ in range(2))
    for block in (with_it, without):
        block.star_count = 1
        block.measured_quaternion = ATTITUDE
        block.initialize()
        block.measured_angular_velocity = [1e-3, 0.0, 0.0]
        block.gyro_count = 1
    with_it.measured_quaternion = quaternion
    with_it.star_count = 2
    for block in (with_it, without):
        block.step(0.0, 0.125)
    assert (with_it.status, without.status) == (AttitudeNavigationStatus.NO_ATTITUDE, AttitudeNavigationStatus.GOOD)
    for name in ("estimated_quaternion", "estimated_bias", "attitude_sigma", "bias_sigma"):
        assert list(getattr(with_it, name)) == list(getattr(without, name))


@lost
def test_the_first_attitude_is_the_first_that_is_one(quaternion):
    block = AttitudeNavigationFilter()
    block.star_count, block.measured_quaternion = 1, quaternion
    block.initialize()
    assert block.status == AttitudeNavigationStatus.NO_ATTITUDE
    block.star_count, block.measured_quaternion = 2, ATTITUDE
    block.step(0.0, 0.125)
    assert block.status == AttitudeNavigationStatus.GOOD
    assert list(block.estimated_quaternion) == pytest.approx(ATTITUDE, abs=1e-15)


@lost
@pytest.mark.parametrize("method", [FilterMethod.MEAN, FilterMethod.KALMAN])
def test_the_robots_attitude_filter_leaves_it_out(quaternion, method):
    with_it, without = (AttitudeFilter(method=method, mean_samples=1) for _ in range(2))
    for block in (with_it, without):
        block.sample_count, block.measured_quaternion = 1, ATTITUDE
        block.initialize()
    with_it.sample_count, with_it.measured_quaternion = 2, quaternion
    for block in (with_it, without):
        block.step(0.0, 0.125)
    assert (with_it.status, with_it.samples_taken) == (SampleStatus.NO_ATTITUDE, 1)
    for name in ("attitude_error", "rate_error", "quaternion"):
        assert list(getattr(with_it, name)) == list(getattr(without, name))
    error = list(with_it.attitude_error)
    with_it.planned_quaternion = quaternion
    with_it.sample_count, with_it.measured_quaternion = 3, ATTITUDE
    with_it.step(0.125, 0.125)
    assert with_it.status == SampleStatus.NO_ATTITUDE
    assert list(with_it.attitude_error) == error


@lost
def test_a_force_acts_along_the_last_attitude(quaternion):
    with_it, without = (TranslationFilter() for _ in range(2))
    for block in (with_it, without):
        block.sample_count, block.quaternion = 1, ATTITUDE
        block.initialize()
        block.allocated_force = [0.0, 10.0, 0.0]
    with_it.quaternion = quaternion
    for block in (with_it, without):
        block.step(0.0, 0.125)
    assert (with_it.status, without.status) == (SampleStatus.NO_ATTITUDE, SampleStatus.GOOD)
    assert list(with_it.velocity_error) == pytest.approx(list(without.velocity_error), rel=1e-14)
    assert with_it.velocity_error[2] > 0.0


@lost
def test_jets_give_no_thrust(quaternion):
    jets = JetAllocationPseudoInverse(delay_fraction=0.0)
    jets.force_command, jets.command_count = [0.2, 0.0, 0.0], 1
    jets.initialize()
    assert max(jets.jet_thrust) > 0.0
    jets.quaternion, jets.command_count = quaternion, 2
    jets.step(0.0, 0.125)
    assert (list(jets.jet_thrust), jets.status) == ([0.0] * 8, JetAllocationStatus.NO_ATTITUDE)


@lost
def test_a_slew_waits_for_an_attitude(quaternion):
    late, early = (SlewQuintic(slew_start=1.0) for _ in range(2))
    late.estimated_quaternion, early.estimated_quaternion = quaternion, ATTITUDE
    for block in (late, early):
        block.initialize()
    assert (late.phase, early.phase) == (SlewPhase.NO_ATTITUDE, SlewPhase.WAITING)
    assert list(late.reference.reference_quaternion) == [0.0] * 4
    late.step(0.0, 0.125)
    late.estimated_quaternion = ATTITUDE
    late.step(0.125, 0.125)
    assert late.phase == SlewPhase.WAITING
    for n in range(20):
        early.step(0.125 * n, 0.125)
        late.step(0.125 * (n + 2), 0.125)
        assert late.phase == early.phase
        assert list(late.reference.reference_quaternion) == pytest.approx([*early.reference.reference_quaternion])


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("flavour", either(["native", "python"], ["native"]))
def test_a_satellite_flies_through_a_loss_of_its_tracker(flavour):
    """Zeros were normalised to no rotation: the filter took the inertial axes for its attitude, and tumbled."""
    faults = [
        perilune.Fault(f"star.measured_quaternion[{k}]", "override", 0.0, start=60.0, stop=70.0) for k in (1, 2, 3, 4)
    ]
    flight = perilune.simulate("satellite_pointing", faults=faults, stop_time=90.0, flavour=flavour)
    plain = perilune.simulate("satellite_pointing", stop_time=90.0, flavour=flavour)
    now = (flight.time > 60.5) & (flight.time < 69.5)
    assert set(flight["navigation.status"][now]) <= {0.0, float(AttitudeNavigationStatus.NO_ATTITUDE)}
    assert AttitudeNavigationStatus.NO_ATTITUDE in flight["navigation.status"][now]
    apart = [flight[f"satellite.quaternion[{k}]"] - plain[f"satellite.quaternion[{k}]"] for k in (1, 2, 3, 4)]
    assert np.abs(apart).max() < 1e-4
