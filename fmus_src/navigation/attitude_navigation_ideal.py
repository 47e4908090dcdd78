"""Attitude navigation without errors."""

from .attitude_navigation import AttitudeNavigation


class AttitudeNavigationIdeal(AttitudeNavigation):
    """True attitude and angular velocity, as a reference without navigation errors.

    Assumes no sensors and no errors.
    """

    def initialize(self) -> None:
        self.set_outputs()

    def set_outputs(self) -> None:
        """Set the estimate to the true motion."""
        self.attitude_known = True
        self.estimated_quaternion = self.quaternion
        self.estimated_angular_velocity = self.angular_velocity

    def step(self, t: float, h: float) -> None:
        self.set_outputs()
