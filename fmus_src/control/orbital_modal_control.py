"""Control of the orbital attitude by pole placement."""

from ..block import State
from ..kernel.matrices import diagonal
from ..mathlib.orbits.attitude import ANGLES, RATES, linear_model
from ..mathlib.vectors import vector
from .orbital_control import OrbitalControl


class OrbitalModalControl(OrbitalControl):
    """Modal control with two levels: the angles a decay with angle_poles, their deviation z with rate_poles.

        u = J ((N A_11 - S_0 N - A_21) a + (N + S_0 - A_22) (ω - ω_p))    N = S_1 - A_11
        a' = S_1 a + z    z' = S_0 z

    A_ij are the 3 x 3 blocks of the linearised motion of a and ω - ω_p; S_1 and S_0 are diagonal matrices of minus the
    poles. The gains are computed from the inertia known on board. The law is linear in yaw.

    Source: Lapin, thesis, chapter 3.1. See docs/systems/orbital_attitude.md.
    """

    angle_gain = State([0.0] * 9, columns=3, description="gain matrix from angles to torque, N m/rad (body frame)")
    rate_gain = State(
        [0.0] * 9,
        columns=3,
        description="gain matrix from angular velocity relative to the orbital frame to torque, N m s (body frame)",
    )

    def begin(self) -> None:
        a = linear_model(self.inertia, self.inverse_inertia, self.orbital_rate)
        s0 = -diagonal(self.rate_poles)
        n = -a[ANGLES, ANGLES] - diagonal(self.angle_poles)
        self.angle_gain = self.inertia @ (n @ a[ANGLES, ANGLES] - s0 @ n - a[RATES, ANGLES])
        self.rate_gain = self.inertia @ (n - a[RATES, RATES] + s0)

    def regulate(self, time: float) -> None:
        relative = self.estimated_angular_velocity + vector(0.0, 0.0, self.orbital_rate)
        self.torque_command = self.angle_gain @ self.estimated_angles + self.rate_gain @ relative
