"""Navigation through a Kalman filter."""

from ..mathlib.estimation.inertial import predict_errors
from ..mathlib.estimation.kalman import correct, innovation_variance
from .filtered_navigation import FilteredNavigation


class KalmanNavigation(FilteredNavigation):
    """Kalman navigation: inertial navigation corrected from altimeter, velocimeter and camera by a Kalman filter.

    The prediction works on the blocks of the covariance that change; updates take Joseph's form.
    States, gate, status and frame: FilteredNavigation.
    """

    def predict(self, h: float) -> None:
        walk = self.velocity_random_walk * self.velocity_random_walk
        drift = self.bias_random_walk * self.bias_random_walk
        up, gradient = self.local_gradient()
        predict_errors(self.covariance, self.force, not self.free_flight, walk, drift, up, gradient, h)

    def weigh(self, row: list, ph: list, variance: float) -> float:
        return innovation_variance(self.covariance, row, ph, variance, 15)

    def take_in(self, row: list, ph: list, innovation: float, s: float, variance: float, correction: list) -> None:
        correct(correction, self.covariance, row, ph, innovation, s, variance, 15)
