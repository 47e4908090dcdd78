"""Loops of the lunar landing with a frozen plan, hovering at the target, in closed form, axis by axis.

With x the offset from the target, v its rate, k = mu/r^3 and T the frozen time-to-go, the plan a0 + a1 t is

    a0 = (-6/T^2 - n) x - (4/T) v        a1 = (12/T^3 + n/T) x + (6/T^2) v        x'' = a + n x

or with the gain 12 of Apollo's quartic and a final thrust that hovers, which is quadratic in time,

    a0 = (-12/T^2 - n) x - (6/T) v       a1 = (48/T^3 + n/T) x + (18/T^2) v

where n is the gradient of gravity, -k across and 2 k along the vertical; with `gravity_correction` gravity is linear in
time. Communication points are h apart, and estimates are the truth.

Across: the direction commanded at kh is the plan's h + lead later, y_k = a0 + (h + lead) a1. The allocation rotates at
a constant rate from y_(k-1) at kh to y_k at (k + 1)h, and the attitude follows with a lag equal to the lead. Along: the
commanded thrust is the plan's mean over the cycle, y_k = a0 + a1 h/2, which is held and followed with a lag.

L(z) is minus the transfer function from the acting acceleration to y. Derivation:
docs/systems/lunar_terminal_guidance.md, "A frozen plan".
"""

from dataclasses import dataclass

import control
import numpy as np
from scipy.linalg import expm

STEP = 0.1  # s
RADIUS, PARAMETER = 1.7374e6 + 1500.0, 4.9028e12  # m, of the target from the Moon's centre; m3/s2
ATTITUDE_LAG, THRUST_LAG = 0.5, 0.1  # s


@dataclass(frozen=True)
class HoverLoop:
    """One axis with a time-to-go (s): ``vertical``, or one of the two across; ``quartic`` is Apollo's law."""

    time_to_go: float
    vertical: bool
    quartic: bool = False

    @property
    def gradient(self) -> float:
        """Gravity gradient along the axis, 1/s2."""
        return (2.0 if self.vertical else -1.0) * PARAMETER / RADIUS**3

    @property
    def gains(self) -> np.ndarray:
        """Acceleration commanded by the guidance per offset (1/s2) and velocity (1/s)."""
        time, n = self.time_to_go, self.gradient
        ahead = 0.5 * STEP if self.vertical else STEP + ATTITUDE_LAG
        now = np.array([-6.0 / time**2 - n, -4.0 / time])
        slope = np.array([12.0 / time**3 + n / time, 6.0 / time**2])
        if self.quartic:
            now = np.array([-12.0 / time**2 - n, -6.0 / time])
            slope = np.array([48.0 / time**3 + n / time, 18.0 / time**2])
        return now + ahead * slope

    @property
    def plant(self) -> tuple[np.ndarray, np.ndarray]:
        """Matrix and input column, point to point, of offset, velocity, acceleration and, across, the last command.

        Across the command moves evenly from the last one to the new one.
        """
        lag = THRUST_LAG if self.vertical else ATTITUDE_LAG
        # offset, velocity, acceleration, command, its rate
        rates = np.zeros((5, 5))
        rates[0, 1] = rates[1, 2] = rates[3, 4] = 1.0
        rates[1, 0] = self.gradient
        rates[2, 2], rates[2, 3] = -1.0 / lag, 1.0 / lag
        over = expm(rates * STEP)[:3]
        if self.vertical:
            return over[:, :3], over[:, 3]
        a = np.zeros((4, 4))
        a[:3, :3] = over[:, :3]
        a[:3, 3] = over[:, 3] - over[:, 4] / STEP
        return a, np.append(over[:, 4] / STEP, 1.0)

    @property
    def state_space(self) -> control.StateSpace:
        """L, from point to point."""
        a, b = self.plant
        gains = np.zeros(len(a))
        gains[:2] = -self.gains
        return control.ss(a, b[:, None], gains[None], 0.0, STEP)

    @property
    def poles(self) -> np.ndarray:
        """Poles of the closed loop in z of one communication step, largest first."""
        loop = self.state_space
        poles = np.linalg.eigvals(loop.A - loop.B @ loop.C)
        return poles[np.argsort(-abs(poles))]
