"""Analytic terminal guidance: time to go from a quadratic equation, linear pitch and yaw programmes."""

import math

from ..interfaces.ports.landing import TerminalStatus
from ..kernel.functions import atan, atan2, cos, sin
from ..mathlib.lunar.terminal import impulse_and_miss, quadratic_time
from ..mathlib.vectors import norm, vector
from .terminal_guidance import TerminalGuidance


class AnalyticGuidance(TerminalGuidance):
    """Terminal guidance in closed form: time to go from a quadratic, linear pitch and yaw programmes.

    With the changes A of velocity and B of position that thrust must produce, without gravity, over the time to go T:

        p = 3 B - A T    q = A T - 2 B    n = sqrt(p_x^2 + p_y^2)
        a_2 T^2 + a_3 T + a_4 = 0    W = |A|/T
        ψ = atan2(p_y, p_x)    ψ' = -3 (A_x B_y - A_y B_x)/n^2    θ = atan(p_z/n)    θ' = 3 q_z/(T n)

    Pitch θ is measured from the horizontal, yaw ψ from x towards y.

    Assumes a flat Moon, constant gravity and thrust acceleration, and a braking vehicle (pitch within 90 deg).

    Source: Fomichev and Li 2017, with the corrections of docs/systems/lunar_terminal_guidance.md.
    """

    def solve(self) -> None:
        dr, dv = self.remaining()
        time = self.planned_time(quadratic_time(dr, self.velocity, dv, self.gravity))
        self.time_to_go = time
        self.status = TerminalStatus.GOOD
        if time > 0.0:
            a, b = impulse_and_miss(dr, self.velocity, dv, self.gravity, time)
            p = 3.0 * b - time * a
            horizontal = p.x * p.x + p.y * p.y
            if horizontal > 0.0:
                forward = math.sqrt(horizontal)
                yaw = atan2(p.y, p.x)
                yaw_rate = -3.0 * (a.x * b.y - a.y * b.x) / horizontal
                # the published cos(yaw)/p.x is 1/forward, which holds across p.x = 0 too
                pitch = atan(p.z / forward)
                pitch_rate = 3.0 / time * (a.z * time - 2.0 * b.z) / forward
                self.command.thrust_acceleration = norm(a) / time
                cp = cos(pitch)
                sp = sin(pitch)
                cy = cos(yaw)
                sy = sin(yaw)
                self.command.thrust_direction = vector(cp * cy, cp * sy, sp)
                self.command.thrust_direction_rate = vector(
                    -sp * cy * pitch_rate - cp * sy * yaw_rate,
                    -sp * sy * pitch_rate + cp * cy * yaw_rate,
                    cp * pitch_rate,
                )
            else:
                self.status = TerminalStatus.NO_SOLUTION
