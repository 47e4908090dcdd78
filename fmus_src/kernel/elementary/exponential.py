"""exp, exp2, expm1. Kernel functions.

x = n ln 2 + r with |r| <= ln 2/2, the product n ln 2 in two parts (Cody and Waite, "Software Manual for the Elementary
Functions", 1980), and exp(r) = 1 + r + r^2/2 + r^3 q(r).
"""

import math

from .two_doubles import ROUND, product_error, sum_error

LOG2_E = 1.4426950408889634
LN2 = 0.6931471805599453
LN2_TAIL = 2.3190468138462996e-17
LN2_HIGH = 0.6931471803691238  # 32 bits: n LN2_HIGH is exact
LN2_LOW = 1.9082149292705877e-10
LN2_HALF = 0.34657359027997264
OVERFLOW = 709.782712893384  # exp of the next double is infinite
UNDERFLOW = -745.1332191019412

EXP_0 = 0.16666666666666685
EXP_1 = 0.04166666666660291
EXP_2 = 0.00833333333331398
EXP_3 = 0.0013888888927216152
EXP_4 = 0.00019841269904777883
EXP_5 = 2.4801508164175888e-05
EXP_6 = 2.7557226214152896e-06
EXP_7 = 2.762538853771267e-07
EXP_8 = 2.511504794193503e-08


def exp_polynomial(r: float, z: float) -> float:
    """Return q(r) = (exp(r) - 1 - r - r^2/2)/r^3 for |r| <= ln 2/2 and z = r^2."""
    return (EXP_0 + r * EXP_1) + z * (
        (EXP_2 + r * EXP_3) + z * ((EXP_4 + r * EXP_5) + z * ((EXP_6 + r * EXP_7) + z * EXP_8))
    )


def scale(y: float, n: float) -> float:
    """Return y 2^n, or infinity on overflow."""
    if n > 1000.0:
        return math.ldexp(y, int(n) - 1) * 2.0
    return math.ldexp(y, int(n))


def expm1_two(r: float, tail: float) -> tuple[float, float]:
    """Return exp(r + tail) - 1 as a sum of two doubles, for |r| <= ln 2/2 and a tail below r's last place."""
    z = r * r
    half = 0.5 * z
    s = r + half
    low = sum_error(r, half, s) + (0.5 * product_error(r, r, z) + (tail + tail * r + r * z * exp_polynomial(r, z)))
    high = s + low
    return high, (s - high) + low


def exp_two(x: float, tail: float) -> tuple[float, float, float]:
    """Return high, low and n of exp(x + tail) = (high + low) 2^n, for |x| below 800."""
    n = x * LOG2_E + ROUND - ROUND
    a = x - n * LN2_HIGH
    b = n * LN2_LOW
    c = a - b
    tail = sum_error(a, -b, c) + tail
    r = c + tail
    high, low = expm1_two(r, (c - r) + tail)
    s = 1.0 + high
    return s, sum_error(1.0, high, s) + low, n


def exp(x: float) -> float:
    """Return e^x."""
    if x > OVERFLOW:
        return math.inf
    if x < UNDERFLOW:
        return 0.0
    if x != x:
        return x
    n = x * LOG2_E + ROUND - ROUND
    a = x - n * LN2_HIGH
    b = n * LN2_LOW
    r = a - b
    z = r * r
    return scale(1.0 + (r + (0.5 * z + (r * z * exp_polynomial(r, z) + ((a - r) - b)))), n)


def exp2(x: float) -> float:
    """Return 2^x."""
    if x >= 1024.0:
        return math.inf
    if x < -1075.0:
        return 0.0
    if x != x:
        return x
    n = x + ROUND - ROUND
    f = x - n
    r = f * LN2
    high, low = expm1_two(r, product_error(f, LN2, r) + f * LN2_TAIL)
    return scale(1.0 + high + low, n)


def expm1(x: float) -> float:
    """Return e^x - 1, without losing digits for small x."""
    if x > OVERFLOW:
        return math.inf
    if x < -38.0:
        return -1.0
    if x != x or abs(x) < 1e-17:
        return x
    if abs(x) <= LN2_HALF:
        small, _ = expm1_two(x, 0.0)
        return small
    high, low, n = exp_two(x, 0.0)
    if n > 60.0:
        return scale(high + low, n)
    h = math.ldexp(high, int(n))
    s = h - 1.0
    return s + (sum_error(h, -1.0, s) + math.ldexp(low, int(n)))
