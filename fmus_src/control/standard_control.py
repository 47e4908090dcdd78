"""Control of bank and rates by relays, as is usual for capsules."""

import math

from ..block import Parameter, State
from ..mathlib.vectors import Vector3, clip, vector
from ..units import deg
from .entry_control import EntryControl


class StandardControl(EntryControl):
    """Relays with hysteresis: bank with its rate about x, damping about y and z.

    A relay closes when its signal exceeds a threshold y and opens when it falls below y/2. A closed relay demands the
    full torque level, so pulses fill the sample period. The roll signal is

        x = clip(γ - γ_target, bank_limit) + lead_time ω_x

    and the yaw and pitch signals are the rates.

    Source: Lapin, thesis, chapter 3.2, which states an accuracy of 3 deg; thresholds: this repository.
    """

    bank_limit = Parameter(
        deg(24.0),
        unit="rad",
        minimum=0.0,
        description="magnitude to which the bank error is limited in the roll signal",
    )
    lead_time = Parameter(
        2.0, unit="s", minimum=0.0, description="lead time: weight of the roll rate in the roll signal"
    )
    thresholds = Parameter(
        [deg(2.0), deg(1.0), deg(1.0)],
        minimum=0.0,
        description="relay thresholds of the roll signal (rad), yaw rate and pitch rate (rad/s)",
    )
    signs = State(
        [0.0, 0.0, 0.0],
        vector=False,
        unit="1",
        description="output signs of the relays for roll, yaw and pitch; 0: relay open",
    )

    def relay(self, k: int, x: float) -> float:
        """Update relay k for its signal and return its torque demand (N m)."""
        if self.signs[k] * x < 0.5 * self.thresholds[k]:
            self.signs[k] = 0.0
        if abs(x) > self.thresholds[k]:
            self.signs[k] = math.copysign(1.0, x)
        return -self.signs[k] * self.jet_torque[k]

    def regulate(self) -> Vector3:
        w = self.measured_angular_velocity
        error = clip(self.wrap_angle(self.measured_bank - self.target_bank), -self.bank_limit, self.bank_limit)
        x = self.relay(0, error + self.lead_time * w.x)
        y = self.relay(1, w.y)
        z = self.relay(2, w.z)
        return vector(x, y, z)
