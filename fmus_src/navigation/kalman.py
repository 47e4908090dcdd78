"""Inertial navigation with a Kalman filter."""

from ..kernel.matrices import Matrix
from ..mathlib.estimation.inertial import predict_errors
from ..mathlib.estimation.kalman import innovation_variance, update_covariance
from .filtered_navigation import FilteredNavigation


class KalmanNavigation(FilteredNavigation):
    """Inertial navigation corrected by altimeter, velocimeter and camera with a Kalman filter.

    The propagation computes only the blocks of the covariance that change; updates use the Joseph form.
    """

    def predict(self, h: float) -> None:
        walk = self.velocity_random_walk * self.velocity_random_walk
        drift = self.bias_random_walk * self.bias_random_walk
        up, gradient = self.local_gradient()
        predict_errors(self.covariance, self.force, not self.free_flight, walk, drift, up, gradient, h)

    def variance_of_innovation(self, row: Matrix, variance: float) -> float:
        return innovation_variance(self.covariance, row, variance)

    def correct(self, row: Matrix, innovation: float, s: float, variance: float) -> Matrix:
        gain, self.covariance = update_covariance(self.covariance, row, s, variance)
        return gain * innovation
