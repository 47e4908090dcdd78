"""Dead-reckoning navigation without a filter."""

from ..mathlib.lunar.gravity import from_centre
from ..mathlib.vectors import norm
from .inertial_navigation import InertialNavigation


class RawNavigation(InertialNavigation):
    """Dead reckoning in which each fix replaces the estimate.

    A position fix replaces the position, a velocity fix the velocity; an altitude moves the position along the local
    vertical to that altitude. Among samples at the same time, the position fix is used last. Sigmas and covariance are
    0 (unknown).
    """

    def initialize(self) -> None:
        self.initialise_estimate()
        self.use_samples()

    def use_samples(self) -> None:
        """Replace the estimate by the new samples."""
        if self.altitude_count != self.altitude_taken:
            self.altitude_taken = self.altitude_count
            self.sample_count = self.sample_count + 1
            self.correct_altitude(self.measured_altitude)
        if self.velocity_count != self.velocity_taken:
            self.velocity_taken = self.velocity_count
            self.sample_count = self.sample_count + 1
            self.estimated_velocity = self.measured_velocity
        if self.position_count != self.position_taken:
            self.position_taken = self.position_count
            self.sample_count = self.sample_count + 1
            self.estimated_position = self.measured_position

    def correct_altitude(self, altitude: float) -> None:
        """Move the estimated position along the local vertical to an altitude (m)."""
        centred = from_centre(self.estimated_position, self.moon_radius)
        distance = norm(centred)
        if distance > 0.0:
            rise = self.moon_radius + altitude - distance
            self.estimated_position = self.estimated_position + rise * centred / distance

    def step(self, t: float, h: float) -> None:
        self.sense(h)
        self.move(h)
        self.use_samples()
