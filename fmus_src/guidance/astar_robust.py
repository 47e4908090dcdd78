"""Method A* modified to work for every start: time to go from a cubic equation or least effort, thrust from |a_0|."""

from ..interfaces.ports.landing import TerminalStatus
from ..mathlib.lunar.terminal import impulse_and_miss
from ..mathlib.vectors import norm
from .astar_programme import AstarProgramme
from .time_to_go_guidance import TimeToGoGuidance

FORWARD = 0.05  # least fraction of thrust along x for the arcsines; 0.07 in the published box


class AstarRobustGuidance(AstarProgramme, TimeToGoGuidance):
    """Terminal guidance by method A* with a time to go for every start.

        |A| T = 2 |B|    W = |a_0| = 2 |A T - 3 B|/T^2

    With this W no arcsine argument exceeds 1. The last command burns for the remaining time_to_go. Starts that do not
    brake use the time of least effort. For these starts, and where the component of thrust along x is too small for the
    arcsines, direction and rate are taken from the thrust acceleration a_0 + a_1 t.

    Source: Fomichev and Li 2017, method A*; changes: docs/systems/lunar_terminal_guidance.md.
    """

    terminal_step = AstarProgramme.terminal_step.with_start(1)

    def solve(self) -> None:
        dr, dv = self.remaining()
        time = self.time_left(dr, dv)
        self.time_to_go = time
        self.status = TerminalStatus.GOOD
        if time > 0.0:
            a, b = impulse_and_miss(dr, self.velocity, dv, self.gravity, time)
            p = 3.0 * b - time * a
            size = norm(p)
            if self.least_effort or p.x <= FORWARD * size:
                self.thrust_linearly(a, b, time)
            else:
                self.point(a, b, time, 2.0 * size / (time * time))
