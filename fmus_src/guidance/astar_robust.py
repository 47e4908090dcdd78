"""Method A* made to work all over the published box: time-to-go from the cubic, thrust from |a0|."""

from ..interfaces.terminal_guidance import GOOD, NO_SOLUTION
from ..mathlib.terminal import cubic_time, impulse_and_miss
from ..mathlib.vectors import norm
from .astar_programme import AstarProgramme


class AstarRobustGuidance(AstarProgramme):
    """Terminal guidance by method A* with a time-to-go that exists all over the published box.

    Time-to-go solves |A| T = 2 |B| and the thrust acceleration is |a0| = 2 |A T - 3 B|/T^2, with
    which no arcsine argument exceeds 1. The last command burns for the time_to_go that is left.
    Source: Fomichev and Li 2017, method A*; both changes are ours, see docs/lunar_terminal_guidance.md.
    """

    terminal_step = AstarProgramme.terminal_step.with_start(1)

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
            for i in range(3):
                p[i] = 3.0 * b[i] - a[i] * time
            acceleration = 2.0 * norm(p) / (time * time)
            if acceleration > 0.0:
                self.point(a, b, time, acceleration)
            else:
                self.status = NO_SOLUTION
