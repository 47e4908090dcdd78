"""Inertial navigation with a Kalman filter from the library filterpy."""

from typing import Any

import numpy as np

from ..kernel.matrices import Matrix
from .filtered_navigation import FilteredNavigation


class KalmanNavigationFilterpy(FilteredNavigation):
    """Inertial navigation with filterpy's Kalman filter, a second implementation of kalman_navigation in Python only.

    The filter's state is the correction of the estimate and is 0 between updates; the matrices are full.
    """

    python_only = True
    requires = ("filterpy", "numpy")

    def filter(self) -> Any:
        """Return a filterpy.kalman.KalmanFilter with the present covariance; nothing is stored in it between steps."""
        from filterpy.kalman import KalmanFilter  # imports scipy.stats, which takes half a second

        made = KalmanFilter(dim_x=15, dim_z=1)
        made.P = np.array(self.covariance)
        return made

    def predict(self, h: float) -> None:
        made = self.filter()
        x, y, z = self.force
        skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
        addition = np.hstack([np.eye(3), np.diag(self.force), -skew])  # w x f = -f x w
        made.F = np.eye(15)
        made.F[0:3, 3:6] = h * np.eye(3)
        made.F[0:3, 6:15] = -0.5 * h * h * addition
        made.F[3:6, 6:15] = -h * addition
        noise = np.vstack([0.5 * h * np.eye(3), np.eye(3), np.zeros((9, 3))])
        made.Q = self.velocity_random_walk**2 * h * noise @ noise.T
        if self.free_flight:
            made.F[0:6, 6:15] = 0.0
            made.Q[:] = 0.0
        up, size = self.local_gradient()
        upward = np.array([up.x, up.y, up.z])
        gradient = size * (3.0 * np.outer(upward, upward) - np.eye(3))
        made.F[0:3, 0:6] += 0.5 * h * h * np.hstack([gradient, 0.5 * h * gradient])
        made.F[3:6, 0:6] += h * np.hstack([gradient, 0.5 * h * gradient])
        made.Q[6:9, 6:9] = self.bias_random_walk**2 * h * np.eye(3)
        made.predict()
        self.covariance = made.P

    def variance_of_innovation(self, row: Matrix, variance: float) -> float:
        (h,) = np.array(row)
        return float(h @ self.filter().P @ h + variance)

    def correct(self, row: Matrix, innovation: float, s: float, variance: float) -> Matrix:
        made = self.filter()
        made.update(np.array([[innovation]]), R=np.array([[variance]]), H=np.array(row))
        self.covariance = made.P
        return Matrix(made.x.tolist())
