"""Matrices as lists in row order: elements, blocks of three, and the algebra of square ones. Kernel functions.

Only this file knows where an element is stored. ``n`` is the number of columns, and of rows where a matrix is square.
Indices i and j count from 0; a block or a part of a row or column is named by its first row and column.
`inverse` and `exponential` take up to six rows, `inverse_quadratic_form` up to fifteen. A result may not be
one of the arguments. Sums run from 0.0, or from what is added to, in order of the index that is summed over.
"""

import math

from .vector_types import Vector3, vector

TERMS = 16  # of the exponential's series: at a norm of 1/2 what is left out is below 1e-19


def element(a: list, n: int, i: int, j: int) -> float:
    """a_ij."""
    return a[n * i + j]


def set_element(a: list, n: int, i: int, j: int, value: float) -> None:
    """a_ij = value."""
    a[n * i + j] = value


def row(a: list, n: int, i: int, j: int) -> Vector3:
    """Three elements of row i, from column j on."""
    k = n * i + j
    return vector(a[k], a[k + 1], a[k + 2])


def set_row(a: list, n: int, i: int, j: int, v: Vector3) -> None:
    """Three elements of row i, from column j on, = v."""
    k = n * i + j
    a[k] = v.x
    a[k + 1] = v.y
    a[k + 2] = v.z


def column(a: list, n: int, i: int, j: int) -> Vector3:
    """Three elements of column j, from row i on."""
    k = n * i + j
    return vector(a[k], a[k + n], a[k + 2 * n])


def set_column(a: list, n: int, i: int, j: int, v: Vector3) -> None:
    """Three elements of column j, from row i on, = v."""
    k = n * i + j
    a[k] = v.x
    a[k + n] = v.y
    a[k + 2 * n] = v.z


def set_isotropic(a: list, n: int, i: int, j: int, value: float) -> None:
    """Diagonal of the 3 x 3 block at (i, j) = value: of a block of zeros, value times the identity."""
    for k in range(3):
        a[n * (i + k) + j + k] = value


def add_isotropic(a: list, n: int, i: int, j: int, value: float) -> None:
    """The 3 x 3 block at (i, j) + value times the identity."""
    for k in range(3):
        a[n * (i + k) + j + k] = a[n * (i + k) + j + k] + value


def add_diagonal(a: list, n: int, i: int, j: int, v: Vector3) -> None:
    """Diagonal of the 3 x 3 block at (i, j) + v."""
    for k in range(3):
        a[n * (i + k) + j + k] = a[n * (i + k) + j + k] + v[k]


def mirror(a: list, n: int, rows: int) -> None:
    """Below the diagonal, the first columns = the first rows above it."""
    for i in range(rows):
        for j in range(i + 1, n):
            a[n * j + i] = a[n * i + j]


def identity(a: list, n: int) -> None:
    """a = the identity of n rows."""
    for i in range(n * n):
        a[i] = 0.0
    for i in range(n):
        a[n * i + i] = 1.0


def multiply(a: list, b: list, c: list, n: int) -> None:
    """c = a b."""
    for i in range(n):
        for j in range(n):
            total = 0.0
            for k in range(n):
                total = total + a[n * i + k] * b[n * k + j]
            c[n * i + j] = total


def add_product(a: list, b: list, q: list, c: list, n: int) -> None:
    """c = q + a b'."""
    for i in range(n):
        for j in range(n):
            total = q[n * i + j]
            for k in range(n):
                total = total + a[n * i + k] * b[n * j + k]
            c[n * i + j] = total


def add_outer(a: list, factor: float, x: list, y: list, n: int) -> None:
    """a = a + factor x y'."""
    for i in range(n):
        scaled = factor * x[i]
        for j in range(n):
            a[n * i + j] = a[n * i + j] + scaled * y[j]


def multiply_vector(a: list, x: list, y: list, n: int) -> None:
    """y = a x."""
    for i in range(n):
        total = 0.0
        for k in range(n):
            total = total + a[n * i + k] * x[k]
        y[i] = total


def inverse_quadratic_form(p: list, e: list, n: int) -> float:
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


def inverse(a: list, b: list, n: int) -> bool:
    """b = a^-1 by elimination with row exchanges; whether there is one: a is finite and no pivot is 0.

    Without one b is not to be used. Source: Golub and Van Loan 2013, section 3.4.
    """
    rest = [0.0] * 36
    for i in range(n * n):
        rest[i] = a[i]
    identity(b, n)
    for k in range(n):
        p = k
        for i in range(k, n):
            if abs(rest[n * i + k]) > abs(rest[n * p + k]):
                p = i
        pivot = rest[n * p + k]
        if not (abs(pivot) > 0.0 and math.isfinite(pivot)):
            return False
        for j in range(n):
            upper = rest[n * k + j]
            rest[n * k + j] = rest[n * p + j] / pivot
            upper_b = b[n * k + j]
            b[n * k + j] = b[n * p + j] / pivot
            if p != k:
                rest[n * p + j] = upper
                b[n * p + j] = upper_b
        for i in range(n):
            if i != k:
                factor = rest[n * i + k]
                for j in range(n):
                    rest[n * i + j] = rest[n * i + j] - factor * rest[n * k + j]
                    b[n * i + j] = b[n * i + j] - factor * b[n * k + j]
    return True


def exponential(a: list, t: float, e: list, n: int) -> None:
    """e = exp(a t), a finite: the series of a t/2^k, whose norm is below 1/2, squared k times.

    Source: Moler and Van Loan 2003, method 3.
    """
    norm = 0.0
    for i in range(n):
        row = 0.0
        for j in range(n):
            row = row + abs(a[n * i + j] * t)
        if row > norm:
            norm = row
    scale = 1.0
    squarings = 0
    while norm * scale > 0.5:
        scale = 0.5 * scale
        squarings = squarings + 1
    part = [0.0] * 36
    term = [0.0] * 36
    product = [0.0] * 36
    for i in range(n * n):
        part[i] = a[i] * t * scale
    identity(e, n)
    identity(term, n)
    for k in range(1, TERMS):
        multiply(term, part, product, n)
        for i in range(n * n):
            term[i] = product[i] / float(k)
            e[i] = e[i] + term[i]
    for _ in range(squarings):
        multiply(e, e, product, n)
        for i in range(n * n):
            e[i] = product[i]
