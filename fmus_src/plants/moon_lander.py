"""Base of landers over the Moon with one engine along their thrust axis."""

from ..block import Block, Output, State
from ..interfaces.ports import landing, sampling
from ..kernel.functions import log1p
from ..kernel.integrators import Forcing, Translation, count_steps, gain_of, runge_kutta_nystrom
from ..kernel.records import Field, Record
from ..mathlib.actuators.lagged_thrust import lagged_thrust
from ..mathlib.lunar.gravity import STANDARD_GRAVITY, altitude_of, central_gravity
from ..mathlib.vectors import Vector3, norm, vector


class Burn(Record):
    """Thrust acceleration over a step, and the velocity gained."""

    start = Field(unit="m/s2", description="thrust acceleration at the start of the step")
    middle = Field(unit="m/s2", description="thrust acceleration in the middle of the step")
    end = Field(unit="m/s2", description="thrust acceleration at the end of the step")
    gain = Field(unit="m/s", description="speed gained over the step, by the rocket equation")


def scale(burn: Burn, simpson: float) -> Burn:
    """Return the burn scaled so that its integral by Simpson's rule, now ``simpson`` (m/s), equals its gain."""
    return Burn(
        start=burn.start * burn.gain / simpson,
        middle=burn.middle * burn.gain / simpson,
        end=burn.end * burn.gain / simpson,
        gain=burn.gain,
    )


