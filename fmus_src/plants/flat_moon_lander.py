"""Point-mass lander over a flat Moon."""

from ..block import Block, Parameter, State
from ..interfaces.ports import landing, sampling
from ..kernel.integrators import Translation, count_steps, simpson
from ..mathlib.vectors import Vector3, norm, vector


class FlatMoonLander(Block):
    """Point mass over a flat Moon with constant gravity and ideal attitude.

        r'' = (F/m) d(t)/|d(t)| - g k    d(t) = d_0 + d_0' (t - t_command)

    Thrust ends at command_time + burn_duration, if necessary within a step. Mass is constant. The motion is integrated
    by the fourth-order Runge-Kutta method in fixed steps; since the acceleration depends only on time, the method
    reduces to Simpson's rule.

    Frame: landing site (x north, y west, z up).

    Assumes attitude and engine without lag.

    Source: Fomichev and Li 2017, equations of motion.
    """

    initial_position = landing.POSITION.parameter(
        [1.0e5, 0.0, 1.05e4], "initial position of the lander relative to the landing site"
    )
    initial_velocity = landing.VELOCITY.parameter(
        [-950.0, 0.0, 0.0], "initial velocity of the lander relative to the landing site"
    )
    initial_mass = landing.INITIAL_MASS.parameter(description="constant mass of the lander")
    gravity = landing.GRAVITY.parameter()
    internal_step = sampling.INTERNAL_STEP.parameter()
    latch_at_burn_end = Parameter(False, description="true: position and velocity held once the burn has ended")
    thrust = landing.THRUST.input("thrust of the engine")
    thrust_direction = landing.DIRECTION.input()
    thrust_direction_rate = landing.DIRECTION_RATE.input()
    command_time = landing.COMMAND_TIME.input()
    burn_duration = landing.BURN_DURATION.input()
    position = landing.POSITION.output()
    velocity = landing.VELOCITY.output()
    mass = landing.MASS.output(start=940.0)
    specific_force = landing.ACCELERATION.output(
        "specific force of the lander (thrust over mass), mean over the last step"
    )
    latched = State(False, description="true: burn ended, position and velocity held")
    under_thrust = State(False, description="true: engine burning at the end of the last step")

    def initialize(self) -> None:
        self.mass = self.initial_mass
        self.position = self.initial_position
        self.velocity = self.initial_velocity

    def acceleration(self, t: float) -> Vector3:
        """Return the acceleration r'' = W d/|d| - g k (m/s2) at time t (s), with thrust over mass W."""
        direction = self.thrust_direction + (t - self.command_time) * self.thrust_direction_rate
        length = norm(direction)
        scale = 0.0
        if length > 0.0:
            scale = self.thrust / self.mass / length
        push = scale * direction
        return vector(push.x, push.y, push.z - self.gravity)

    def burn(self, t: float, h: float) -> None:
        """Advance the motion by h (s) under thrust and gravity."""
        end = simpson(self.acceleration, t, Translation(position=self.position, velocity=self.velocity), h)
        self.position = end.position
        self.velocity = end.velocity

    def fall(self, h: float) -> None:
        """Advance the motion by h (s) under gravity alone."""
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
            pieces = count_steps(burning, self.internal_step)
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
