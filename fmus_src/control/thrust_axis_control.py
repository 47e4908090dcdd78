"""Turns a thrust axis to a moving direction."""

import math

from ..block import Block, Output, Parameter
from ..interfaces.ports import landing, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.attitude.rotation import rotation_between
from ..mathlib.vectors import Vector3, across, cross, limit_length, norm, vector
from ..units import deg


def has_direction(length: float) -> bool:
    """Return True if a vector of this length has a direction; NaN counts as one, so that it is not lost on the way."""
    return length != 0.0 and length != math.inf


class ThrustAxisStatus(Enumeration):
    """Presence of the demand."""

    GOOD = member("good")
    LIMITED = member("shortened to the limit")


class ThrustAxisControl(Block):
    """Angular acceleration that turns a thrust axis to a commanded direction, with a braking curve.

    With the commanded direction d and its derivative d' carried on to now, the angle e and the axis n from the
    measured attitude to d, and the measured angular rate w:

        angular_acceleration = feed + rate_gain (d x d' + n s - w), shortened to maximum_angular_acceleration
        s = min(angle_gain e, sqrt(2 braking_acceleration e), maximum_rate)

    The square root is the speed from which braking_acceleration stops in e: a linear law of that speed goes to the
    limit of acceleration and stays there, from side to side. A direction without length, as there is before guidance
    has given one, only brings the rate to feed's. Frame: landing site. ``maximum_angular_acceleration`` 0: no limit.
    Assumes that roll about the axis does not matter. The law is ours: docs/systems/hover_transfer.md.
    """

    rate_gain = Parameter(1.5, unit="1/s", minimum=0.0, description="acceleration over error of the rate")
    angle_gain = Parameter(0.8, unit="1/s", minimum=0.0, description="rate over error of the angle")
    braking_acceleration = Parameter(
        deg(0.25), unit="rad/s2", minimum=0.0, description="with which large angles end; 0.25 deg/s2"
    )
    maximum_rate = Parameter(deg(10.0), unit="rad/s", minimum=0.0, description="largest turn asked for")
    maximum_angular_acceleration = Parameter(
        deg(1.0), unit="rad/s2", minimum=0.0, description="largest acceleration; 0: no limit"
    )
    thrust_direction = landing.DIRECTION.input("commanded direction at command_time")
    thrust_direction_rate = landing.DIRECTION_RATE.input()
    command_time = landing.COMMAND_TIME.input("time that the direction counts from")
    angular_acceleration_feed = landing.ANGULAR_ACCELERATION.input("that the command itself needs")
    attitude = landing.DIRECTION.input("measured unit vector of thrust")
    angular_rate = landing.ANGULAR_RATE.input("measured angular rate")
    angular_acceleration = landing.ANGULAR_ACCELERATION.output("commanded angular acceleration", direct=True)
    direction_error = Output(0.0, unit="rad", direct=True, description="angle from measured attitude to the command")
    status = Output(ThrustAxisStatus, direct=True)
    start_time = sampling.START_TIME.state()

    def initialize(self) -> None:
        self.control(self.start_time)

    def closing_rate(self, angle: float) -> float:
        """Return the rate (rad/s) at which to close an angle (rad)."""
        rate = self.angle_gain * angle
        braking = math.sqrt(2.0 * self.braking_acceleration * angle)
        if braking < rate:
            rate = braking
        if self.maximum_rate < rate:
            rate = self.maximum_rate
        return rate

    def command_rate(self, time: float) -> Vector3:
        """Return the angular rate (rad/s) that follows the command and closes the error at ``time`` (s)."""
        direction = self.thrust_direction + (time - self.command_time) * self.thrust_direction_rate
        length = norm(direction)
        self.direction_error = 0.0
        if not has_direction(length):
            return vector(0.0, 0.0, 0.0)
        length_of_attitude = norm(self.attitude)
        if not has_direction(length_of_attitude):
            return vector(0.0, 0.0, 0.0)
        direction = direction / length
        axis, self.direction_error = rotation_between(self.attitude, direction)
        following = cross(direction, across(self.thrust_direction_rate, direction) / length)
        return following + self.closing_rate(self.direction_error) * axis

    def control(self, time: float) -> None:
        """Set the command for ``time`` (s)."""
        wanted = self.command_rate(time)
        demanded = self.angular_acceleration_feed + self.rate_gain * (wanted - self.angular_rate)
        self.angular_acceleration = demanded
        self.status = ThrustAxisStatus.GOOD
        if self.maximum_angular_acceleration > 0.0 and norm(demanded) > self.maximum_angular_acceleration:
            self.angular_acceleration = limit_length(demanded, self.maximum_angular_acceleration)
            self.status = ThrustAxisStatus.LIMITED

    def step(self, t: float, h: float) -> None:
        self.control(t + h)
