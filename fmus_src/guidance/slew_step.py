"""The target attitude at once."""

from .slew_guidance import SlewGuidance


class SlewStep(SlewGuidance):
    """No profile: from slew_start on the reference is the target, at rest.

    How fast the turn is, is then left to the controller's error_limit and to the wheels. Source: Wie 1998, section 7.
    """

    def plan(self) -> None:
        self.duration = 0.0

    def follow(self, time: float) -> None:
        pass
