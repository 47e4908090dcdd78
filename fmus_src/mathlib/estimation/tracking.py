"""Kalman filter of a value, its rate and a disturbance of the rate, equal for all axes. Kernel functions.

Axes with equal initial and measurement errors share one covariance: 2 x 2 for value and rate, or 3 x 3 with the
disturbance, an unknown derivative of the rate. The caller adds the known derivative of the rate and gain times
innovation to the estimates.

Source: Bar-Shalom, Li and Kirubarajan 2001, sections 5.2, 6.2.2 and 6.2.3 (discretised white noise).
"""

from ...kernel.matrices import Matrix, matrix, zeros
from .kalman import innovation_variance, predict, update_covariance

# Rows and columns: value, rate, disturbance of the rate.
TRACKED = 0
RATE = 1
DISTURBANCE = 2


def predict_pair(p: Matrix, r: float, h: float) -> Matrix:
    """Return the covariance of value and rate after h (s) with white noise in the derivative of the rate.

    ``r`` is the spectral density of the noise (value^2/s^3).
    """
    f = matrix([1.0, h], [0.0, 1.0])
    q12 = r * h * h / 2.0
    q = matrix([r * h * h * h / 3.0, q12], [q12, r * h])
    return predict(p, f, q)


def predict_triple(p: Matrix, r: float, d: float, h: float) -> Matrix:
    """Return the covariance with a disturbance after h (s), with white noise also in the disturbance's derivative.

    ``d`` is the spectral density of this noise (value^2/s^5).
    """
    f = matrix([1.0, h, 0.5 * h * h], [0.0, 1.0, h], [0.0, 0.0, 1.0])
    q11 = r * h * h * h / 3.0 + d * h * h * h * h * h / 20.0
    q12 = r * h * h / 2.0 + d * h * h * h * h / 8.0
    q13 = d * h * h * h / 6.0
    q22 = r * h + d * h * h * h / 3.0
    q23 = d * h * h / 2.0
    q = matrix([q11, q12, q13], [q12, q22, q23], [q13, q23, d * h])
    return predict(p, f, q)


def measure_chain(p: Matrix, variance: float) -> tuple[Matrix, Matrix, float]:
    """Return gain, covariance and innovation variance after a measurement of the value with a variance (> 0)."""
    h = zeros(1, len(p))
    h[0, TRACKED] = 1.0
    s = innovation_variance(p, h, variance)
    k, corrected = update_covariance(p, h, s, variance)
    return k, corrected, s
