"""Analytic terminal guidance with nothing dropped: cubic time-to-go, exact rates, exact last burn."""

from ..interfaces.terminal_guidance import GOOD, NO_SOLUTION, TerminalGuidance
from ..mathlib.terminal import cubic_time, impulse_and_miss
from ..mathlib.vectors import dot, norm


class AnalyticExactGuidance(TerminalGuidance):
    """Terminal guidance in closed form with the cubic time-to-go and the exact direction rate.

    With p = 3 B - A T and q = A T - 2 B the direction is p/|p| and its rate
    (3/T)(q - (q.d) d)/|p|: the angles' programme in vectors, free of their singularities. The
    last command burns for the time_to_go that is left. Assumes a flat Moon and constant gravity.
    Source: Fomichev and Li 2017; the cubic term and the exact rate are restored here, see
    docs/lunar_terminal_guidance.md.
    """

    terminal_step = TerminalGuidance.terminal_step.with_start(1)

    def solve(self) -> None:
        dr = [0.0] * 3
        dv = [0.0] * 3
        self.remaining(dr, dv)
        time = cubic_time(dr, self.velocity, dv, self.target_velocity, self.gravity)
        self.time_to_go = time
        self.status = GOOD
        if time > 0.0:
            a = [0.0] * 3
            b = [0.0] * 3
            impulse_and_miss(dr, self.velocity, dv, self.gravity, time, a, b)
            p = [0.0] * 3
            q = [0.0] * 3
            for i in range(3):
                p[i] = 3.0 * b[i] - a[i] * time
                q[i] = a[i] * time - 2.0 * b[i]
            length = norm(p)
            if length > 0.0:
                along = dot(q, p) / (length * length)
                for i in range(3):
                    self.thrust_direction[i] = p[i] / length
                    self.thrust_direction_rate[i] = 3.0 / time * (q[i] - along * p[i]) / length
                self.thrust_acceleration = norm(a) / time
            else:
                self.status = NO_SOLUTION
