"""asin, acos, atan, atan2. Kernel functions.

atan uses a series about the nearest of 0, atan(1/2), pi/4, atan(3/2) and pi/2; asin and acos use their series up to
1/2, and for |x| above 1/2 the series of asin(sqrt((1 - |x|)/2)) (Ng, in the freely distributable mathematical library
of Sun Microsystems, 1993). Rounding errors of square roots and quotients are compensated.
"""

import math

from .reduction import HALF_PI, HALF_PI_TAIL, QUARTER_PI
from .two_doubles import product_error, sum_error

PI = 3.141592653589793
PI_TAIL = 1.2246467991473532e-16
QUARTER_PI_TAIL = 3.061616997868383e-17
ATAN_HALF = 0.4636476090008061
ATAN_HALF_TAIL = 2.2698777452961687e-17
ATAN_THREE_HALVES = 0.982793723247329
ATAN_THREE_HALVES_TAIL = 1.3903311031230998e-17
SMALL = 7.450580596923828e-09  # 2^-27, below which asin x = atan x = x
BIG = 1.152921504606847e18  # 2^60, from which atan x = pi/2

ATAN_0 = -0.3333333333333293
ATAN_1 = 0.19999999999876167
ATAN_2 = -0.14285714272480682
ATAN_3 = 0.11111110404606796
ATAN_4 = -0.09090887114337204
ATAN_5 = 0.07691875935261398
ATAN_6 = -0.0666107066201877
ATAN_7 = 0.058335554138185045
ATAN_8 = -0.049768232586864664
ATAN_9 = 0.03653041599865964
ATAN_10 = -0.01628475954783222

ASIN_0 = 0.16666666666665383
ASIN_1 = 0.07500000000343073
ASIN_2 = 0.044642856823470335
ASIN_3 = 0.030381959331479743
ASIN_4 = 0.022371753522250754
ASIN_5 = 0.017359771079424356
ASIN_6 = 0.013884599001325108
ASIN_7 = 0.012173274937491246
ASIN_8 = 0.006510873841960447
ASIN_9 = 0.01957384931995586
ASIN_10 = -0.01629398655443354
ASIN_11 = 0.031958908734616515


def atan_polynomial(t: float) -> float:
    """Return atan(t) - t for |t| <= 7/16."""
    z = t * t
    w = z * z
    odd = w * (ATAN_1 + w * (ATAN_3 + w * (ATAN_5 + w * (ATAN_7 + w * ATAN_9))))
    even = z * (ATAN_0 + w * (ATAN_2 + w * (ATAN_4 + w * (ATAN_6 + w * (ATAN_8 + w * ATAN_10)))))
    return t * (even + odd)


def asin_polynomial(x: float, z: float) -> float:
    """Return asin(x) - x for |x| <= 1/2 and z = x^2."""
    w = z * z
    odd = w * (ASIN_1 + w * (ASIN_3 + w * (ASIN_5 + w * (ASIN_7 + w * (ASIN_9 + w * ASIN_11)))))
    even = z * (ASIN_0 + w * (ASIN_2 + w * (ASIN_4 + w * (ASIN_6 + w * (ASIN_8 + w * ASIN_10)))))
    return x * (even + odd)


def nearest_angle(q: float, tail: float) -> tuple[float, float, float]:
    """Return high, low and t of atan(q + tail) = high + low + atan(t), q >= 0, for the nearest tabulated angle."""
    low = tail / (1.0 + q * q)
    if q < 0.4375:
        return 0.0, low, q
    if q < 0.6875:
        return ATAN_HALF, ATAN_HALF_TAIL + low, (2.0 * q - 1.0) / (2.0 + q)
    if q < 1.1875:
        return QUARTER_PI, QUARTER_PI_TAIL + low, (q - 1.0) / (q + 1.0)
    if q < 2.4375:
        return ATAN_THREE_HALVES, ATAN_THREE_HALVES_TAIL + low, (q - 1.5) / (1.0 + 1.5 * q)
    return HALF_PI, HALF_PI_TAIL + low, -1.0 / q


