"""Time-optimal slew within limits of rate and acceleration."""

import math

from .slew_guidance import SlewGuidance, SlewProgress


class SlewBangCoast(SlewGuidance):
    """Bang-coast-bang turn: full acceleration, coast at rate_limit, full deceleration, in least time.

    With the angle θ, rate_limit w and acceleration_limit u the duration is

        T = θ/w + w/u    if θ >= w^2/u
        T = 2 sqrt(θ/u)    if θ < w^2/u

    The acceleration is discontinuous, which excites flexible modes.

    Source: Wie 1998, section 7.
    """

    def peak_rate(self) -> float:
        """Return the largest angular rate (rad/s) of the turn."""
        reachable = math.sqrt(self.slew_angle * self.acceleration_limit)
        if reachable < self.rate_limit:
            return reachable
        return self.rate_limit

    def plan(self) -> None:
        self.duration = 0.0
        rate = self.peak_rate()
        if rate > 0.0:
            self.duration = self.slew_angle / rate + rate / self.acceleration_limit

    def follow(self, time: float) -> None:
        rate = self.peak_rate()
        u = self.acceleration_limit
        ramp = rate / u
        left = self.duration - time
        if time < ramp:
            self.progress = SlewProgress(angle=0.5 * u * time * time, rate=u * time)
        elif left < ramp:
            self.progress = SlewProgress(angle=self.slew_angle - 0.5 * u * left * left, rate=u * left)
        else:
            self.progress = SlewProgress(angle=rate * (time - 0.5 * ramp), rate=rate)