class MoonLander(Block, interface=True):
    """Point mass with one engine along its thrust axis, in the central gravity field of a Moon that does not rotate.

    With position r from the Moon's centre, thrust axis d, thrust F, commanded thrust F_c and time constant τ_F:

        r'' = -μ r/|r|^3 + (F/m) d    m' = -F/(g_0 I_sp)    F' = (F_c - F)/τ_F

    F_c is `thrust` until command_time + burn_duration, if necessary within a step, and then 0; thrust ends when no mass
    is left. Thrust and mass are exact between switching times. Motion is integrated by a Runge-Kutta-Nyström method of
    fourth order, with thrust scaled so that each step obeys the rocket equation. After ground contact the motion is
    frozen.

    A plant of this slot defines `turn`, which advances the attitude, and may override `move`, `height` and `gravity`.

    Frame: landing site (x north, y west, z up), with the Moon's centre at (0, 0, -moon_radius).

    Assumes a spherical Moon without rotation and terrain, and propellant without slosh or shift of the centre of mass.

    Source: Hairer, Norsett and Wanner 1993, section II.14 (integration method).
    """

    initial_position = landing.POSITION.parameter(
        [266731.0, 0.0, -2233.0], "initial position of the lander relative to the landing site"
    )
    initial_velocity = landing.VELOCITY.parameter(
        [-1676.0, 0.0, 208.0], "initial velocity of the lander relative to the landing site"
    )
    initial_mass = landing.INITIAL_MASS.parameter()
    specific_impulse = landing.SPECIFIC_IMPULSE.parameter()
    moon_radius = landing.MOON_RADIUS.parameter()
    gravitational_parameter = landing.GRAVITATIONAL_PARAMETER.parameter()
    thrust_lag = landing.THRUST_LAG.parameter(0.1)
    internal_step = sampling.INTERNAL_STEP.parameter()
    thrust = landing.THRUST.input("commanded thrust of the engine; a negative value counts as 0")
    command_time = landing.COMMAND_TIME.input()
    burn_duration = landing.BURN_DURATION.input()
    position = landing.POSITION.output()
    velocity = landing.VELOCITY.output()
    speed = Output(0.0, unit="m/s", description="magnitude of the lander's velocity relative to the landing site")
    mass = landing.MASS.output(start=940.0)
    altitude = landing.ALTITUDE.output()
    specific_force = landing.ACCELERATION.output(
        "specific force of the lander (thrust over mass), mean over the last step"
    )
    sensed_velocity = landing.VELOCITY.output("time integral of the lander's specific force since the start")
    delivered_thrust = Output(0.0, unit="N", description="actual thrust of the engine at the end of the step")
    attitude = landing.DIRECTION.output("actual direction of the thrust axis, unit vector")
    coast_time = Output(0.0, unit="s", description="time since the end of the last commanded burn; 0 during a burn")
    ground_contact = landing.GROUND_CONTACT.output()
    longest_step = State(
        0.1,
        unit="s",
        description=(
            "longest integration step in use: internal_step, or an integer fraction of it for short time constants"
        ),
    )

    def initialise_motion(self) -> None:
        """Set mass and motion to their initial values."""
        self.mass = self.initial_mass
        self.position = self.initial_position
        self.velocity = self.initial_velocity
        self.altitude = self.height(self.position)
        self.speed = norm(self.velocity)
        self.ground_contact = self.altitude <= 0.0

    def divide(self, response: float) -> None:
        """Set longest_step to internal_step/n, with the least n that brings it to at most the thrust lag and
        ``response``.

        Both are in s; 0 means that there is none. n is at most 100.
        """
        shortest = self.internal_step
        if response > 0.0 and response < shortest:
            shortest = response
        if self.thrust_lag > 0.0 and self.thrust_lag < shortest:
            shortest = self.thrust_lag
        parts = 100.0
        if shortest > 0.01 * self.internal_step:
            parts = float(count_steps(self.internal_step, shortest))
        self.longest_step = self.internal_step / parts

    def height(self, position: Vector3) -> float:
        """Return the altitude (m) at a position (m)."""
        return altitude_of(position, self.moon_radius)

    def gravity(self, position: Vector3) -> Vector3:
        """Return the gravity (m/s2) at a position (m)."""
        return central_gravity(position, self.moon_radius, self.gravitational_parameter)

    def turn(self, t: float, h: float) -> None:
        """Advance the attitude by h (s)."""

    def burn(self, h: float, commanded: float) -> Burn:
        """Return the burn over h (s) under a commanded thrust (N), and reduce the mass."""
        exhaust = STANDARD_GRAVITY * self.specific_impulse
        thrust = lagged_thrust(self.delivered_thrust, commanded, self.thrust_lag, h)
        used = thrust.impulse / exhaust
        if used >= self.mass:
            self.delivered_thrust = 0.0
            return Burn(start=0.0, middle=0.0, end=0.0, gain=0.0)
        first = thrust.start / self.mass
        middle = thrust.middle / (self.mass - thrust.middle_impulse / exhaust)
        self.delivered_thrust = thrust.end
        self.mass = self.mass - used
        gain = exhaust * log1p(used / self.mass)
        return Burn(start=first, middle=middle, end=thrust.end / self.mass, gain=gain)

    def advance(self, t: float, h: float, commanded: float) -> Vector3:
        """Advance the motion by h (s) under a constant commanded thrust (N); return the velocity gained (m/s)."""
        burn = self.burn(h, commanded)
        simpson = h * (burn.start + 4.0 * burn.middle + burn.end) / 6.0
        if simpson > 0.0:
            burn = scale(burn, simpson)
        first = burn.start * self.attitude
        self.turn(t, 0.5 * h)
        middle = burn.middle * self.attitude
        self.turn(t + 0.5 * h, 0.5 * h)
        forcing = Forcing(start=first, middle=middle, end=burn.end * self.attitude)
        s = Translation(position=self.position, velocity=self.velocity)
        s = runge_kutta_nystrom(self.gravity, s, forcing, h)
        self.position = s.position
        self.velocity = s.velocity
        self.altitude = self.height(self.position)
        return gain_of(forcing, h)

    def touch(self) -> None:
        """Stop the motion if the ground is reached."""
        if self.altitude <= 0.0:
            self.ground_contact = True
            self.delivered_thrust = 0.0

    def move(self, t: float, h: float, commanded: float) -> Vector3:
        """Perform an internal step of h (s) under a constant commanded thrust (N); return the velocity gained (m/s)."""
        gained = self.advance(t, h, commanded)
        self.touch()
        return gained

    def moving(self) -> bool:
        """Return True if the motion continues."""
        return not self.ground_contact

    def burn_ended(self) -> None:
        """React to the end of a burn within a step; no action unless overridden."""

    def advance_motion(self, t: float, h: float, commanded: float) -> None:
        """Advance from t to t + h (s) under a commanded thrust (N), and set the outputs of the motion."""
        gained = vector(0.0, 0.0, 0.0)
        pieces = count_steps(h, self.longest_step)
        piece = h / pieces
        for k in range(pieces):
            start = t + k * piece
            burning = self.command_time + self.burn_duration - start
            if self.moving():
                if burning >= piece:
                    pushed = self.move(start, piece, commanded)
                elif burning <= 0.0:
                    pushed = self.move(start, piece, 0.0)
                else:
                    pushed = self.move(start, burning, commanded)
                    self.burn_ended()
                    if self.moving():
                        gained = gained + pushed
                        pushed = self.move(start + burning, piece - burning, 0.0)
                gained = gained + pushed
        self.speed = norm(self.velocity)
        self.coast_time = 0.0
        if t + h > self.command_time + self.burn_duration:
            self.coast_time = t + h - (self.command_time + self.burn_duration)
        self.sensed_velocity = self.sensed_velocity + gained
        self.specific_force = gained / h
