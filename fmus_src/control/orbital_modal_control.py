"""Orbital attitude by placed poles."""

from ..block import State
from ..kernel.matrices import add_diagonal, multiply, row, set_row
from ..mathlib.orbits.attitude import ANGLES, RATES, apply_matrix, linear_model
from ..mathlib.vectors import vector
from .orbital_control import OrbitalControl


class OrbitalModalControl(OrbitalControl):
    """Angles decay with angle_poles once what they lack of that, z = a' - S1 a, has decayed with rate_poles: z' = S0 z.

    u = J ((N A11 - S0 N - A21) a + (N + S0 - A22)(w - wp)), N = S1 - A11, S diagonal with minus the poles: multilevel
    placement with the levels angles and rates, made from the inertia known on board. The law is linear in yaw.
    Source: Lapin, thesis, chapter 3.1; formula: docs/systems/orbital_attitude.md.
    """

    angle_gain = State([0.0] * 9, columns=3, description="torque over angles, N m/rad, body")
    rate_gain = State([0.0] * 9, columns=3, description="torque over angular velocity less the orbit's, N m s, body")

    def begin(self) -> None:
        a = [0.0] * 36
        a11 = [0.0] * 9
        n = [0.0] * 9
        by_angles = [0.0] * 9  # N A11 - S0 N - A21
        by_rates = [0.0] * 9  # N + S0 - A22
        linear_model(self.inertia, self.inverse_inertia, self.orbital_rate, a)
        for i in range(3):
            set_row(a11, 3, i, 0, row(a, 6, ANGLES + i, ANGLES))
            set_row(n, 3, i, 0, -row(a11, 3, i, 0))
        add_diagonal(n, 3, 0, 0, -self.angle_poles)
        multiply(n, a11, by_angles, 3)
        for i in range(3):
            a21 = row(a, 6, RATES + i, ANGLES)
            a22 = row(a, 6, RATES + i, RATES)
            set_row(by_angles, 3, i, 0, row(by_angles, 3, i, 0) + self.rate_poles[i] * row(n, 3, i, 0) - a21)
            set_row(by_rates, 3, i, 0, row(n, 3, i, 0) - a22)
        add_diagonal(by_rates, 3, 0, 0, -self.rate_poles)
        multiply(self.inertia, by_angles, self.angle_gain, 3)
        multiply(self.inertia, by_rates, self.rate_gain, 3)

    def regulate(self, time: float) -> None:
        relative = self.estimated_angular_velocity + vector(0.0, 0.0, self.orbital_rate)
        by_angles = apply_matrix(self.angle_gain, self.estimated_angles)
        self.torque_command = by_angles + apply_matrix(self.rate_gain, relative)
