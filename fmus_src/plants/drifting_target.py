"""Passive object that drifts and spins in deep space."""

import math

from ..block import Block, Parameter, State
from ..interfaces.ports import inertial, robot
from ..kernel.functions import cos, fmod, sin
from ..mathlib.attitude.quaternion import from_rotation_vector
from ..mathlib.vectors import norm, vector
from ..units import deg


class DriftingTarget(Block):
    """Passive object in uniform motion with a constant spin about an axis fixed in its body and in inertial space.

        r = r_0 + v t    q = (cos(Ω t/2), e sin(Ω t/2))

    The solution is exact at any time. Body axes are aligned with the inertial axes at the start; a spin_axis of length
    0 means no spin.

    Frame: inertial.

    Assumes no forces and torques, and a spin about a principal axis of inertia.

    Source: Somov, Butyrin, Somov and Somova. See docs/systems/robot_rendezvous.md.
    """

    default_step = 0.125

    initial_position = inertial.POSITION.parameter(
        [500.0 * cos(math.pi / 9.0), 500.0 * sin(math.pi / 9.0), 0.0], "initial position of the object's centre of mass"
    )
    constant_velocity = inertial.VELOCITY.parameter(
        [-0.05, 0.05, 0.075], description="constant velocity of the object's centre of mass"
    )
    spin_axis = robot.SPIN_AXIS.parameter(description="spin axis of the object, normalised by the block")
    spin_rate = Parameter(deg(1.0), unit="rad/s", description="angular rate of the object about its spin axis")
    position = inertial.POSITION.output("position of the object's centre of mass")
    velocity = inertial.VELOCITY.output("velocity of the object's centre of mass")
    quaternion = robot.QUATERNION.output(
        "attitude quaternion of the object from body to inertial, scalar first and not negative"
    )
    start_time = State(0.0, unit="s", description="start time of the simulation")

    def initialize(self) -> None:
        self.set_motion(0.0)

    def set_motion(self, time: float) -> None:
        """Set position and attitude at ``time`` (s) after the start."""
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
        self.set_motion(t + h - self.start_time)
