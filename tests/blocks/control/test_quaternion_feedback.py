"""Quaternion feedback: rotations about the eigenaxis in closed loop with the satellite; limits and statuses.

Truth: Wie, Weiss and Arapostathis 1989: with gains proportional to the inertia and the gyroscopic torque cancelled, a
satellite at rest turns about the eigenaxis of its error e, and e'' = -k 2 sin(e/2) - c e', by scipy's DOP853.
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from perilune.fmus_src.actuators.wheel_allocation_pseudo_inverse import WheelAllocationPseudoInverse
from perilune.fmus_src.control.quaternion_feedback import QuaternionFeedback, QuaternionFeedbackStatus
from perilune.fmus_src.plants.wheel_satellite import WheelSatellite

STEP = 0.01
AXIS = np.array([0.48, -0.6, 0.64])


def turn_back(angle, seconds, error_limit=10.0, bias=0.0, known=1.0):
    """Return rotation vectors of a satellite that is fed back to the reference from an error; wheels turn at
    ``bias``."""
    satellite = WheelSatellite(
        speed_limit=0.0, motor_torque_limit=1e3, viscous_friction=0.0, coulomb_friction=0.0, internal_step=STEP
    )
    satellite.initial_quaternion = Rotation.from_rotvec(angle * AXIS).as_quat(scalar_first=True).tolist()
    satellite.initial_wheel_speeds = [bias, 0.0, -bias, 0.5 * bias]
    satellite.initialize()
    control = QuaternionFeedback(error_limit=error_limit, sample_period=STEP)
    wheels = WheelAllocationPseudoInverse(motor_torque_limit=1e3, null_gain=0.0, sample_period=STEP)
    for block in (control, wheels):
        block.initialize()
    rows = []
    for n in range(round(seconds / STEP)):
        control.estimated_quaternion = satellite.quaternion
        control.estimated_angular_velocity = satellite.angular_velocity
        control.wheel_momentum = known * satellite.wheel_momentum
        control.step(n * STEP, STEP)
        wheels.torque_command = control.torque_command
        wheels.step(n * STEP, STEP)
        satellite.motor_torques = wheels.motor_torques
        satellite.step(n * STEP, STEP)
        rows.append(Rotation.from_quat([*satellite.quaternion], scalar_first=True).as_rotvec())
    return np.array(rows)


def test_a_turn_is_about_the_eigenaxis_and_follows_its_equation():
    """To the first order in the step, and 3e-4 of the inertia: the control counts the wheels as the body's."""
    rows = turn_back(2.5, 12.0)
    angles = np.linalg.norm(rows, axis=1)
    across = rows - np.outer(rows @ AXIS, AXIS)
    assert np.abs(across).max() < 2e-3
    k, c = 0.3**2, 2.0 * 0.9 * 0.3
    solution = solve_ivp(
        lambda t, y: [y[1], -k * 2.0 * math.sin(0.5 * y[0]) - c * y[1]],
        (0.0, 12.0),
        [2.5, 0.0],
        method="DOP853",
        rtol=1e-10,
        t_eval=STEP * np.arange(1, len(angles) + 1),
    )
    np.testing.assert_allclose(angles, solution.y[0], atol=5e-3)
    assert angles[-1] < 0.6


def test_wheels_that_spin_do_not_push_it_off_the_axis():
    """Their gyroscopic torque is fed forward; where control takes their momentum for 0 they do."""
    across = []
    for known in (1.0, 0.0):
        rows = turn_back(1.0, 6.0, bias=100.0, known=known)
        across.append(np.abs(rows - np.outer(rows @ AXIS, AXIS)).max())
    assert across[0] < 4e-3
    assert across[1] > 10.0 * across[0]


