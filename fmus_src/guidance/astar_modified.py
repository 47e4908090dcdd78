"""Method A* with a closed formula for the time to go."""

import math

from ..block import Parameter
from ..interfaces.ports.landing import TerminalStatus
from ..mathlib.lunar.terminal import impulse_and_miss
from ..mathlib.vectors import Vector3, norm
from .astar_programme import AstarProgramme


class AstarModifiedGuidance(AstarProgramme):
    """Terminal guidance by the modified method A*, with the time to go from range, speed and exhaust speed.

        T = R/(V + (y - y_T) g/(V + V_T) - E/2 + E^2/(12 c))
        E^2 = ΔV_x^2 + (ΔV_y + 2 g R/(V + V_T))^2 + ΔV_z^2

    Arcsine arguments above 1 are clamped and counted.

    Source: Fomichev and Li 2017, modified A*.
    """

    exhaust_speed = Parameter(3100.0, unit="m/s", minimum=1.0, description="effective exhaust speed of the engine")

    def formula_time(self, dr: Vector3, dv: Vector3) -> float:
        """Return the time to go (s), or 0 if there is none, and set the status."""
        g = self.gravity
        distance = norm(dr)
        speed_sum = norm(self.velocity) + norm(self.target_velocity)
        self.status = TerminalStatus.NO_SOLUTION
        if speed_sum > 0.0:
            lift = dv.z + 2.0 * g * distance / speed_sum
            e = math.sqrt(dv.x * dv.x + dv.y * dv.y + lift * lift)
            closing = norm(self.velocity) - dr.z * g / speed_sum - 0.5 * e + e * e / (12.0 * self.exhaust_speed)
            if closing != 0.0:
                # close to the target the formula can give a negative time, which means the end of the flight
                self.status = TerminalStatus.GOOD
                return distance / closing
        return 0.0

    def solve(self) -> None:
        dr, dv = self.remaining()
        time = self.formula_time(dr, dv)
        time = self.planned_time(time)
        self.time_to_go = time
        if time > 0.0:
            a, b = impulse_and_miss(dr, self.velocity, dv, self.gravity, time)
            acceleration = 2.0 * norm(b) / (time * time)
            if acceleration > 0.0:
                self.point(a, b, time, acceleration)
            else:
                self.status = TerminalStatus.NO_SOLUTION
