"""Orbital attitude without observer errors."""

from ..mathlib.orbits.attitude import AttitudeState
from .attitude_observer import AttitudeObserver


class OrbitalTrueState(AttitudeObserver):
    """True angles and rates, as a reference without observer errors."""

    def bound(self) -> None:
        """Set the estimate to the true state, independently of the sample."""
        self.estimate = AttitudeState(angles=self.true_angles, angular_velocity=self.true_angular_velocity)
