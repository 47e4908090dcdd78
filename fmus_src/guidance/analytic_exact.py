"""Analytic terminal guidance with nothing dropped: cubic time-to-go, exact rates, exact last burn."""

from ..interfaces.ports.landing import TerminalStatus
from ..mathlib.lunar.terminal import impulse_and_miss
from ..mathlib.vectors import norm
from .certain_time import CertainTime


class AnalyticExactGuidance(CertainTime):
    """Terminal guidance in closed form with the cubic time-to-go and the exact direction rate.

    With p = 3 B - A T and q = A T - 2 B the direction is p/|p| and its rate
    (3/T)(q - (q.d) d)/|p|: the angles' programme in vectors, free of their singularities. The
    last command burns for the time_to_go that is left. Starts that do not brake, such as hovering
    ones, fly with the least effort instead: see CertainTime, also for its limits. Assumes a flat
    Moon and constant gravity.
    Source: Fomichev and Li 2017; the cubic term and the exact rate are restored here, see
    docs/systems/lunar_terminal_guidance.md.
    """

    terminal_step = CertainTime.terminal_step.with_start(1)

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
