"""Feedback of bank, roll rate and yaw rate of a capsule, with a constant or scheduled gain from pole placement."""

from ..block import Parameter
from ..kernel.functions import cos, log, sin
from ..mathlib.vectors import Vector3, dot, vector
from .entry_control import EntryControl


class OutputFeedback(EntryControl):
    """Output feedback of bank error, roll rate and yaw rate, with separate pitch damping.

        u = F (e, ω_x - γ_r' c_0, ω_y + γ_r' s_0) + J (c_0, -s_0, 0) γ_r''

    with bank error e, reference bank γ_r, and sine s_0 and cosine c_0 of trim_attack. F places the poles of bank,
    sideslip and the two rates at one dynamic pressure, or is interpolated between three in the logarithm of pressure.
    The parameter sets output_feedback_*.ssv of entry_attitude contain other gains, computed by `make gains`.

    Source: Lapin, thesis, chapters 2 and 3.2. See docs/systems/entry_attitude.md.
    """

    dead_zone = EntryControl.dead_zone.with_start(0.05)
    pitch_damping = Parameter(1200.0, unit="N.m.s", minimum=0.0, description="gain from pitch rate to pitch torque")
    pressures = Parameter(
        [1147.0, 1147.0, 1147.0],
        unit="Pa",
        minimum=1e-9,
        description="dynamic pressures at which gains are scheduled, ascending or all equal",
    )
    gains = Parameter(
        [-335.2711, -1260.9402, -890.1654, -113.8432, 382.3942, -1794.4671] * 3,
        columns=3,
        description=(
            "gains from bank error, roll rate and yaw rate to torques about x and y, SI units, two rows per "
            "dynamic pressure"
        ),
    )

    def gain_row(self, i: int, fraction: float) -> Vector3:
        """Return row i of the gains, interpolated linearly by ``fraction`` towards the gains of the next pressure."""
        low = self.gains[i, :]
        return low + fraction * (self.gains[i + 2, :] - low)

    def regulate(self) -> Vector3:
        c0 = cos(self.trim_attack)
        s0 = sin(self.trim_attack)
        wx = self.measured_angular_velocity.x - self.reference.bank_rate * c0
        wy = self.measured_angular_velocity.y + self.reference.bank_rate * s0
        errors = vector(self.bank_error(), wx, wy)
        k = 0
        fraction = 0.0
        p = self.dynamic_pressure
        if p >= self.pressures.y and self.pressures.z > self.pressures.y:
            k = 1
        if p > self.pressures[k] and self.pressures[k + 1] > self.pressures[k]:
            fraction = log(p / self.pressures[k]) / log(self.pressures[k + 1] / self.pressures[k])
        if fraction > 1.0:
            fraction = 1.0
        feed = self.inertia @ (self.reference.bank_acceleration * vector(c0, -s0, 0.0))
        x = dot(self.gain_row(2 * k, fraction), errors) + feed.x
        y = dot(self.gain_row(2 * k + 1, fraction), errors) + feed.y
        return vector(x, y, -self.pitch_damping * self.measured_angular_velocity.z)
