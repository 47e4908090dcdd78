"""Kalman filters of three equal axes at once, by filterpy, and the rows of the checks that use them."""

import numpy as np
from filterpy.kalman import KalmanFilter

from tests.support.checks.check import STEP
from tests.support.checks.white_noise import discretise

ROWS = 41
TIME = STEP * np.arange(ROWS)
PHASES = np.array([0.0, 1.0, 2.0])
NOT_FINITE = 24  # row of a sample that is not finite


def chain_filter(sigmas, sigma):
    """Return a filter of three like axes, of which the first states are measured; ``sigmas`` are those of the start."""
    n = 3 * len(sigmas)
    kalman = KalmanFilter(dim_x=n, dim_z=3)
    kalman.x = np.zeros(n)
    kalman.P = np.kron(np.diag(np.square(sigmas)), np.eye(3))
    kalman.H = np.eye(3, n)
    kalman.R = sigma**2 * np.eye(3)
    return kalman


def predict(kalman, density, u=None):
    """Predict a step: an integrator each from the last state to the first, with white noise of
    the densities on them."""
    n = len(density)
    transition, noise = discretise(np.eye(n, k=1), np.diag(density))
    kalman.predict(u=u, F=np.kron(transition, np.eye(3)), Q=np.kron(noise, np.eye(3)))


def innovation_square(kalman):
    return float(kalman.y @ np.linalg.solve(kalman.S, kalman.y))
