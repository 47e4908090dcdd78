"""Square matrices of up to six rows, as lists in row order. Kernel functions.

A result may not be one of the arguments. Sums run from 0.0 in order of the index that is summed over.
"""

import math

TERMS = 16  # of the exponential's series: at a norm of 1/2 what is left out is below 1e-19


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
