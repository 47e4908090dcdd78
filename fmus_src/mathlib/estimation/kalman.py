"""Kalman filter in discrete time, for up to fifteen states. Kernel functions.

A filter's memory is the estimate x (n floats) and its covariance p (n * n floats, row order).
Measurements are scalars taken one after another, which needs no matrix inverse and is exact
for independent errors: `update` takes in a linear one at once; `innovation_variance` and
`correct` part it, for a gate in between and for measurements that are not linear in x.
Source: Bar-Shalom, Li and Kirubarajan 2001, sections 5.2, 5.4 and 7.4.
"""


def predict(x: list, p: list, f: list, q: list, n: int) -> None:
    """x = f x, p = f p f' + q. Matrices n x n in row order; a known input is added to x afterwards."""
    moved = [0.0] * 15
    for i in range(n):
        total = 0.0
        for k in range(n):
            total = total + f[n * i + k] * x[k]
        moved[i] = total
    for i in range(n):
        x[i] = moved[i]
    half = [0.0] * 225
    for i in range(n):
        for j in range(n):
            total = 0.0
            for k in range(n):
                total = total + f[n * i + k] * p[n * k + j]
            half[n * i + j] = total
    for i in range(n):
        for j in range(n):
            total = q[n * i + j]
            for k in range(n):
                total = total + half[n * i + k] * f[n * j + k]
            p[n * i + j] = total


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
    """Variance h p h' + variance of a scalar's innovation; ph (n floats) = p h'."""
    s = variance
    for i in range(n):
        total = 0.0
        for k in range(n):
            total = total + p[n * i + k] * h[k]
        ph[i] = total
    for i in range(n):
        s = s + h[i] * ph[i]
    return s


def correct(x: list, p: list, h: list, ph: list, innovation: float, s: float, variance: float, n: int) -> None:
    """Take in a scalar whose innovation has the variance s > 0 of `innovation_variance`.

    The covariance takes Joseph's form, p = (1 - k h) p (1 - k h)' + k variance k', which stays
    symmetric and positive whatever the gain's rounding.
    """
    gain = [0.0] * 15
    for i in range(n):
        gain[i] = ph[i] / s
    for i in range(n):
        x[i] = x[i] + gain[i] * innovation
    reduced = [0.0] * 225
    for i in range(n):
        for j in range(n):
            reduced[n * i + j] = p[n * i + j] - gain[i] * ph[j]
    rh = [0.0] * 15
    for i in range(n):
        total = 0.0
        for k in range(n):
            total = total + reduced[n * i + k] * h[k]
        rh[i] = total
    for i in range(n):
        for j in range(n):
            p[n * i + j] = reduced[n * i + j] - rh[i] * gain[j] + gain[i] * variance * gain[j]


def normalised_square(p: list, e: list, n: int) -> float:
    """e' p^-1 e by a factorisation p = l d l'; -1 where p is not positive definite.

    ``e`` holds n floats, ``p`` a symmetric matrix, of which the lower triangle is read.
    Source: Golub and Van Loan 2013, section 4.1.2.
    """
    lower = [0.0] * 225  # below the diagonal; d on it
    y = [0.0] * 15
    total = 0.0
    for i in range(n):
        y[i] = e[i]
        for j in range(i + 1):
            rest = p[n * i + j]
            for k in range(j):
                rest = rest - lower[n * i + k] * lower[n * j + k] * lower[n * k + k]
            if j < i:
                lower[n * i + j] = rest / lower[n * j + j]
                y[i] = y[i] - lower[n * i + j] * y[j]
            else:
                if not rest > 0.0:
                    return -1.0
                lower[n * i + i] = rest
        total = total + y[i] * y[i] / lower[n * i + i]
    return total
