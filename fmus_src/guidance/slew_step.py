"""Slew by a step of the reference to the target attitude."""

from .slew_guidance import SlewGuidance


class SlewStep(SlewGuidance):
    """Step of the reference at slew_start to the target attitude, at rest.

    The controller's error_limit and the wheels determine the rate of the turn.

    Source: Wie 1998, section 7.
    """

    def plan(self) -> None:
        self.duration = 0.0

    def follow(self, time: float) -> None:
        pass
