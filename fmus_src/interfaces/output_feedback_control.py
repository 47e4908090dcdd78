"""Bank, roll and yaw rate fed back by a constant matrix that places the poles."""

import math

from ..block import Parameter
from ..mathlib.orbital import applied
from ..mathlib.vectors import Vector3, vector
from .entry_control import EntryControl


class OutputFeedbackControl(EntryControl, interface=True):
    """u = F (bank error, wx, wy against the reference) + J (c0, -s0, 0) reference'', pitch damped by itself.

    F places the poles of bank, sideslip and two rates at one pressure, or is interpolated in its logarithm between
    three. Gains: mathlib/entry_gains.py, which `make gains` writes. Source: Lapin, thesis, chapters 2 and 3.2; numbers
    ours.
    """

    dead_zone = EntryControl.dead_zone.with_start(0.05)
    pitch_damping = Parameter(1200.0, unit="N.m.s", minimum=0.0, description="torque over pitch rate")
    pressures = Parameter(
        [1147.0, 1147.0, 1147.0], unit="Pa", minimum=1e-9, description="at which gains hold, ascending or all equal"
    )
    gains = Parameter(
        [0.0] * 18, columns=3, description="torques x, y over bank, wx, wy (SI): two rows for each pressure"
    )

    def regulate(self) -> Vector3:
        c0 = math.cos(self.trim_attack)
        s0 = math.sin(self.trim_attack)
        e = self.bank_error()
        wx = self.measured_angular_velocity.x - self.reference_bank_rate * c0
        wy = self.measured_angular_velocity.y + self.reference_bank_rate * s0
        k = 0
        share = 0.0
        p = self.dynamic_pressure
        if p >= self.pressures.y and self.pressures.z > self.pressures.y:
            k = 1
        if p > self.pressures[k] and self.pressures[k + 1] > self.pressures[k]:
            share = math.log(p / self.pressures[k]) / math.log(self.pressures[k + 1] / self.pressures[k])
        if share > 1.0:
            share = 1.0
        gain = [0.0] * 6
        for i in range(6):
            low = self.gains[6 * k + i]
            gain[i] = low + share * (self.gains[6 * k + 6 + i] - low)
        feed = applied(self.inertia, self.reference_bank_acceleration * vector(c0, -s0, 0.0))
        x = gain[0] * e + gain[1] * wx + gain[2] * wy + feed.x
        y = gain[3] * e + gain[4] * wx + gain[5] * wy + feed.y
        return vector(x, y, -self.pitch_damping * self.measured_angular_velocity.z)
