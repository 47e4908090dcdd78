"""Orbital attitude by placed poles."""

from ..block import State
from ..kernel.matrices import multiply
from ..mathlib.orbits.attitude import apply_matrix, linear_model
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
        wanted = [0.0] * 9
        coupling = [0.0] * 9
        by_angles = [0.0] * 9
        by_rates = [0.0] * 9
        linear_model(self.inertia, self.inverse_inertia, self.orbital_rate, a)
        for i in range(3):
            for k in range(3):
                coupling[3 * i + k] = a[6 * i + k]
                wanted[3 * i + k] = -a[6 * i + k]
            wanted[4 * i] = wanted[4 * i] - self.angle_poles[i]
        multiply(wanted, coupling, by_angles, 3)
        for i in range(3):
            for k in range(3):
                by_angles[3 * i + k] = (
                    by_angles[3 * i + k] + self.rate_poles[i] * wanted[3 * i + k] - a[6 * (3 + i) + k]
                )
                by_rates[3 * i + k] = wanted[3 * i + k] - a[6 * (3 + i) + 3 + k]
            by_rates[4 * i] = by_rates[4 * i] - self.rate_poles[i]
        multiply(self.inertia, by_angles, self.angle_gain, 3)
        multiply(self.inertia, by_rates, self.rate_gain, 3)

    def regulate(self, time: float) -> None:
        relative = self.estimated_angular_velocity + vector(0.0, 0.0, self.orbital_rate)
        by_angles = apply_matrix(self.angle_gain, self.estimated_angles)
        self.torque_command = by_angles + apply_matrix(self.rate_gain, relative)
