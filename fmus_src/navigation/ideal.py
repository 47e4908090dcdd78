"""Navigation without errors."""

from ..interfaces.navigation import Navigation


class IdealNavigation(Navigation):
    """Ideal navigation: the estimate is the truth, and nothing else of the slot is used.

    Frame: landing site. What it is compared with: docs/systems/lunar_navigation.md.
    """

    def initialize(self) -> None:
        self.measure()

    def measure(self) -> None:
        """Pass the truth on."""
        self.sample_count = self.sample_count + 1
        self.estimated_position = self.position
        self.estimated_velocity = self.velocity

    def step(self, t: float, h: float) -> None:
        self.measure()
