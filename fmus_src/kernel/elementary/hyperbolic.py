"""sinh, cosh, tanh. Kernel functions.

Arguments up to 1 use a series, larger ones the exponential in two doubles.
"""

import math

from .exponential import LN2_HALF, exp_two, expm1_two, scale
from .two_doubles import product_error, sum_error

OVERFLOW = 710.4758600739439  # cosh of the next double is infinite

SINH_0 = 0.16666666666666666
SINH_1 = 0.008333333333333333
SINH_2 = 0.0001984126984126959
SINH_3 = 2.7557319224120236e-06
SINH_4 = 2.505210834564297e-08
SINH_5 = 1.6059050705698998e-10
SINH_6 = 7.64647637129043e-13
SINH_7 = 2.848398040912308e-15

COSH_0 = 0.04166666666666667
COSH_1 = 0.0013888888888888616
COSH_2 = 2.480158730176708e-05
COSH_3 = 2.755731916359127e-07
COSH_4 = 2.087676832476867e-09
COSH_5 = 1.1469540647362367e-11
COSH_6 = 4.8472408711593995e-14


def sinh(x: float) -> float:
    """Return the hyperbolic sine."""
    a = abs(x)
    if a <= 1.0:
        z = x * x
        w = z * z
        tail = (SINH_4 + z * SINH_5) + w * (SINH_6 + z * SINH_7)
        return x + x * (z * ((SINH_0 + z * SINH_1) + w * ((SINH_2 + z * SINH_3) + w * tail)))
    return math.copysign(half_exponentials(a, -1.0), x)


def cosh(x: float) -> float:
    """Return the hyperbolic cosine."""
    a = abs(x)
    if a <= 1.0:
        z = x * x
        w = z * z
        tail = (COSH_2 + z * COSH_3) + w * ((COSH_4 + z * COSH_5) + w * COSH_6)
        return 1.0 + (0.5 * z + w * ((COSH_0 + z * COSH_1) + w * tail))
    return half_exponentials(a, 1.0)


def half_exponentials(a: float, sign: float) -> float:
    """Return (exp(a) + sign exp(-a))/2 for a above 1."""
    if a > OVERFLOW:
        return math.inf
    if a != a:
        return a
    high, low, n = exp_two(a, 0.0)
    if a > 22.0:
        return scale(high + low, n - 1.0)
    half = math.ldexp(high, int(n) - 1)
    other = sign * 0.25 / half
    s = half + other
    return s + (sum_error(half, other, s) + math.ldexp(low, int(n) - 1))


def tanh(x: float) -> float:
    """Return the hyperbolic tangent: expm1(2 x)/(expm1(2 x) + 2)."""
    a = abs(x)
    if a > 22.0:
        return math.copysign(1.0, x)
    if a != a or a < 1e-9:
        return x
    if 2.0 * a <= LN2_HALF:
        e, tail = expm1_two(2.0 * a, 0.0)
    else:
        high, low, n = exp_two(2.0 * a, 0.0)
        h = math.ldexp(high, int(n))
        e = h - 1.0
        tail = sum_error(h, -1.0, e) + math.ldexp(low, int(n))
    d = e + 2.0
    d_tail = sum_error(e, 2.0, d) + tail
    q = e / d
    p = q * d
    return math.copysign(q + ((e - p) - product_error(q, d, p) + (tail - q * d_tail)) / d, x)
