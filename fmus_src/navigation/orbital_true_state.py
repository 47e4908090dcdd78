"""Orbital attitude as it is."""

from ..interfaces.attitude_observer import AttitudeObserver


class OrbitalTrueState(AttitudeObserver):
    """The true angles and rates: what a regulator does when nothing is unknown."""

    def bound(self) -> None:
        """Tell the truth, whatever the sample."""
        self.angles_now = self.true_angles
        self.rates_now = self.true_angular_velocity
