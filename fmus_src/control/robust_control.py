"""Control of trim and bank without knowledge of speed and pressure."""

from ..block import Parameter
from ..kernel.functions import cos, sin
from ..mathlib.vectors import Vector3, clip, vector
from .entry_control import EntryControl


class RobustControl(EntryControl):
    """Roll about the velocity at constant angle of attack and sideslip, with gains independent of pressure and speed.

    With sine s_0 and cosine c_0 of trim_attack, bank error e, reference bank γ_r, and rates g about and b across the
    velocity:

        g = ω_x c_0 - ω_y s_0    b = ω_x s_0 + ω_y c_0
        x_1 = γ_r'' - k_x (g - γ_r') - k_g e    x_2 = -k_b b
        u = J (c_0 x_1 + s_0 x_2, -s_0 x_1 + c_0 x_2, -k_z ω_z)

    x_1 is limited to largest_acceleration. At frozen pressure, with natural frequencies w_b and w_a of sideslip and
    angle of attack, the closed loop is stable for any pressure, with the characteristic polynomial

        (p^2 + k_x p + k_g) (p^2 + k_b p + w_b^2) (p^2 + k_z p + w_a^2)

    With the time-optimal bank programme this law is the combined algorithm of the thesis.

    Source: Lapin, thesis, chapter 3.2; gains: this repository.
    """

    dead_zone = EntryControl.dead_zone.with_start(0.02)
    bank_stiffness = Parameter(0.25, minimum=0.0, description="gain k_g from bank error to angular acceleration, 1/s2")
    bank_damping = Parameter(
        1.0, unit="1/s", minimum=0.0, description="gain k_x from bank rate error to angular acceleration"
    )
    sideslip_damping = Parameter(0.3, unit="1/s", minimum=0.0, description="gain k_b of the sideslip damping")
    pitch_damping = Parameter(0.3, unit="1/s", minimum=0.0, description="gain k_z of the pitch damping")
    largest_acceleration = Parameter(
        0.08, unit="rad/s2", minimum=0.0, description="largest angular acceleration commanded about the velocity"
    )

    def regulate(self) -> Vector3:
        w = self.measured_angular_velocity
        c0 = cos(self.trim_attack)
        s0 = sin(self.trim_attack)
        along = w.x * c0 - w.y * s0
        across = w.x * s0 + w.y * c0
        acceleration = (
            self.reference.bank_acceleration
            - self.bank_damping * (along - self.reference.bank_rate)
            - self.bank_stiffness * self.bank_error()
        )
        acceleration = clip(acceleration, -self.largest_acceleration, self.largest_acceleration)
        damped = -self.sideslip_damping * across
        turn = vector(c0 * acceleration + s0 * damped, c0 * damped - s0 * acceleration, -self.pitch_damping * w.z)
        return self.inertia @ turn
