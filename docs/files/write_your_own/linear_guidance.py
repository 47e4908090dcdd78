"""Terminal guidance with a thrust acceleration linear in time."""

from perilune import TerminalGuidance, TerminalStatus, norm
from perilune.fmus_src.mathlib.lunar.terminal import impulse_and_miss, quadratic_time


class LinearGuidance(TerminalGuidance):
    """Thrust acceleration a0 = 2 (3 B - A T)/T^2, recomputed every cycle."""

    def solve(self) -> None:
        dr, dv = self.remaining()
        time = quadratic_time(dr, self.velocity, dv, self.gravity)
        self.time_to_go = time
        self.status = TerminalStatus.GOOD
        if time > 0.0:
            a, b = impulse_and_miss(dr, self.velocity, dv, self.gravity, time)
            thrust = 3.0 * b - time * a
            length = norm(thrust)
            if length > 0.0:
                self.command.thrust_acceleration = 2.0 * length / (time * time)
                self.command.thrust_direction = thrust / length
            else:
                self.status = TerminalStatus.NO_SOLUTION
