"""x to the power y as exp(y log x), with the logarithm and the product in two doubles. Kernel functions."""

import math

from .exponential import exp_two, scale
from .logarithm import log_two
from .two_doubles import product_error

WHOLE = 4503599627370496.0  # 2^52: larger doubles are integers, and from 2^53 on even integers


def is_odd(y: float) -> bool:
    """Return True if a double is an odd integer."""
    a = abs(y)
    if a >= 2.0 * WHOLE:
        return False
    half = 0.5 * a
    whole = half + WHOLE - WHOLE
    return abs(half - whole) == 0.5


def is_whole(y: float) -> bool:
    """Return True if a double is an integer."""
    a = abs(y)
    return a >= WHOLE or a + WHOLE - WHOLE == a


def power_of_edge(a: float, y: float) -> float:
    """Return a^y if a is 0 or infinite, or y is infinite."""
    if a == 1.0:
        return 1.0
    if (a > 1.0) == (y > 0.0):
        return math.inf
    return 0.0


def pow(x: float, y: float) -> float:
    """Return x^y; NaN for a negative x unless y is an integer."""
    if y == 0.0 or x == 1.0:
        return 1.0
    if x != x or y != y:
        return math.nan
    if y == 1.0:
        return x
    if y == 2.0:
        return x * x
    a = abs(x)
    sign = 1.0
    if (x < 0.0 or a == 0.0) and is_odd(y):
        sign = math.copysign(1.0, x)
    if a == 0.0 or a == math.inf or abs(y) == math.inf:
        return sign * power_of_edge(a, y)
    if x < 0.0 and sign > 0.0 and not is_whole(y):
        return math.nan
    if a == 1.0:
        return sign
    high, low = log_two(a)
    p = y * high
    if p > 710.0:
        return sign * math.inf
    if p < -746.0:
        return sign * 0.0
    if abs(p) < 1e-17:
        return sign
    h, tail, n = exp_two(p, product_error(y, high, p) + y * low)
    return sign * scale(h + tail, n)
