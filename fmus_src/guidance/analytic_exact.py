"""Analytic terminal guidance without approximations: cubic time to go, exact direction rates, exact last burn."""

from ..interfaces.ports.landing import TerminalStatus
from ..mathlib.lunar.terminal import impulse_and_miss
from ..mathlib.vectors import norm
from .time_to_go_guidance import TimeToGoGuidance


class AnalyticExactGuidance(TimeToGoGuidance):
    """Terminal guidance in closed form with the cubic time to go and the exact direction rate.

        p = 3 B - A T    q = A T - 2 B    d = p/|p|    d' = (3/T) (q - (q · d) d)/|p|

    The vector form of the pitch and yaw programme has no singularities. The last command burns for the remaining
    time_to_go. Starts that do not brake use the time of least effort.

    Assumes a flat Moon and constant gravity.

    Source: Fomichev and Li 2017; cubic term and exact rate: docs/systems/lunar_terminal_guidance.md.
    """

    terminal_step = TimeToGoGuidance.terminal_step.with_start(1)

    def solve(self) -> None:
        dr, dv = self.remaining()
        time = self.time_left(dr, dv)
        self.time_to_go = time
        self.status = TerminalStatus.GOOD
        if time > 0.0:
            a, b = impulse_and_miss(dr, self.velocity, dv, self.gravity, time)
            self.thrust_linearly(a, b, time)
            if not self.least_effort:
                self.command.thrust_acceleration = norm(a) / time
