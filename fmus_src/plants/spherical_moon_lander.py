"""Point-mass lander over a spherical Moon, with engine and attitude lags."""

from ..block import Parameter, State
from ..interfaces.ports import landing
from ..mathlib.attitude.pursuit import follow, goal_at
from ..mathlib.vectors import Vector3
from ..units import deg
from .moon_lander import MoonLander


class SphericalMoonLander(MoonLander):
    """Point mass with one engine and a first-order attitude response, in the central gravity field of the Moon.

    The commanded direction at time t is the unit vector of d + d' (t - command_time). The attitude starts at the first
    command and turns towards the present command at the rate

        |ω| = min(angle/direction_response, slew_rate_limit)

    If direction_response and slew_rate_limit are both 0, the attitude equals the command. Thrust, mass and motion are
    computed as in `moon_lander`; in a step in which the attitude leaves its rate limit, the order of the method is
    three. The motion is frozen when the altitude is 0 or less at the end of an internal step.

    Steps are internal_step or equal parts of it no longer than the lag and the response (at least 1/100; a shorter
    response is ignored), and end where thrust ends. If the communication step is a multiple of internal_step, it
    affects results only by rounding; other communication steps are divided into equal steps.

    See docs/systems/lunar_landing.md.
    """

    direction_response = Parameter(
        0.5,
        unit="s",
        minimum=0.0,
        description="time constant with which the thrust axis follows the command; 0: no lag",
    )
    slew_rate_limit = Parameter(
        deg(10.0), unit="rad/s", minimum=0.0, description="largest angular rate of the thrust axis; 0: no limit"
    )
    latch_at_burn_end = Parameter(
        False,
        description="true: motion held from the commanded end of a burn on, without the residual thrust due to the lag",
    )
    thrust_direction = landing.DIRECTION.input("commanded thrust direction at command_time, unit vector")
    thrust_direction_rate = landing.DIRECTION_RATE.input()
    latched = State(False, description="true: burn ended, motion held")
    aligned = State(False, description="true: thrust axis aligned with the first command")
    response = State(
        0.5, unit="s", description="time constant of the thrust axis in use; 0: direction_response too short to matter"
    )

    def initialize(self) -> None:
        self.initialise_motion()
        self.response = self.direction_response
        if self.response < 0.01 * self.internal_step:
            self.response = 0.0
        self.divide(self.response)

    def point(self, t: float) -> None:
        """Set the attitude to the command at time t (s)."""
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
        """Perform an internal step of h (s) under a constant commanded thrust (N); return the velocity gained (m/s)."""
        if self.response <= 0.0 and self.slew_rate_limit <= 0.0:
            self.point(t)
        gained = self.advance(t, h, commanded)
        self.touch()
        return gained

    def moving(self) -> bool:
        """Return True if the motion continues."""
        return not self.ground_contact and not self.latched

    def burn_ended(self) -> None:
        """Freeze the motion if latch_at_burn_end is set."""
        self.latched = self.latch_at_burn_end

    def step(self, t: float, h: float) -> None:
        if not self.aligned:
            self.point(t)
            self.aligned = True
        commanded = self.thrust
        if commanded < 0.0:
            commanded = 0.0
        self.advance_motion(t, h, commanded)