def test_an_error_limit_bounds_the_rate():
    """k 2 |q| is bounded, and with it the rate at which damping equals it: k limit/c."""
    rows = turn_back(2.5, 20.0, error_limit=0.1)
    rates = -np.diff(np.linalg.norm(rows, axis=1)) / STEP
    bound = 0.3**2 * 0.1 / (2.0 * 0.9 * 0.3)
    assert rates.max() == pytest.approx(bound, rel=5e-3)


NAMES = ["estimated_quaternion", "estimated_angular_velocity", "wheel_momentum", "feedforward_torque"]


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("wrong", [math.nan, math.inf])
def test_what_is_not_finite_leaves_the_torque_as_it_is(name, wrong):
    control = QuaternionFeedback()
    control.initialize()
    control.estimated_angular_velocity = [0.01, 0.0, 0.0]
    control.step(0.0, 0.125)
    before = tuple(control.torque_command)
    assert any(before)
    values = list(getattr(control, name))
    setattr(control, name, [wrong, *values[1:]])
    control.step(0.125, 0.125)
    assert control.status == QuaternionFeedbackStatus.NOT_FINITE
    assert tuple(control.torque_command) == before
    setattr(control, name, values)
    control.step(0.25, 0.125)
    assert control.status == QuaternionFeedbackStatus.GOOD


def test_the_integral_takes_a_constant_torque_off():
    """At rest with an error e the torque grows by J w0^2/T e per second, beyond what it had."""
    control = QuaternionFeedback(integral_time=20.0)
    control.estimated_quaternion = Rotation.from_rotvec([2e-3, 0.0, 0.0]).as_quat(scalar_first=True).tolist()
    control.initialize()
    first = control.torque_command.x
    for n in range(80):
        control.step(0.125 * n, 0.125)
    assert control.torque_command.x - first == pytest.approx(-180.0 * 0.3**2 / 20.0 * 2e-3 * 10.0, rel=1e-5)


def wrong_attitude(**inputs):
    """Return a control at a constant error of attitude and rate, with an integral."""
    return QuaternionFeedback(
        integral_time=20.0,
        estimated_quaternion=Rotation.from_rotvec([2e-3, -1e-3, 3e-3]).as_quat(scalar_first=True).tolist(),
        estimated_angular_velocity=[1e-3, 2e-3, -1e-3],
        **inputs,
    )


def test_a_torque_fed_forward_is_added_and_changes_no_bit_at_its_start():
    torque = np.array([0.01, -0.02, 0.03])
    plain, zero, fed = wrong_attitude(), wrong_attitude(), wrong_attitude(feedforward_torque=torque.tolist())
    zero.feedforward_torque = [-0.0, 0.0, -0.0]
    for control in (plain, zero, fed):
        control.initialize()
    for n in range(3):
        for control in (plain, zero, fed):
            control.step(0.125 * n, 0.125)
        assert tuple(plain.torque_command) == tuple(zero.torque_command)
        np.testing.assert_allclose(np.subtract(fed.torque_command, plain.torque_command), torque, atol=1e-16)


def test_off_there_is_no_torque_and_the_integral_begins_again():
    """On again the torque is that of the first tick of another control, to the bit."""
    fresh, control = wrong_attitude(feedforward_torque=[0.1, 0.0, 0.0]), wrong_attitude()
    fresh.initialize()
    control.feedforward_torque = [0.1, 0.0, 0.0]
    control.initialize()
    control.step(0.0, 0.125)
    assert tuple(control.torque_command) != tuple(fresh.torque_command)
    control.active, control.wheel_momentum = False, [math.nan, 0.0, 0.0]
    control.step(0.125, 0.125)
    assert control.status == QuaternionFeedbackStatus.OFF
    assert tuple(control.torque_command) == (0.0, 0.0, 0.0)
    control.active, control.wheel_momentum = True, [0.0, 0.0, 0.0]
    control.step(0.25, 0.125)
    assert control.status == QuaternionFeedbackStatus.GOOD
    assert tuple(control.torque_command) == tuple(fresh.torque_command)
