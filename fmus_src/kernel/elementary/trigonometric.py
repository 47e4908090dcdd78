"""sin, cos, tan. Kernel functions.

The functions are polynomials on |r| <= pi/4 that include the tail of the reduced angle (Ng, in the freely distributable
mathematical library of Sun Microsystems, 1993).
"""

import math

from .reduction import QUARTER_PI, reduce_angle
from .two_doubles import product_error, sum_error

SMALL = 1.4901161193847656e-08  # 2^-26, below which sin x = tan x = x

SIN_0 = -0.16666666666666632
SIN_1 = 0.008333333333322425
SIN_2 = -0.0001984126982981753
SIN_3 = 2.75573136954211e-06
SIN_4 = -2.505075868247664e-08
SIN_5 = 1.589682955826977e-10

COS_0 = 0.0416666666666666
COS_1 = -0.001388888888887414
COS_2 = 2.480158728949281e-05
COS_3 = -2.7557314355514115e-07
COS_4 = 2.0875723720580813e-09
COS_5 = -1.135967171215903e-11


def sin_reduced(r: float, tail: float) -> float:
    """Return sin(r + tail) for |r| <= pi/4."""
    z = r * r
    v = z * r
    w = z * z
    p = (SIN_1 + z * SIN_2) + w * ((SIN_3 + z * SIN_4) + w * SIN_5)
    return r + (v * SIN_0 + (z * (v * p - 0.5 * tail) + tail))


def cos_reduced(r: float, tail: float) -> float:
    """Return cos(r + tail) for |r| <= pi/4."""
    z = r * r
    w = z * z
    half = 0.5 * z
    s = 1.0 - half
    p = (COS_0 + z * COS_1) + w * ((COS_2 + z * COS_3) + w * (COS_4 + z * COS_5))
    return s + (((1.0 - s) - half) + (w * p - r * tail))


def sin(x: float) -> float:
    """Return the sine."""
    if abs(x) <= QUARTER_PI:
        if abs(x) < SMALL:
            return x
        return sin_reduced(x, 0.0)
    if x - x != 0.0:
        return math.nan
    n, r, tail = reduce_angle(x)
    if n == 0:
        return sin_reduced(r, tail)
    if n == 1:
        return cos_reduced(r, tail)
    if n == 2:
        return -sin_reduced(r, tail)
    return -cos_reduced(r, tail)


def cos(x: float) -> float:
    """Return the cosine."""
    if abs(x) <= QUARTER_PI:
        return cos_reduced(x, 0.0)
    if x - x != 0.0:
        return math.nan
    n, r, tail = reduce_angle(x)
    if n == 0:
        return cos_reduced(r, tail)
    if n == 1:
        return -sin_reduced(r, tail)
    if n == 2:
        return -cos_reduced(r, tail)
    return sin_reduced(r, tail)


def tan(x: float) -> float:
    """Return the tangent: the quotient of sine and cosine, each in two doubles."""
    if abs(x) < SMALL:
        return x
    if x - x != 0.0:
        return math.nan
    n = 0
    r = x
    tail = 0.0
    if abs(x) > QUARTER_PI:
        n, r, tail = reduce_angle(x)
    z = r * r
    z_tail = product_error(r, r, z)
    w = z * z
    p = z * ((SIN_1 + z * SIN_2) + w * ((SIN_3 + z * SIN_4) + w * SIN_5))
    q = SIN_0 + p
    t = r * z
    u = t * q
    s = r + u
    s_tail = sum_error(r, u, s) + (
        product_error(t, q, u)
        + t * sum_error(SIN_0, p, q)
        + (product_error(r, z, t) + r * z_tail) * q
        + tail * (1.0 - 0.5 * z)
    )
    half = 0.5 * z
    a = 1.0 - half
    b = w * ((COS_0 + z * COS_1) + w * ((COS_2 + z * COS_3) + w * (COS_4 + z * COS_5)))
    c = a + b
    c_tail = sum_error(a, b, c) + (((1.0 - a) - half) - 0.5 * z_tail - s * tail)
    if n % 2 == 0:
        return quotient(s, s_tail, c, c_tail)
    return -quotient(c, c_tail, s, s_tail)


def quotient(a: float, a_tail: float, b: float, b_tail: float) -> float:
    """Return (a + a_tail)/(b + b_tail)."""
    q = a / b
    p = q * b
    return q + (((a - p) - product_error(q, b, p)) + (a_tail - q * b_tail)) / b
