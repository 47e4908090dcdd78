"""A point-mass lander over a flat Moon."""

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.vectors import Vector3, norm, vector


class FlatMoonLander(Block):
    """Point mass over a flat Moon with constant gravity; thrust follows the commanded direction exactly.

    The thrust direction at time t is (d + d' (t - command_time)) normalised; thrust ends at
    command_time + burn_duration, inside a step if need be. No mass flow. Fourth-order
    Runge-Kutta with a fixed step of its own; the acceleration depends on time only, so its
    slopes are one at each end and two in the middle. Frame: landing site (x north, y west, z up).
    Source: Fomichev and Li 2017, equations of motion.
    Assumes an attitude and an engine without lag.
    """

    initial_position = Parameter(
        [1.0e5, 0.0, 1.05e4], unit="m", frame="landing site", description="position at the start"
    )
    initial_velocity = Parameter(
        [-950.0, 0.0, 0.0], unit="m/s", frame="landing site", description="velocity at the start"
    )
    initial_mass = Parameter(940.0, unit="kg", minimum=1e-3, description="mass, constant")
    gravity = Parameter(1.62, unit="m/s2", minimum=0.0, description="gravity, constant, along -z")
    internal_step = Parameter(0.1, unit="s", minimum=1e-4, description="longest integration step")
    latch_at_burn_end = Parameter(False, description="keep position and velocity as they are when thrust ends")
    thrust = Input(0.0, unit="N", description="thrust of the engine")
    thrust_direction = Input([0.0, 0.0, 1.0], unit="1", frame="landing site", description="unit vector at command_time")
    thrust_direction_rate = Input([0.0, 0.0, 0.0], unit="1/s", frame="landing site", description="its derivative")
    command_time = Input(0.0, unit="s", description="time that direction and duration count from")
    burn_duration = Input(0.0, unit="s", description="how long to thrust from command_time on")
    position = Output([0.0, 0.0, 0.0], unit="m", frame="landing site", description="position")
    velocity = Output([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="velocity")
    mass = Output(940.0, unit="kg", description="mass")
    specific_force = Output(
        [0.0, 0.0, 0.0], unit="m/s2", frame="landing site", description="mean of thrust over mass in the last step"
    )
    latched = State(False, description="thrust has ended and the motion is kept")
    under_thrust = State(False, description="thrust was on at the end of the last step")

    def initialize(self) -> None:
        self.mass = self.initial_mass
        self.position = self.initial_position
        self.velocity = self.initial_velocity

    def acceleration(self, t: float) -> Vector3:
        """Thrust over mass and gravity at time t (m/s2), landing-site frame."""
        direction = self.thrust_direction + (t - self.command_time) * self.thrust_direction_rate
        length = norm(direction)
        scale = 0.0
        if length > 0.0:
            scale = self.thrust / self.mass / length
        push = scale * direction
        return vector(push.x, push.y, push.z - self.gravity)

    def burn(self, t: float, h: float) -> None:
        """Move by h (s) under thrust and gravity."""
        a1 = self.acceleration(t)
        a2 = self.acceleration(t + 0.5 * h)
        a4 = self.acceleration(t + h)
        self.position = self.position + h * (self.velocity + h * (a1 + 2.0 * a2) / 6.0)
        self.velocity = self.velocity + h * (a1 + 4.0 * a2 + a4) / 6.0

    def fall(self, h: float) -> None:
        """Move by h (s) under gravity alone."""
        moved = self.position + h * self.velocity
        self.position = vector(moved.x, moved.y, moved.z - 0.5 * self.gravity * h * h)
        self.velocity = vector(self.velocity.x, self.velocity.y, self.velocity.z - self.gravity * h)

    def step(self, t: float, h: float) -> None:
        before = self.velocity
        burning = 0.0
        if self.thrust > 0.0:
            burning = self.command_time + self.burn_duration - t
        if burning < 0.0:
            burning = 0.0
        ends = burning < h
        if not ends:
            burning = h
        moving = h
        if not self.latched:
            pieces = int(burning / self.internal_step - 1e-9) + 1
            piece = burning / pieces
            for k in range(pieces):
                self.burn(t + k * piece, piece)
            if ends and self.latch_at_burn_end and (burning > 0.0 or self.under_thrust):
                self.latched = True
                moving = burning
            elif ends:
                self.fall(h - burning)
            self.under_thrust = not ends
            gained = (self.velocity - before) / h
            self.specific_force = vector(gained.x, gained.y, gained.z + self.gravity * moving / h)
        else:
            self.specific_force = vector(0.0, 0.0, 0.0)
