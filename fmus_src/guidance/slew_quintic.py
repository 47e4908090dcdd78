"""Slew with continuous angular acceleration."""

import math

from .slew_guidance import SlewGuidance, SlewProgress

PEAK_RATE = 1.875  # of angle/duration, half way
PEAK_ACCELERATION = 5.773502691896258  # 10/sqrt(3) of angle/duration^2, at (3 -+ sqrt(3))/6 of the duration


class SlewQuintic(SlewGuidance):
    """Turn by an angle that is a fifth-degree polynomial of time, with continuous acceleration.

    With rate_limit w and acceleration_limit u:

        θ(s) = θ (10 s^3 - 15 s^4 + 6 s^5)    s = t/T    T = max(15 θ/(8 w), sqrt(10 θ/(sqrt(3) u)))

    The acceleration is 0 at both ends, so flexible modes are hardly excited.

    Source: Biagiotti and Melchiorri 2008, section 2.1.
    """

    def plan(self) -> None:
        self.duration = PEAK_RATE * self.slew_angle / self.rate_limit
        by_acceleration = math.sqrt(PEAK_ACCELERATION * self.slew_angle / self.acceleration_limit)
        if by_acceleration > self.duration:
            self.duration = by_acceleration

    def follow(self, time: float) -> None:
        s = time / self.duration
        remaining = 1.0 - s
        self.progress = SlewProgress(
            angle=self.slew_angle * s * s * s * (10.0 - s * (15.0 - 6.0 * s)),
            rate=30.0 * self.slew_angle / self.duration * s * s * remaining * remaining,
        )
