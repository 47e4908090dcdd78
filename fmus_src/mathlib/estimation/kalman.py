"""Kalman filter in discrete time. Kernel functions.

The estimate x is a column of n, its covariance P n x n. Measurements are scalars z = h x + error, h a row, taken one
after another, which needs no matrix inverse and is exact for independent errors: `update` takes in a linear one at
once; `innovation_variance` and `take_in` split it, for a gate in between and for measurements that are not linear in x.
Source: Bar-Shalom, Li and Kirubarajan 2001, sections 5.2, 5.4 and 7.4.
"""

from ...kernel.matrices import Matrix, add_product


def predict(p: Matrix, f: Matrix, q: Matrix) -> Matrix:
    """Return F P F' + Q; the estimate becomes F x, and a known input is added to it."""
    return add_product(q, f @ p, f.T)


def innovation_variance(p: Matrix, h: Matrix, variance: float) -> float:
    """Return S = h P h' + variance, that of a scalar's innovation."""
    ph = p @ h.T
    s = variance
    for i in range(len(p)):
        s = s + h[0, i] * ph[i, 0]
    return s


def take_in(p: Matrix, h: Matrix, s: float, variance: float) -> tuple[Matrix, Matrix]:
    """Return the gain K = P h' / S and covariance after a scalar with the variance S > 0 of `innovation_variance`.

    x becomes x + K innovation. The covariance takes Joseph's form, P = (1 - K h) P (1 - K h)' + K variance K', which
    stays symmetric and positive whatever the gain's rounding.
    """
    ph = p @ h.T
    k = ph / s
    p_1 = p - k @ ph.T
    return k, p_1 - p_1 @ h.T @ k.T + variance * k @ k.T


def update(x: Matrix, p: Matrix, h: Matrix, variance: float, z: float) -> tuple[Matrix, Matrix, float]:
    """Return x and P updated by the scalar measurement z = h x + error, and the normalised innovation squared.

    ``variance`` is that of the error (> 0).
    """
    s = innovation_variance(p, h, variance)
    predicted = h @ x
    innovation = z - predicted[0, 0]
    k, corrected = take_in(p, h, s, variance)
    return x + k * innovation, corrected, innovation * innovation / s
