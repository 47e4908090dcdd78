"""Method A* as published: time to go by Newton's method, which fails if there is no root."""

from ..block import State
from ..interfaces.ports.landing import TerminalStatus
from ..mathlib.lunar.terminal import impulse_and_miss
from ..mathlib.vectors import Vector3, dot, norm, vector
from .astar_programme import AstarProgramme


class AstarGuidance(AstarProgramme):
    """Terminal guidance by method A*, with the time to go by Newton's method.

        (A T - 3 B) · (A T - 2 B) = 0    W = 2 |B|/T^2

    Newton's method starts from 2 R/V and later from the last time to go, with a tolerance of 1e-6 s and at most 50
    iterations. Without convergence the status is 2 and the last command is held; for about 15 % of the published box of
    starts no root exists. `astar_robust_guidance` has a time for every start.

    Source: Fomichev and Li 2017, method A* (the equation for T is not printed there).
    """

    last_root = State(
        0.0, unit="s", description="initial value of Newton's method for the time to go; 0: initial value 2 R/V"
    )

    def reset_law(self) -> None:
        self.last_root = 0.0

    def root(self, dr: Vector3, v: Vector3, dv: Vector3, start: float) -> float:
        """Return the root reached from ``start`` (s), or 0 without convergence."""
        g = self.gravity
        slope_p = dv + 3.0 * v
        slope_q = dv + 2.0 * v
        far = 3.0 * dr
        near = 2.0 * dr
        time = start
        converged = False
        iterations = 0
        while not converged and iterations < 50:
            iterations = iterations + 1
            # A T - 3 B and A T - 2 B with their derivatives; gravity acts on the third axis
            p = slope_p * time - far
            p = vector(p.x, p.y, p.z - 0.5 * g * time * time)
            q = slope_q * time - near
            first = vector(slope_p.x, slope_p.y, slope_p.z - g * time) * q
            second = p * slope_q
            value = 0.0 + dot(p, q)
            slope = 0.0 + first.x + second.x + first.y + second.y + first.z + second.z
            change = 0.0
            if slope != 0.0:
                change = value / slope
                converged = abs(change) < 1e-6
            time = time - change
        if converged and time > 0.0:
            return time
        return 0.0

    def newton_time(self, dr: Vector3, dv: Vector3) -> float:
        """Return the time to go (s); if there is none, set the status and return 0."""
        speed = norm(self.velocity)
        self.status = TerminalStatus.NO_SOLUTION
        start = self.last_root
        if start <= 0.0 and speed > 0.0:
            start = 2.0 * norm(dr) / speed
        if start > 0.0:
            self.status = TerminalStatus.NOT_CONVERGED
            return self.root(dr, self.velocity, dv, start)
        return 0.0

    def solve(self) -> None:
        dr, dv = self.remaining()
        time = self.newton_time(dr, dv)
        time = self.planned_time(time)
        if time > 0.0:
            a, b = impulse_and_miss(dr, self.velocity, dv, self.gravity, time)
            acceleration = 2.0 * norm(b) / (time * time)
            if acceleration > 0.0:
                self.last_root = time
                self.time_to_go = time
                self.point(a, b, time, acceleration)
