"""Terminal guidance with engine data and constraints on the approach."""

import math

from ..block import Output, Parameter
from ..interfaces.ports import landing
from ..kernel.functions import tan
from ..mathlib.lunar.gravity import STANDARD_GRAVITY
from ..mathlib.lunar.terminal import cubic_time, effort_rises, keeps_direction, weighted_effort_time
from ..mathlib.vectors import Vector3
from ..units import deg
from .terminal_guidance import TerminalGuidance

LIMIT_THRUST = 1
LIMIT_GLIDE_SLOPE = 2
LIMIT_TILT = 4
LIMIT_PLACE = 8
ROUNDS = 20  # iterations until time and gravity correction agree
AGREED = 1e-10  # s
NEARLY_AGREED = 1e-6  # s, accepted for long times, which have larger rounding errors


class InformedGuidance(TerminalGuidance, interface=True):
    """Terminal guidance with limits of thrust, glide slope and tilt.

    A command that violates a limit has status 1, and `limit` is the sum of 1 (thrust), 2 (glide slope), 4 (tilt) and 8
    (place). The glide slope is a cone with its apex glide_offset below the target:

        tan(glide_slope) |Δr_xy| <= Δr_z + glide_offset

    Frame: landing site. Heights are along z, which differs from the sphere by x^2/(2 moon_radius).
    """

    terminal_step = TerminalGuidance.terminal_step.with_start(1)
    maximum_thrust = landing.MAXIMUM_THRUST.parameter(minimum=1e-3, description="largest thrust of the engine")
    minimum_thrust = landing.MINIMUM_THRUST.parameter(510.0, "least thrust of the burning engine; 0: unknown")
    specific_impulse = landing.SPECIFIC_IMPULSE.parameter()
    thrust_margin = Parameter(
        0.92, unit="1", minimum=0.1, maximum=1.0, description="largest thrust in plans, as a fraction of maximum_thrust"
    )
    glide_slope = Parameter(
        0.0,
        unit="rad",
        minimum=0.0,
        maximum=deg(85.0),
        description="least elevation of the vehicle as seen from the target; 0: no constraint",
    )
    glide_offset = Parameter(
        5.0, unit="m", minimum=0.0, description="depth of the glide-slope cone's apex below the target"
    )
    largest_tilt = Parameter(
        deg(180.0),
        unit="rad",
        minimum=0.0,
        maximum=deg(180.0),
        description="largest angle between thrust and local vertical; 180 deg: no constraint",
    )
    limit = Output(
        0,
        direct=True,
        description=(
            "constraints that the plan violates, as a sum: 1 thrust, 2 glide slope, 4 tilt, 8 target not reached"
        ),
    )
    glide_margin = Output(0.0, unit="m", direct=True, description="height of the vehicle above the glide-slope cone")
    choices = Output(
        0, direct=True, description="number of plans, or of choices of the time to go, for the current target"
    )
    predicted_propellant = landing.PREDICTED_PROPELLANT.output(direct=True)
    predicted_miss = Output(
        0.0, unit="m", direct=True, description="predicted distance from the target at the end of the plan"
    )

    def exhaust_speed(self) -> float:
        """Return the exhaust speed of the engine (m/s)."""
        return STANDARD_GRAVITY * self.specific_impulse

    def glide_height(self, offset: Vector3) -> float:
        """Return the height (m) above the glide-slope cone at an ``offset`` (m) from the target."""
        level = math.sqrt(offset.x * offset.x + offset.y * offset.y)
        return offset.z + self.glide_offset - tan(self.glide_slope) * level

    def measure_glide(self) -> None:
        """Set glide_margin for the present position."""
        self.glide_margin = self.glide_height(self.position - self.aim_position)

    def braking_time(self) -> float:
        """Return the time to go (s) of about constant thrust, from |A| T = 2 |B|; 0 if its thrust does not brake."""
        time = 0.0
        for _ in range(ROUNDS):
            dr, dv = self.remaining_over(time)
            root = cubic_time(dr, self.velocity, dv, self.gravity)
            if not root > 0.0:
                return 0.0
            change = abs(root - time)
            time = root
            if change < AGREED:
                dr, dv = self.remaining_over(time)
                brakes = keeps_direction(dr, self.velocity, dv, self.gravity, time)
                if brakes and not effort_rises(dr, self.velocity, dv, self.gravity, time):
                    return time
                return 0.0
        return 0.0

    def effort_time(self, weight: float) -> float:
        """Return the time to go (s) of least effort with a ``weight`` (m2/s4) of time; 0 if none exists."""
        time = 0.0
        change = 0.0
        for _ in range(10 * ROUNDS):
            dr, dv = self.remaining_over(time)
            root = weighted_effort_time(dr, self.velocity, dv, self.gravity, weight)
            change = abs(root - time)
            time = root
            if change < AGREED:
                return time
        if change < NEARLY_AGREED:
            return time
        return 0.0

    def first_time(self) -> float:
        """Return the time to go (s) with which a search begins; 0 if none exists."""
        time = self.braking_time()
        if time > 0.0:
            return time
        return self.effort_time(0.0)
