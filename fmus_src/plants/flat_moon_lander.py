"""A point-mass lander over a flat Moon."""

from ..block import Block, Input, Output, Parameter, State
from ..mathlib.vectors import norm


class FlatMoonLander(Block):
    """Point mass over a flat Moon with constant gravity; thrust follows the commanded direction exactly.

    The thrust direction at time t is (d + d' (t - command_time)) normalised; thrust ends at
    command_time + burn_duration, inside a step if need be. No mass flow. Fourth-order
    Runge-Kutta with a fixed step of its own; the acceleration depends on time only, so its
    slopes are one at each end and two in the middle. Frame: landing site (x north, y west, z up).
    Source: Fomichev and Li 2017, equations of motion.
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
        for i in range(3):
            self.position[i] = self.initial_position[i]
            self.velocity[i] = self.initial_velocity[i]

    def thrust_acceleration(self, t: float, a: list) -> None:
        """a = thrust over mass at time t (m/s2), landing-site frame."""
        d = [0.0] * 3
        for i in range(3):
            d[i] = self.thrust_direction[i] + self.thrust_direction_rate[i] * (t - self.command_time)
        length = norm(d)
        scale = 0.0
        if length > 0.0:
            scale = self.thrust / self.mass / length
        for i in range(3):
            a[i] = scale * d[i]

    def burn(self, t: float, h: float) -> None:
        """Move by h (s) under thrust and gravity."""
        a1 = [0.0] * 3
        a2 = [0.0] * 3
        a4 = [0.0] * 3
        self.thrust_acceleration(t, a1)
        self.thrust_acceleration(t + 0.5 * h, a2)
        self.thrust_acceleration(t + h, a4)
        a1[2] = a1[2] - self.gravity
        a2[2] = a2[2] - self.gravity
        a4[2] = a4[2] - self.gravity
        for i in range(3):
            self.position[i] = self.position[i] + h * (self.velocity[i] + h * (a1[i] + 2.0 * a2[i]) / 6.0)
            self.velocity[i] = self.velocity[i] + h * (a1[i] + 4.0 * a2[i] + a4[i]) / 6.0

    def fall(self, h: float) -> None:
        """Move by h (s) under gravity alone."""
        for i in range(3):
            self.position[i] = self.position[i] + h * self.velocity[i]
        self.position[2] = self.position[2] - 0.5 * self.gravity * h * h
        self.velocity[2] = self.velocity[2] - self.gravity * h

    def step(self, t: float, h: float) -> None:
        before = [0.0] * 3
        for i in range(3):
            before[i] = self.velocity[i]
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
            for i in range(3):
                self.specific_force[i] = (self.velocity[i] - before[i]) / h
            self.specific_force[2] = self.specific_force[2] + self.gravity * moving / h
        else:
            for i in range(3):
                self.specific_force[i] = 0.0
