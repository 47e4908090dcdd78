"""Linear Kalman filter in discrete time, for up to nine states. Kernel functions.

A filter's memory is the estimate x (n floats) and its covariance p (n * n floats, row order).
Measurements are scalars taken one after another, which needs no matrix inverse and is exact
for independent errors. Source: Bar-Shalom, Li and Kirubarajan 2001, sections 5.2 and 7.4.
"""


def predict(x: list, p: list, f: list, q: list, n: int) -> None:
    """x = f x, p = f p f' + q. Matrices n x n in row order; a known input is added to x afterwards."""
    moved = [0.0] * 9
    for i in range(n):
        total = 0.0
        for k in range(n):
            total = total + f[n * i + k] * x[k]
        moved[i] = total
    for i in range(n):
        x[i] = moved[i]
    half = [0.0] * 81
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

    ``h`` is a row of n floats, ``variance`` that of the error (> 0). The covariance takes
    Joseph's form, p = (1 - k h) p (1 - k h)' + k variance k', which stays symmetric and
    positive whatever the gain's rounding.
    """
    ph = [0.0] * 9
    innovation = z
    s = variance
    for i in range(n):
        total = 0.0
        for k in range(n):
            total = total + p[n * i + k] * h[k]
        ph[i] = total
        innovation = innovation - h[i] * x[i]
    for i in range(n):
        s = s + h[i] * ph[i]
    gain = [0.0] * 9
    for i in range(n):
        gain[i] = ph[i] / s
    for i in range(n):
        x[i] = x[i] + gain[i] * innovation
    reduced = [0.0] * 81
    for i in range(n):
        for j in range(n):
            reduced[n * i + j] = p[n * i + j] - gain[i] * ph[j]
    rh = [0.0] * 9
    for i in range(n):
        total = 0.0
        for k in range(n):
            total = total + reduced[n * i + k] * h[k]
        rh[i] = total
    for i in range(n):
        for j in range(n):
            p[n * i + j] = reduced[n * i + j] - rh[i] * gain[j] + gain[i] * variance * gain[j]
    return innovation * innovation / s
