"""Navigation without errors."""

from ..interfaces.navigation import Navigation


class IdealNavigation(Navigation):
    """Ideal navigation: true position and velocity as the estimate.

    Frame: landing site.

    See docs/systems/lunar_navigation.md.
    """

    def initialize(self) -> None:
        self.measure()

    def measure(self) -> None:
        """Set the estimate to the true motion."""
        self.sample_count = self.sample_count + 1
        self.estimated_position = self.position
        self.estimated_velocity = self.velocity

    def step(self, t: float, h: float) -> None:
        self.measure()
