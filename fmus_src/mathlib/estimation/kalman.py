"""Discrete-time Kalman filter. Kernel functions.

The estimate x is a column of n elements with covariance P, n x n. Measurements are scalars z = h x + error with a row
h, processed one after another; this needs no matrix inverse and is exact for independent errors. `update` processes a
linear measurement in one call; `innovation_variance` and `update_covariance` divide the update into two calls, for a
gate between them and for nonlinear measurements.

Source: Bar-Shalom, Li and Kirubarajan 2001, sections 5.2, 5.4 and 7.4.
"""

from ...kernel.matrices import Matrix, add_product


def predict(p: Matrix, f: Matrix, q: Matrix) -> Matrix:
    """Return the predicted covariance F P F' + Q; the caller propagates the estimate."""
    return add_product(q, f @ p, f.T)


def innovation_variance(p: Matrix, h: Matrix, variance: float) -> float:
    """Return the variance S = h P h' + variance of a scalar's innovation."""
    ph = p @ h.T
    s = variance
    for i in range(len(p)):
        s = s + h[0, i] * ph[i, 0]
    return s


def update_covariance(p: Matrix, h: Matrix, s: float, variance: float) -> tuple[Matrix, Matrix]:
    """Return the gain K = P h'/S and the covariance after a scalar with the innovation variance S > 0.

    The caller updates x to x + K innovation. The covariance is computed in the Joseph form, P = (1 - K h) P (1 - K h)'
    + K variance K', which stays symmetric and positive despite rounding of the gain.
    """
    ph = p @ h.T
    k = ph / s
    p_1 = p - k @ ph.T
    return k, p_1 - p_1 @ h.T @ k.T + variance * k @ k.T


def update(x: Matrix, p: Matrix, h: Matrix, variance: float, z: float) -> tuple[Matrix, Matrix, float]:
    """Return x and P updated by the scalar measurement z = h x + error, and the normalised innovation squared.

    ``variance`` (> 0) is the variance of the measurement error.
    """
    s = innovation_variance(p, h, variance)
    predicted = h @ x
    innovation = z - predicted[0, 0]
    k, corrected = update_covariance(p, h, s, variance)
    return x + k * innovation, corrected, innovation * innovation / s
