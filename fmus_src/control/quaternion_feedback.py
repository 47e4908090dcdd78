"""Torque of reaction wheels from attitude and angular velocity, estimated and commanded."""

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
    """Age of the torque."""

    GOOD = member("good")
    NOT_FINITE = member("last inputs not finite, torque held")
    NO_ATTITUDE = member("no attitude: a quaternion shorter than 0.5, no torque")
    OFF = member("off, no torque")


class QuaternionFeedback(Block):
    """Quaternion feedback with gyroscopic feedforward.

    torque = w x (J w + h) + J (C er + (C wr) x w - k 2 q - c d - i).

    q is the vector part of the rotation C from the reference to the estimated attitude, the shorter way round; d =
    w - C wr the error of the angular velocity w; wr and er are the reference's angular velocity and acceleration; h is
    wheel_momentum. With the natural frequency w0 and the damping z, k = w0^2 and c = 2 z w0. An integral_time T > 0
    adds the pole -1/T: k = w0^2 + 2 z w0/T, c = 2 z w0 + 1/T and i' = w0^2/T 2 q, where 2 |q| is below
    integral_band. error_limit bounds 2 |q| in k 2 q, and so the rate of a turn without reference to k error_limit/c.
    feedforward_torque is added. While it is not active the torque and the integral are 0. A command acts ``delay``
    samples after its tick. The torque stays until the next sample. Inputs that are not finite leave it as it is;
    without an attitude, estimated or to follow, it is 0.
    Frame: body. Equations and margins: docs/systems/satellite_pointing.md. Assumes a rigid body with inertia as known.
    Source: Wie, Weiss and Arapostathis 1989; Wie 1998, section 7.
    """

    default_step = 0.125

    inertia = satellite.INERTIA.parameter(description="matrix of inertia of the satellite with its wheels, as known")
    natural_frequency = Parameter(0.3, unit="rad/s", minimum=0.0, description="w0")
    damping = Parameter(0.9, unit="1", minimum=0.0, description="z")
    integral_time = Parameter(0.0, unit="s", minimum=0.0, description="T; 0: no integral")
    integral_band = Parameter(0.01, unit="rad", minimum=0.0, description="error below which it is integrated")
    error_limit = Parameter(2.0, unit="rad", minimum=0.0, description="largest 2 |q| that the torque answers")
    delay = Parameter(0, minimum=0, maximum=LATEST, description="samples until a command acts, computing time")
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.125, "between ticks; 0: every communication point")
    estimated_quaternion = robot.QUATERNION.input()
    estimated_angular_velocity = body.ANGULAR_VELOCITY.input("angular velocity, estimated")
    reference = Inputs(AttitudeReference)
    wheel_momentum = satellite.WHEEL_MOMENTUM.input("of the wheels relative to the body")
    feedforward_torque = body.TORQUE.input("torque on the body to add, such as against the torquers'")
    active = Input(True, description="false: no torque, and nothing is integrated")
    torque_command = body.TORQUE.output("torque on the body wanted from the wheels", direct=True)
    attitude_error = body.ROTATION.output("2 q, from the reference to the estimated attitude", direct=True)
    status = Output(QuaternionFeedbackStatus, direct=True)
    integral = body.ANGULAR_ACCELERATION.state("of the error: i of the torque")
    commands = State(zeros(LATEST + 1, 3), unit="N.m", frame="body", description="last commands, the newest first")
    period = State(0.0, unit="s", description="to the next tick")

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
        """Return the correction to the angular acceleration (rad/s2), to be subtracted; integrate to the next tick."""
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
        """Command a new torque."""
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
        wanted_rate = to_body(rotation, self.reference.reference_angular_velocity)
        wanted = to_body(rotation, self.reference.reference_angular_acceleration) + cross(wanted_rate, w)
        correction = self.correction(self.attitude_error, w - wanted_rate)
        wanted = wanted - correction
        self.torque_command = cross(w, self.inertia @ w + self.wheel_momentum) + self.inertia @ wanted
        if norm(self.feedforward_torque) > 0.0:
            self.torque_command = self.torque_command + self.feedforward_torque

    def tick(self) -> None:
        """Command a new torque; let the one act that is due."""
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
