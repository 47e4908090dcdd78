"""Trim and bank held without knowing speed or pressure."""

from ..block import Parameter
from ..kernel.functions import cos, sin
from ..mathlib.vectors import Vector3, clip, vector
from .entry_control import EntryControl


class RobustControl(EntryControl):
    """Rolls about the velocity, so that attack and sideslip stay, and damps what is across: free of pressure and speed.

    u = J (c0 x1 + s0 x2, -s0 x1 + c0 x2, -pitch_damping wz), c0, s0 of trim_attack, with the turn gd = wx c0 - wy s0
    about the velocity and bd = wx s0 + wy c0 across it: x1 = reference'' - bank_damping (gd - reference') -
    bank_stiffness error, within largest_acceleration, and x2 = -sideslip_damping bd. At frozen pressure the closed
    loop is (p^2 + k_x p + k_g)(p^2 + k_b p + w_b^2)(p^2 + k_z p + w_a^2), stable for any pressure. With the
    time-optimal bank programme it is the thesis's combined algorithm. Source: Lapin, thesis, chapter 3.2; gains ours.
    """

    dead_zone = EntryControl.dead_zone.with_start(0.02)
    bank_stiffness = Parameter(0.25, minimum=0.0, description="k_g, 1/s2")
    bank_damping = Parameter(1.0, unit="1/s", minimum=0.0, description="k_x")
    sideslip_damping = Parameter(0.3, unit="1/s", minimum=0.0, description="k_b")
    pitch_damping = Parameter(0.3, unit="1/s", minimum=0.0, description="k_z")
    largest_acceleration = Parameter(0.08, unit="rad/s2", minimum=0.0, description="about the velocity")

    def regulate(self) -> Vector3:
        w = self.measured_angular_velocity
        c0 = cos(self.trim_attack)
        s0 = sin(self.trim_attack)
        along = w.x * c0 - w.y * s0
        across = w.x * s0 + w.y * c0
        wanted = (
            self.reference.bank_acceleration
            - self.bank_damping * (along - self.reference.bank_rate)
            - self.bank_stiffness * self.bank_error()
        )
        wanted = clip(wanted, -self.largest_acceleration, self.largest_acceleration)
        damped = -self.sideslip_damping * across
        turn = vector(c0 * wanted + s0 * damped, c0 * damped - s0 * wanted, -self.pitch_damping * w.z)
        return self.inertia @ turn
