"""A point-mass lander over a spherical Moon, with an engine and an attitude that take time."""

from ..block import Parameter, State
from ..interfaces.ports import landing
from ..mathlib.attitude.pursuit import follow, goal_at
from ..mathlib.vectors import Vector3
from ..units import deg
from .moon_lander import MoonLander


class SphericalMoonLander(MoonLander):
    """Point mass with one engine along its thrust axis, in the central field of a Moon that does not rotate.

    The commanded direction at time t is (d + d' (t - command_time)) normalised, the commanded thrust
    is thrust until command_time + burn_duration and 0 from there, inside a step if need be. Thrust
    follows with a first-order lag from 0 at the start; mass' = -thrust/(standard gravity *
    specific_impulse) and ends thrust where there is no mass left. The attitude starts on the first
    command and turns towards it at angle/direction_response, no faster than slew_rate_limit; without
    both it is the command. Where altitude is 0 or less at the end of an internal step everything stops
    and is kept. Frame: landing site (x north, y west, z up), the Moon's centre at (0, 0, -moon_radius).

    Thrust and mass are exact between switchings. Motion: Runge-Kutta-Nystrom of fourth order (Hairer,
    Norsett and Wanner 1993, section II.14), of third where the attitude comes off its limit within a
    step; thrust is scaled so that each step obeys the rocket equation. Steps are internal_step, or
    equal parts of it no longer than lag and response (down to 1/100, below which a response counts as
    none), and cut where thrust ends. So the results depend on how communication points cut a flight
    by rounding only, if these are whole multiples of internal_step apart; other distances are divided
    into equal steps.
    The vehicle is ours: docs/systems/lunar_landing.md.
    """

    direction_response = Parameter(0.5, unit="s", minimum=0.0, description="time constant of the attitude; 0: none")
    slew_rate_limit = Parameter(
        deg(10.0), unit="rad/s", minimum=0.0, description="largest rate of the attitude; 0: no limit"
    )
    latch_at_burn_end = Parameter(
        False, description="keep the motion as it is when a burn ends inside a step, whatever thrust is left by a lag"
    )
    thrust_direction = landing.DIRECTION.input("commanded direction at command_time")
    thrust_direction_rate = landing.DIRECTION_RATE.input()
    latched = State(False, description="a burn has ended and the motion is kept")
    aligned = State(False, description="the attitude has been put on the first command")
    response = State(0.5, unit="s", description="direction_response, 0 where it is too short to count")

    def initialize(self) -> None:
        self.place()
        self.response = self.direction_response
        if self.response < 0.01 * self.internal_step:
            self.response = 0.0
        self.divide(self.response)

    def point(self, t: float) -> None:
        """Put the attitude on the command of time t (s)."""
        since = t - self.command_time
        self.attitude = goal_at(self.thrust_direction, self.thrust_direction_rate, since, self.attitude)

    def turn(self, t: float, h: float) -> None:
        """Advance the attitude by h (s)."""
        self.attitude = follow(
            self.attitude,
            self.thrust_direction,
            self.thrust_direction_rate,
            t - self.command_time,
            h,
            self.response,
            self.slew_rate_limit,
        )

    def move(self, t: float, h: float, commanded: float) -> Vector3:
        """Move by h (s) under one command (N); returns the velocity that thrust gives (m/s)."""
        if self.response <= 0.0 and self.slew_rate_limit <= 0.0:
            self.point(t)
        gained = self.advance(t, h, commanded)
        self.touch()
        return gained

    def moving(self) -> bool:
        """Return True if the motion continues."""
        return not self.ground_contact and not self.latched

    def burn_ended(self) -> None:
        """Keep the motion where that is asked for."""
        self.latched = self.latch_at_burn_end

    def step(self, t: float, h: float) -> None:
        if not self.aligned:
            self.point(t)
            self.aligned = True
        commanded = self.thrust
        if commanded < 0.0:
            commanded = 0.0
        self.fly(t, h, commanded)
