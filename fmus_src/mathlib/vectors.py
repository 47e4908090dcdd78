"""Vectors of three components, as lists of floats. Kernel functions; no frame implied."""

import math


def dot(a: list, b: list) -> float:
    """Scalar product of two 3-vectors."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def norm(a: list) -> float:
    """Euclidean length of a 3-vector."""
    return math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])


def cross(a: list, b: list, product: list) -> None:
    """product = a x b; it may be the same list as a or b."""
    x = a[1] * b[2] - a[2] * b[1]
    y = a[2] * b[0] - a[0] * b[2]
    z = a[0] * b[1] - a[1] * b[0]
    product[0] = x
    product[1] = y
    product[2] = z


def copy3(target: list, source: list) -> None:
    """target = source, element by element."""
    for i in range(3):
        target[i] = source[i]


def clip(value: float, low: float, high: float) -> float:
    """The value, no less than low and no more than high."""
    if value < low:
        return low
    if value > high:
        return high
    return value
