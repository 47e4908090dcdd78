"""Attitude control by reaction wheels: torque from errors of attitude and angular velocity."""

import math

from ..block import Block, Input, Inputs, Output, Parameter, State
from ..interfaces.ports import body, robot, sampling, satellite
from ..interfaces.ports.satellite import AttitudeReference
from ..kernel.enumerations import Enumeration, member
from ..kernel.matrices import zeros
from ..mathlib.attitude.quaternion import difference, is_attitude, normalise, to_body
from ..mathlib.estimation.sensor_errors import LATEST, make_room
from ..mathlib.vectors import Vector3, cross, is_finite, limit_length, norm, vector


class QuaternionFeedbackStatus(Enumeration):
    """Status of the torque command."""

    GOOD = member("good")
    NOT_FINITE = member("last inputs not finite, torque held")
    NO_ATTITUDE = member("no attitude: quaternion shorter than 0.5, no torque")
    OFF = member("off, no torque")


class QuaternionFeedback(Block):
    """Quaternion feedback with gyroscopic decoupling, feedforward of the reference and an optional integral.

    With the vector part q of the shorter rotation C from reference to estimate, d = ω - C ω_r, reference rate ω_r and
    acceleration ε_r, and wheel momentum h:

        τ = ω × (J ω + h) + J (C ε_r + (C ω_r) × ω - 2 k q - c d - i)    i' = 2 (ω_0^2/T) q
        k = ω_0^2 + 2 ζ ω_0/T    c = 2 ζ ω_0 + 1/T

    Without integral_time T, k = ω_0^2 and c = 2 ζ ω_0. The integral acts while 2 |q| is below integral_band.
    error_limit bounds 2 |q|, and thereby limits the rate of a turn without a reference rate to k error_limit/c.
    feedforward_torque is added. While not active, torque and integral are 0. A command acts ``delay`` samples later and
    is held until the next. Inputs that are not finite leave the torque unchanged; without an attitude it is 0.

    Frame: body.

    Assumes a rigid body with a known inertia.

    Source: Wie, Weiss and Arapostathis 1989; Wie 1998, section 7. See docs/systems/satellite_pointing.md.
    """

    default_step = 0.125

    inertia = satellite.INERTIA.parameter(
        description="inertia matrix of the satellite with its wheels, as known on board"
    )
    natural_frequency = Parameter(
        0.3, unit="rad/s", minimum=0.0, description="natural frequency w0 of the closed attitude loop"
    )
    damping = Parameter(0.9, unit="1", minimum=0.0, description="damping ratio z of the closed attitude loop")
    integral_time = Parameter(
        0.0, unit="s", minimum=0.0, description="time constant T of the integral term; 0: no integral term"
    )
    integral_band = Parameter(
        0.01, unit="rad", minimum=0.0, description="magnitude of the attitude error below which it is integrated"
    )
    error_limit = Parameter(
        2.0,
        unit="rad",
        minimum=0.0,
        description="magnitude to which the attitude error 2 |q| is limited in the torque command",
    )
    delay = Parameter(0, minimum=0, maximum=LATEST, description="computing delay of a torque command, in samples")
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.125, "sample period of the control; 0: a sample at every communication point"
    )
    estimated_quaternion = robot.QUATERNION.input()
    estimated_angular_velocity = body.ANGULAR_VELOCITY.input(
        "estimated angular velocity of the body relative to the inertial frame"
    )
    reference = Inputs(AttitudeReference)
    wheel_momentum = satellite.WHEEL_MOMENTUM.input("angular momentum of the wheels relative to the body")
    feedforward_torque = body.TORQUE.input(
        "additional torque on the body, such as the compensation of the magnetic torque"
    )
    active = Input(True, description="true: control active; false: no torque and no integration")
    torque_command = body.TORQUE.output("commanded torque of the wheels on the body", direct=True)
    attitude_error = body.ROTATION.output(
        "attitude error 2 q: twice the vector part of the quaternion from reference to estimated attitude", direct=True
    )
    status = Output(QuaternionFeedbackStatus, direct=True)
    integral = body.ANGULAR_ACCELERATION.state("integral term of the commanded angular acceleration")
    commands = State(
        zeros(LATEST + 1, 3), unit="N.m", frame="body", description="last computed torque commands, newest first"
    )
    period = State(0.0, unit="s", description="time to the next control sample")

    def initialize(self) -> None:
        self.period = self.sample_period
        self.tick()

    def finite(self) -> bool:
        """Return True if all inputs are finite."""
        q = self.estimated_quaternion
        r = self.reference.reference_quaternion
        attitudes = math.isfinite(q.w) and is_finite(q[1:4]) and math.isfinite(r.w) and is_finite(r[1:4])
        rates = is_finite(self.estimated_angular_velocity) and is_finite(self.reference.reference_angular_velocity)
        known = is_finite(self.reference.reference_angular_acceleration) and is_finite(self.wheel_momentum)
        return attitudes and rates and known and is_finite(self.feedforward_torque)

    def correction(self, error: Vector3, rate_error: Vector3) -> Vector3:
        """Return the correction to subtract from the angular acceleration (rad/s2), and advance the integral."""
        w = self.natural_frequency
        stiffness = w * w
        damping = 2.0 * self.damping * w
        if self.integral_time > 0.0:
            stiffness = stiffness + damping / self.integral_time
            damping = damping + 1.0 / self.integral_time
            if norm(error) < self.integral_band:
                self.integral = self.integral + self.period * w * w / self.integral_time * error
        return stiffness * limit_length(error, self.error_limit) + damping * rate_error + self.integral

    def command(self) -> None:
        """Compute a new torque command."""
        if not self.active:
            self.status = QuaternionFeedbackStatus.OFF
            self.torque_command = vector(0.0, 0.0, 0.0)
            self.integral = vector(0.0, 0.0, 0.0)
            return
        if not self.finite():
            self.status = QuaternionFeedbackStatus.NOT_FINITE
            return
        if not (is_attitude(self.estimated_quaternion) and is_attitude(self.reference.reference_quaternion)):
            self.status = QuaternionFeedbackStatus.NO_ATTITUDE
            self.torque_command = vector(0.0, 0.0, 0.0)
            return
        self.status = QuaternionFeedbackStatus.GOOD
        rotation = difference(normalise(self.reference.reference_quaternion), normalise(self.estimated_quaternion))
        self.attitude_error = 2.0 * rotation[1:4]
        w = self.estimated_angular_velocity
        reference_rate_body = to_body(rotation, self.reference.reference_angular_velocity)
        acceleration_body = to_body(rotation, self.reference.reference_angular_acceleration) + cross(
            reference_rate_body, w
        )
        correction = self.correction(self.attitude_error, w - reference_rate_body)
        acceleration_body = acceleration_body - correction
        self.torque_command = cross(w, self.inertia @ w + self.wheel_momentum) + self.inertia @ acceleration_body
        if norm(self.feedforward_torque) > 0.0:
            self.torque_command = self.torque_command + self.feedforward_torque

    def tick(self) -> None:
        """Compute a new torque command, and output the one that is due."""
        if self.delay == 0:
            self.command()
            return
        self.torque_command = self.commands[0, 0:3]
        self.command()
        make_room(self.commands, 3)
        self.commands[0, 0:3] = self.torque_command
        self.torque_command = self.commands[self.delay, 0:3]

    def step(self, t: float, h: float) -> None:
        self.period = self.sample_period
        if self.period <= 0.0:
            self.period = h
        self.tick()
