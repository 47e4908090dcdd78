"""Analytic terminal guidance: time-to-go from a quadratic, linear pitch and yaw programmes."""

import math

from ..interfaces.terminal_guidance import GOOD, NO_SOLUTION, TerminalGuidance
from ..mathlib.terminal import impulse_and_miss, quadratic_time
from ..mathlib.vectors import norm


class AnalyticGuidance(TerminalGuidance):
    """Terminal guidance in closed form: time-to-go from a quadratic, linear pitch and yaw programmes.

    Pitch is measured from the horizontal, yaw from x towards y. Assumes a flat Moon, constant
    gravity and thrust acceleration, and that the vehicle is braking (pitch within 90 deg).
    Source: Fomichev and Li 2017, with the corrections listed in docs/lunar_terminal_guidance.md.
    """

    def solve(self) -> None:
        dr = [0.0] * 3
        dv = [0.0] * 3
        self.remaining(dr, dv)
        time = self.planned_time(quadratic_time(dr, self.velocity, dv, self.gravity))
        self.time_to_go = time
        self.status = GOOD
        if time > 0.0:
            a = [0.0] * 3
            b = [0.0] * 3
            impulse_and_miss(dr, self.velocity, dv, self.gravity, time, a, b)
            px = 3.0 * b[0] - a[0] * time
            py = 3.0 * b[1] - a[1] * time
            pz = 3.0 * b[2] - a[2] * time
            horizontal = px * px + py * py
            if horizontal > 0.0:
                forward = math.sqrt(horizontal)
                yaw = math.atan2(py, px)
                yaw_rate = -3.0 * (a[0] * b[1] - a[1] * b[0]) / horizontal
                # the published cos(yaw)/px is 1/forward, which holds across px = 0 too
                pitch = math.atan(pz / forward)
                pitch_rate = 3.0 / time * (a[2] * time - 2.0 * b[2]) / forward
                self.thrust_acceleration = norm(a) / time
                cp = math.cos(pitch)
                sp = math.sin(pitch)
                cy = math.cos(yaw)
                sy = math.sin(yaw)
                self.thrust_direction[0] = cp * cy
                self.thrust_direction[1] = cp * sy
                self.thrust_direction[2] = sp
                self.thrust_direction_rate[0] = -sp * cy * pitch_rate - cp * sy * yaw_rate
                self.thrust_direction_rate[1] = -sp * sy * pitch_rate + cp * cy * yaw_rate
                self.thrust_direction_rate[2] = cp * pitch_rate
            else:
                self.status = NO_SOLUTION
