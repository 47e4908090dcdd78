"""Slew by a step of the reference to the target attitude."""

from .slew_guidance import SlewGuidance


class SlewStep(SlewGuidance):
    """Step of the reference to the target at slew_start, at rest.

    The rate of the turn is determined by the controller's error_limit and by the wheels.

    Source: Wie 1998, section 7.
    """

    def plan(self) -> None:
        self.duration = 0.0

    def follow(self, time: float) -> None:
        pass
