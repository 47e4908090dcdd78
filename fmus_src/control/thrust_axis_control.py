"""Rotation of a thrust axis to a moving direction."""

import math

from ..block import Block, Output, Parameter
from ..interfaces.ports import landing, sampling
from ..kernel.enumerations import Enumeration, member
from ..mathlib.attitude.rotation import rotation_between
from ..mathlib.vectors import Vector3, across, cross, limit_length, norm, vector
from ..units import deg


def has_direction(length: float) -> bool:
    """Return True if a vector of this length has a direction, also for NaN, so that NaN propagates."""
    return length != 0.0 and length != math.inf


class ThrustAxisStatus(Enumeration):
    """Status of the commanded angular acceleration."""

    GOOD = member("good")
    LIMITED = member("reduced to the limit")


class ThrustAxisControl(Block):
    """Angular acceleration that turns a thrust axis to a commanded direction, with a braking curve.

    With the commanded direction d and rate d' propagated to the present instant, angle e and axis n from the measured
    attitude to d, and measured rate ω:

        α = α_feed + rate_gain (d × d' + n s - ω)
        s = min(angle_gain e, sqrt(2 braking_acceleration e), maximum_rate)

    α is limited to maximum_angular_acceleration (0: no limit). The square root is the rate that braking_acceleration
    brings to 0 over the angle e; a linear law would cause a limit cycle at large angles. For a direction of length 0
    the law only brings the rate to 0, apart from the feedforward.

    Frame: landing site.

    Assumes that roll about the axis is irrelevant.

    See docs/systems/hover_transfer.md.
    """

    rate_gain = Parameter(
        1.5, unit="1/s", minimum=0.0, description="gain from angular rate error to angular acceleration"
    )
    angle_gain = Parameter(0.8, unit="1/s", minimum=0.0, description="gain from angle error to angular rate")
    braking_acceleration = Parameter(
        deg(0.25),
        unit="rad/s2",
        minimum=0.0,
        description="angular deceleration assumed at the end of a large turn",
    )
    maximum_rate = Parameter(
        deg(10.0), unit="rad/s", minimum=0.0, description="largest commanded angular rate of the thrust axis"
    )
    maximum_angular_acceleration = Parameter(
        deg(1.0),
        unit="rad/s2",
        minimum=0.0,
        description="largest commanded angular acceleration of the thrust axis; 0: no limit",
    )
    thrust_direction = landing.DIRECTION.input("commanded thrust direction at command_time, unit vector")
    thrust_direction_rate = landing.DIRECTION_RATE.input()
    command_time = landing.COMMAND_TIME.input("reference time of the commanded thrust direction")
    angular_acceleration_feed = landing.ANGULAR_ACCELERATION.input(
        "feedforward of the planned angular acceleration of the thrust axis"
    )
    attitude = landing.DIRECTION.input("measured direction of the thrust axis, unit vector")
    angular_rate = landing.ANGULAR_RATE.input("measured angular rate of the thrust axis")
    angular_acceleration = landing.ANGULAR_ACCELERATION.output(
        "commanded angular acceleration of the thrust axis", direct=True
    )
    direction_error = Output(
        0.0, unit="rad", direct=True, description="angle between measured and commanded thrust axis"
    )
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
        """Return the angular rate (rad/s) at ``time`` (s) that follows the command and reduces the error."""
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
        """Set the angular acceleration command for ``time`` (s)."""
        commanded_rate = self.command_rate(time)
        demanded = self.angular_acceleration_feed + self.rate_gain * (commanded_rate - self.angular_rate)
        self.angular_acceleration = demanded
        self.status = ThrustAxisStatus.GOOD
        if self.maximum_angular_acceleration > 0.0 and norm(demanded) > self.maximum_angular_acceleration:
            self.angular_acceleration = limit_length(demanded, self.maximum_angular_acceleration)
            self.status = ThrustAxisStatus.LIMITED

    def step(self, t: float, h: float) -> None:
        self.control(t + h)