def atan(x: float) -> float:
    """Return the arc tangent."""
    a = abs(x)
    if a < SMALL or x != x:
        return x
    if a < 0.4375:
        return x + atan_polynomial(x)
    if a > BIG:
        return math.copysign(HALF_PI, x)
    high, low, t = nearest_angle(a, 0.0)
    s = high + t
    return math.copysign(s + (sum_error(high, t, s) + (atan_polynomial(t) + low)), x)


def atan2(y: float, x: float) -> float:
    """Return the angle (rad) of the point (x, y), from -pi to pi."""
    a = abs(y)
    b = abs(x)
    if a != a or b != b:
        return math.nan
    if a == 0.0 or b == 0.0 or a == math.inf or b == math.inf:
        return math.copysign(angle_of_edge(a, b, x), y)
    if a > BIG * b:
        return math.copysign(HALF_PI, y)
    if a < SMALL * b:
        if x > 0.0:
            return math.copysign(a / b, y)
        if a < SMALL * SMALL * b:
            return math.copysign(PI, y)
    if a > 1e150 or b > 1e150:
        a = a * 2.409919865102884e-181  # 2^-600
        b = b * 2.409919865102884e-181
    elif a < 1e-150 or b < 1e-150:
        a = a * 4.149515568880993e180  # 2^600
        b = b * 4.149515568880993e180
    q = a / b
    p = q * b
    high, low, t = nearest_angle(q, ((a - p) - product_error(q, b, p)) / b)
    tail = atan_polynomial(t) + low
    if x < 0.0:
        t = -t
        h = PI - high
        tail = sum_error(PI, -high, h) + (PI_TAIL - tail)
        high = h
    s = high + t
    return math.copysign(s + (sum_error(high, t, s) + tail), y)


def angle_of_edge(a: float, b: float, x: float) -> float:
    """Return the angle of (x, a) with b = |x|, if a or b is 0 or infinite."""
    high = HALF_PI
    if a == b:  # both 0, or both infinite
        high = 0.0 if a == 0.0 else QUARTER_PI
    elif a == 0.0 or b == math.inf:
        high = 0.0
    if math.copysign(1.0, x) < 0.0:
        return PI - high
    return high


def asin(x: float) -> float:
    """Return the arc sine."""
    a = abs(x)
    if not a <= 1.0:
        return math.nan
    if a <= 0.5:
        if a < SMALL:
            return x
        return x + asin_polynomial(x, x * x)
    z = 0.5 * (1.0 - a)
    s = math.sqrt(z)
    h = HALF_PI - 2.0 * s
    low = sum_error(HALF_PI, -2.0 * s, h) + (HALF_PI_TAIL - 2.0 * (root_error(z, s) + asin_polynomial(s, z)))
    return math.copysign(h + low, x)


def acos(x: float) -> float:
    """Return the arc cosine."""
    a = abs(x)
    if not a <= 1.0:
        return math.nan
    if a <= 0.5:
        h = HALF_PI - x
        return h + (sum_error(HALF_PI, -x, h) + (HALF_PI_TAIL - asin_polynomial(x, x * x)))
    z = 0.5 * (1.0 - a)
    s = math.sqrt(z)
    tail = root_error(z, s) + asin_polynomial(s, z)
    if x > 0.0:
        return 2.0 * (s + tail)
    h = PI - 2.0 * s
    return h + (sum_error(PI, -2.0 * s, h) + (PI_TAIL - 2.0 * tail))


def root_error(z: float, s: float) -> float:
    """Return sqrt(z) - s for the double s = sqrt(z)."""
    if s == 0.0:
        return 0.0
    p = s * s
    return ((z - p) - product_error(s, s, p)) / (2.0 * s)
