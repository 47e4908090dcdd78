"""Orbital attitude by placed poles."""

from ..block import State
from ..kernel.matrices import diagonal
from ..mathlib.orbits.attitude import ANGLES, RATES, linear_model
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
        a = linear_model(self.inertia, self.inverse_inertia, self.orbital_rate)
        s0 = -diagonal(self.rate_poles)
        n = -a[ANGLES, ANGLES] - diagonal(self.angle_poles)
        self.angle_gain = self.inertia @ (n @ a[ANGLES, ANGLES] - s0 @ n - a[RATES, ANGLES])
        self.rate_gain = self.inertia @ (n - a[RATES, RATES] + s0)

    def regulate(self, time: float) -> None:
        relative = self.estimated_angular_velocity + vector(0.0, 0.0, self.orbital_rate)
        self.torque_command = self.angle_gain @ self.estimated_angles + self.rate_gain @ relative
