"""Functions of matrices. Kernel functions; sums run in the order of the summation index."""

import math

from .functions import exp, log
from .matrix_types import Matrix, add_product, block, identity, matrix, zeros
from .vector_types import Vector, Vector3

__all__ = [
    "Matrix", "add_product", "block", "cross_matrix", "diagonal", "exponential", "identity", "inverse",
    "inverse_quadratic_form", "is_positive_definite", "largest_eigenvalue", "matrix", "mirror", "outer", "zeros",
]  # fmt: skip

SQUARINGS = 30  # squarings of a matrix that give its largest eigenvalue to 1e-9
TERMS = 16  # terms of the exponential's series: for a norm of 1/2 the remainder is below 1e-19


def diagonal(v: Vector) -> Matrix:
    """Return the matrix with the vector v on its diagonal and zeros elsewhere."""
    a = zeros(len(v), len(v))
    for i in range(len(v)):
        a[i, i] = v[i]
    return a


def outer(v: Vector, w: Vector) -> Matrix:
    """Return the outer product v w'."""
    a = zeros(len(v), len(w))
    for i in range(len(v)):
        for j in range(len(w)):
            a[i, j] = v[i] * w[j]
    return a


def mirror(a: Matrix, size: int) -> None:
    """Copy the upper triangle of the first ``size`` rows and columns to the lower triangle."""
    for i in range(size):
        for j in range(i + 1, size):
            a[j, i] = a[i, j]


def is_positive_definite(a: Matrix) -> bool:
    """Return True if a symmetric matrix is positive definite: all pivots of its elimination are positive."""
    reduced = a.copy()
    for k in range(len(a)):
        if not reduced[k, k] > 0.0:
            return False
        for i in range(k + 1, len(a)):
            factor = reduced[i, k] / reduced[k, k]
            for j in range(k + 1, len(a)):
                reduced[i, j] = reduced[i, j] - factor * reduced[k, j]
    return True


def largest_eigenvalue(a: Matrix) -> float:
    """Return the largest eigenvalue of a positive semidefinite symmetric matrix a; 0 for a = 0.

    It is the limit of trace(a^n)^(1/n), whose relative error at n = 2^SQUARINGS is below log(len(a))/n.
    """
    power = a.copy()
    exponent = 1.0
    logarithm = 0.0
    for _ in range(SQUARINGS):
        trace = 0.0
        for i in range(len(a)):
            trace = trace + power[i, i]
        if not trace > 0.0:
            return 0.0
        logarithm = logarithm + exponent * log(trace)
        power = (power / trace) @ (power / trace)
        exponent = 0.5 * exponent
    return exp(logarithm)


def inverse_quadratic_form(p: Matrix, e: Matrix) -> float:
    """Return e' p^-1 e by a factorisation p = l d l'; -1 if p is not positive definite.

    ``e`` is a column and ``p`` a symmetric matrix whose lower triangle is read. Source: Golub and Van Loan 2013,
    section 4.1.2.
    """
    lower = zeros(len(p), len(p))
    d = [0.0] * len(p)
    y = [0.0] * len(p)
    total = 0.0
    for i in range(len(p)):
        y[i] = e[i, 0]
        for j in range(i + 1):
            rest = p[i, j]
            for k in range(j):
                rest = rest - lower[i, k] * lower[j, k] * d[k]
            if j < i:
                lower[i, j] = rest / d[j]
                y[i] = y[i] - lower[i, j] * y[j]
            else:
                if not rest > 0.0:
                    return -1.0
                d[i] = rest
        total = total + y[i] * y[i] / d[i]
    return total


def inverse(a: Matrix) -> tuple[Matrix, bool]:
    """Return (a^-1, True) by elimination with row exchanges; (any matrix, False) if a is not finite or a pivot is 0.

    Source: Golub and Van Loan 2013, section 3.4.
    """
    rest = a.copy()
    b = identity(len(a))
    for k in range(len(a)):
        p = k
        for i in range(k, len(a)):
            if abs(rest[i, k]) > abs(rest[p, k]):
                p = i
        pivot = rest[p, k]
        if not (abs(pivot) > 0.0 and math.isfinite(pivot)):
            return b, False
        for j in range(len(a)):
            upper = rest[k, j]
            rest[k, j] = rest[p, j] / pivot
            upper_b = b[k, j]
            b[k, j] = b[p, j] / pivot
            if p != k:
                rest[p, j] = upper
                b[p, j] = upper_b
        for i in range(len(a)):
            if i != k:
                factor = rest[i, k]
                for j in range(len(a)):
                    rest[i, j] = rest[i, j] - factor * rest[k, j]
                    b[i, j] = b[i, j] - factor * b[k, j]
    return b, True


def exponential(a: Matrix, t: float) -> Matrix:
    """Return exp(a t) for a finite a: the series for a t/2^k with a norm below 1/2, squared k times.

    Source: Moler and Van Loan 2003, method 3.
    """
    norm = 0.0
    for i in range(len(a)):
        row = 0.0
        for j in range(len(a)):
            row = row + abs(a[i, j] * t)
        if row > norm:
            norm = row
    scale = 1.0
    squarings = 0
    while norm * scale > 0.5:
        scale = 0.5 * scale
        squarings = squarings + 1
    part = a * t * scale
    e = identity(len(a))
    term = identity(len(a))
    for k in range(1, TERMS):
        term = term @ part / float(k)
        e = e + term
    for _ in range(squarings):
        e = e @ e
    return e


def cross_matrix(v: Vector3) -> Matrix:
    """Return the 3 x 3 matrix V of a vector v, with V u = v x u."""
    return matrix([0.0, -v.z, v.y], [v.z, 0.0, -v.x], [-v.y, v.x, 0.0])
