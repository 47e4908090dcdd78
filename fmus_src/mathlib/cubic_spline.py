"""Cubic splines through values at equidistant knots. Kernel functions.

Each row of a matrix is a curve of n values. The second derivative is 0 at the last knot; at the first knot either the
second derivative or, for a clamped spline, the slope is 0.

Source: Press, Teukolsky, Vetterling and Flannery 2007, section 3.3.
"""

from ..kernel.matrices import Matrix


def curvatures(values: Matrix, row: int, n: int, step: float, clamped: bool, result: Matrix) -> None:
    """Set result[row, :] to the second derivatives of one curve at its n <= 20 knots, by Thomas's algorithm."""
    upper = [0.0] * 20
    right = [0.0] * 20
    if clamped:
        upper[0] = 0.5
        right[0] = 3.0 / (step * step) * (values[row, 1] - values[row, 0])
    for i in range(1, n - 1):
        pivot = 4.0 - upper[i - 1]
        bend = (values[row, i + 1] - 2.0 * values[row, i] + values[row, i - 1]) / (step * step)
        upper[i] = 1.0 / pivot
        right[i] = (6.0 * bend - right[i - 1]) / pivot
    result[row, n - 1] = 0.0
    for k in range(1, n):
        i = n - 1 - k
        result[row, i] = right[i] - upper[i] * result[row, i + 1]


def cubic_value(values: Matrix, second: Matrix, row: int, n: int, step: float, x: float) -> float:
    """Return the value of a curve at x, counted in knots from the first; outside, the value at the nearer end; for
    NaN, the first value.
    """
    if not x > 0.0:
        return values[row, 0]
    if x >= step * float(n - 1):
        return values[row, n - 1]
    k = int(x / step)
    if k > n - 2:
        k = n - 2
    b = x / step - float(k)
    a = 1.0 - b
    bend = (a * a * a - a) * second[row, k] + (b * b * b - b) * second[row, k + 1]
    return a * values[row, k] + b * values[row, k + 1] + step * step / 6.0 * bend
