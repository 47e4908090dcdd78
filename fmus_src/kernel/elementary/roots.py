"""cbrt and hypot. Kernel functions.

cbrt evaluates a polynomial, then takes one step of Halley's method and one step of Newton's method with the exact
residual; hypot takes a square root and then one such Newton step.
"""

import math

from .exponential import scale
from .two_doubles import product_error, sum_error

TWO_TO_THIRD = 1.2599210498948732
FOUR_TO_THIRD = 1.5874010519681996

CBRT_0 = 0.40239010494180727
CBRT_1 = 1.1399968431050866
CBRT_2 = -0.9543796678935356
CBRT_3 = 0.5466441386901871
CBRT_4 = -0.13466062925225922


def cbrt(x: float) -> float:
    """Return the cube root."""
    if x == 0.0 or x - x != 0.0:
        return x
    m, k = math.frexp(abs(x))
    t = CBRT_0 + m * (CBRT_1 + m * (CBRT_2 + m * (CBRT_3 + m * CBRT_4)))
    if k % 3 == 1:
        m = 2.0 * m
        t = TWO_TO_THIRD * t
    elif k % 3 == 2:
        m = 4.0 * m
        t = FOUR_TO_THIRD * t
    cube = t * t * t
    t = t * (cube + 2.0 * m) / (2.0 * cube + m)
    square = t * t
    cube = square * t
    lost = product_error(square, t, cube) + product_error(t, t, square) * t
    t = t + ((m - cube) - lost) / (3.0 * square)
    return math.copysign(math.ldexp(t, k // 3), x)


def hypot(x: float, y: float) -> float:
    """Return sqrt(x^2 + y^2) without intermediate overflow."""
    a = abs(x)
    b = abs(x)
    if abs(y) > abs(x):
        a = abs(y)
    if abs(y) < abs(x):
        b = abs(y)
    if a == math.inf or b == math.inf:
        return math.inf
    if x != x or y != y:
        return math.nan
    if b == 0.0:
        return a
    _, k = math.frexp(a)
    a = math.ldexp(a, -k)
    b = math.ldexp(b, -k)
    aa = a * a
    bb = b * b
    s = aa + bb
    h = math.sqrt(s)
    hh = h * h
    lost = sum_error(aa, bb, s) + (product_error(a, a, aa) + product_error(b, b, bb) - product_error(h, h, hh))
    return scale(h + ((s - hh) + lost) / (2.0 * h), float(k))
