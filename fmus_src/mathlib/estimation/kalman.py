"""Kalman filter in discrete time, for up to fifteen states. Kernel functions.

A filter's memory is the estimate x (n floats) and its covariance P (n x n, row order).
Measurements are scalars z = h x + error, taken one after another, which needs no matrix inverse and is exact
for independent errors: `update` takes in a linear one at once; `innovation_variance` and
`correct` part it, for a gate in between and for measurements that are not linear in x.
Source: Bar-Shalom, Li and Kirubarajan 2001, sections 5.2, 5.4 and 7.4.
"""

from ...kernel.matrices import add_outer, add_product, multiply, multiply_vector


def predict(x: list, p: list, f: list, q: list, n: int) -> None:
    """x = F x, P = F P F' + Q. Matrices n x n in row order; a known input is added to x afterwards."""
    fx = [0.0] * 15
    fp = [0.0] * 225
    multiply_vector(f, x, fx, n)
    for i in range(n):
        x[i] = fx[i]
    multiply(f, p, fp, n)
    add_product(fp, f, q, p, n)  # P = Q + (F P) F'


def update(x: list, p: list, h: list, variance: float, z: float, n: int) -> float:
    """Take in the scalar measurement z = h x + error; returns the normalised innovation squared.

    ``h`` is a row of n floats, ``variance`` that of the error (> 0).
    """
    ph = [0.0] * 15
    s = innovation_variance(p, h, ph, variance, n)
    innovation = z
    for i in range(n):
        innovation = innovation - h[i] * x[i]
    correct(x, p, h, ph, innovation, s, variance, n)
    return innovation * innovation / s


def innovation_variance(p: list, h: list, ph: list, variance: float, n: int) -> float:
    """S = h P h' + variance, that of a scalar's innovation; ph (n floats) = P h'."""
    multiply_vector(p, h, ph, n)
    s = variance
    for i in range(n):
        s = s + h[i] * ph[i]
    return s


def correct(x: list, p: list, h: list, ph: list, innovation: float, s: float, variance: float, n: int) -> None:
    """Take in a scalar whose innovation has the variance S > 0 of `innovation_variance`: K = P h' / S.

    The covariance takes Joseph's form, P = (1 - K h) P (1 - K h)' + K variance K', which stays
    symmetric and positive whatever the gain's rounding.
    """
    gain = [0.0] * 15
    for i in range(n):
        gain[i] = ph[i] / s
        x[i] = x[i] + gain[i] * innovation
    reduced_h = [0.0] * 15
    add_outer(p, -1.0, gain, ph, n)  # P = (1 - K h) P
    multiply_vector(p, h, reduced_h, n)
    add_outer(p, -1.0, reduced_h, gain, n)  # P = P (1 - K h)'
    add_outer(p, variance, gain, gain, n)  # P = P + K variance K'
