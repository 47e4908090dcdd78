"""log, log2, log10, log1p. Kernel functions.

x = 2^k m with m from sqrt(1/2) to sqrt(2), f = m - 1, s = f/(2 + f), and log(1 + f) = 2 atanh(s) = f - s (f - R) with R
= s^2 L(s^2) (Ng, in the freely distributable mathematical library of Sun Microsystems, 1993). `log_two` evaluates the
same series in two doubles.
"""

import math

from .exponential import LN2_HIGH, LN2_LOW, LOG2_E
from .two_doubles import product_error, sum_error

SQRT_HALF = 0.7071067811865476
THIRD = 0.3333333333333333
THIRD_TAIL = 1.850371707708594e-17
LOG2_E_TAIL = 2.0355273740931033e-17
LOG10_E = 0.4342944819032518
LOG10_E_TAIL = 1.098319650216765e-17

LOG_0 = 0.6666666666666734
LOG_1 = 0.3999999999941471
LOG_2 = 0.28571428742379895
LOG_3 = 0.22222198574033158
LOG_4 = 0.18183564279449033
LOG_5 = 0.15314051808710707
LOG_6 = 0.14795936525304262

LOG_TAIL_0 = 0.20000000000001017
LOG_TAIL_1 = 0.14285714285094173
LOG_TAIL_2 = 0.11111111253066937
LOG_TAIL_3 = 0.09090892721067768
LOG_TAIL_4 = 0.07693356230005688
LOG_TAIL_5 = 0.06628888259743436
LOG_TAIL_6 = 0.06594041550265131


def split(x: float) -> tuple[float, float]:
    """Return m and k of x = 2^k m, m from sqrt(1/2) to sqrt(2)."""
    m, k = math.frexp(x)
    if m < SQRT_HALF:
        return m + m, float(k - 1)
    return m, float(k)


def without_logarithm(x: float) -> float:
    """Return the logarithm of a number whose logarithm is not finite: 0, a negative number, infinity or NaN."""
    if x == 0.0:
        return -math.inf
    if x < 0.0:
        return math.nan
    return x


def log_sum(f: float, k: float, tail: float) -> float:
    """Return log(1 + f) + k ln 2 + tail."""
    s = f / (2.0 + f)
    z = s * s
    w = z * z
    r = z * (LOG_0 + w * (LOG_2 + w * (LOG_4 + w * LOG_6))) + w * (LOG_1 + w * (LOG_3 + w * LOG_5))
    half = 0.5 * f * f
    return k * LN2_HIGH - ((half - (s * (half + r) + (k * LN2_LOW + tail))) - f)


def log(x: float) -> float:
    """Return the natural logarithm."""
    if x <= 0.0 or x - x != 0.0:
        return without_logarithm(x)
    m, k = split(x)
    return log_sum(m - 1.0, k, 0.0)


def log1p(x: float) -> float:
    """Return log(1 + x), without losing digits for small x."""
    if x <= -1.0 or x - x != 0.0:
        return without_logarithm(1.0 + x)
    if abs(x) < 1e-17:
        return x
    if x > -0.2928 and x < 0.4142:
        return log_sum(x, 0.0, 0.0)
    y = 1.0 + x
    m, k = split(y)
    return log_sum(m - 1.0, k, sum_error(1.0, x, y) / y)


def log_two(x: float) -> tuple[float, float]:
    """Return the logarithm of a positive finite number as a sum of two doubles with a relative error below 2^-64."""
    m, k = split(x)
    f = m - 1.0
    d = 2.0 + f
    s = f / d
    p = s * d
    s_low = ((f - p) - product_error(s, d, p) - s * sum_error(2.0, f, d)) / d
    z = s * s
    z_low = product_error(s, s, z) + 2.0 * s * s_low
    # t = z (1/3 + z T(z)), atanh(s) = s + s t
    tail = z * (
        LOG_TAIL_0
        + z * (LOG_TAIL_1 + z * (LOG_TAIL_2 + z * (LOG_TAIL_3 + z * (LOG_TAIL_4 + z * (LOG_TAIL_5 + z * LOG_TAIL_6)))))
    )
    c = THIRD + tail
    c_low = sum_error(THIRD, tail, c) + THIRD_TAIL
    t = z * c
    t_low = product_error(z, c, t) + (z * c_low + z_low * c)
    u = s * t
    u_low = product_error(s, t, u) + (s * t_low + s_low * t)
    v = s + u
    v_low = sum_error(s, u, v) + (u_low + s_low)
    a = k * LN2_HIGH
    b = 2.0 * v
    h = a + b
    low = sum_error(a, b, h) + (2.0 * v_low + k * LN2_LOW)
    high = h + low
    return high, (h - high) + low


def log2(x: float) -> float:
    """Return the logarithm to base 2."""
    if x <= 0.0 or x - x != 0.0:
        return without_logarithm(x)
    high, low = log_two(x)
    y = high * LOG2_E
    return y + (product_error(high, LOG2_E, y) + (high * LOG2_E_TAIL + low * LOG2_E))


def log10(x: float) -> float:
    """Return the logarithm to base 10."""
    if x <= 0.0 or x - x != 0.0:
        return without_logarithm(x)
    high, low = log_two(x)
    y = high * LOG10_E
    return y + (product_error(high, LOG10_E, y) + (high * LOG10_E_TAIL + low * LOG10_E))
