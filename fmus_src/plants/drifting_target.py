"""A passive object that drifts and spins in deep space."""

import math

from ..block import Block, Parameter, State
from ..interfaces.ports import inertial, robot
from ..kernel.functions import cos, fmod, sin
from ..mathlib.attitude.quaternion import from_rotation_vector
from ..mathlib.vectors import norm, vector
from ..units import deg


class DriftingTarget(Block):
    """Moves uniformly and turns at a constant rate about an axis fixed in its body and in inertial space.

    Exact at any time. Its body axes are the inertial ones at the start; a spin_axis of length 0 means that it
    does not turn. The paper does not give the rate of the spin. Frame: inertial.
    Source: Somov, Butyrin, Somov and Somova, see docs/systems/robot_rendezvous.md.
    Assumes that nothing acts on it, and a spin about a principal axis of inertia.
    """

    default_step = 0.125

    initial_position = inertial.POSITION.parameter(
        [500.0 * cos(math.pi / 9.0), 500.0 * sin(math.pi / 9.0), 0.0], "centre of mass at the start"
    )
    constant_velocity = inertial.VELOCITY.parameter([-0.05, 0.05, 0.075])
    spin_axis = robot.SPIN_AXIS.parameter(description="axis of the spin, of any length")
    spin_rate = Parameter(deg(1.0), unit="rad/s", description="angular velocity about it")
    position = inertial.POSITION.output("centre of mass")
    velocity = inertial.VELOCITY.output()
    quaternion = robot.QUATERNION.output("attitude, from body to inertial, scalar first, not negative")
    start_time = State(0.0, unit="s", description="start of the flight")

    def initialize(self) -> None:
        self.place(0.0)

    def place(self, time: float) -> None:
        """Set the state ``time`` (s) after the start."""
        rotation = vector(0.0, 0.0, 0.0)
        length = norm(self.spin_axis)
        angle = fmod(self.spin_rate * time, math.tau)
        if length > 0.0:
            rotation = angle * self.spin_axis / length
        self.position = self.initial_position + time * self.constant_velocity
        self.velocity = self.constant_velocity
        self.quaternion = from_rotation_vector(rotation)
        if self.quaternion.w < 0.0:
            self.quaternion = -self.quaternion

    def step(self, t: float, h: float) -> None:
        self.place(t + h - self.start_time)
