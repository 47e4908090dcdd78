"""Reduction of angles by multiples of pi/2. Kernel functions.

Angles up to 2^16 are reduced with pi/2 in three parts of 33 bits and a tail (Cody and Waite 1980); larger angles with
as many bits of 2/pi as their exponent requires (Payne and Hanek, "Radian reduction for trigonometric functions", SIGNUM
Newsletter 18, 1983).
"""

import math

from .two_doubles import ROUND, product_error, sum_error

LIMIT = 65536.0
TWO_OVER_PI = 0.6366197723675814
HALF_PI = 1.5707963267948966
HALF_PI_TAIL = 6.123233995736766e-17
QUARTER_PI = 0.7853981633974483
PART_1 = 1.5707963267341256  # first 33 bits of pi/2, so that its product with an integer up to 2^20 is exact
PART_2 = 6.077100506303966e-11
PART_3 = 2.0222662487111665e-21
PART_4 = 8.4784276603689e-32
TAIL_3 = 2.0222662487959506e-21  # PART_3 + PART_4
DIGIT = 16777216.0  # 2^24
DIGITS = 8  # digits of 24 bits in a product: 120 bits remain after 60 that cancel

# 2/pi in digits of 24 bits
TWO_OVER_PI_DIGITS = (
    10680707.0,
    7228996.0,
    1387004.0,
    2578385.0,
    16069853.0,
    12639074.0,
    9804092.0,
    4427841.0,
    16666979.0,
    11263675.0,
    12935607.0,
    2387514.0,
    4345298.0,
    14681673.0,
    3074569.0,
    13734428.0,
    16653803.0,
    1880361.0,
    10960616.0,
    8533493.0,
    3062596.0,
    8710556.0,
    7349940.0,
    6258241.0,
    3772886.0,
    3769171.0,
    3798172.0,
    8675211.0,
    12450088.0,
    3874808.0,
    9961438.0,
    366607.0,
    15675153.0,
    9132554.0,
    7151469.0,
    3571407.0,
    2607881.0,
    12013382.0,
    4155038.0,
    6285869.0,
    7677882.0,
    13102053.0,
    15825725.0,
    473591.0,
    9065106.0,
    15363067.0,
    6271263.0,
    9264392.0,
    5636912.0,
    4652155.0,
)


def reduce_angle(x: float) -> tuple[int, float, float]:
    """Return n, r and tail of x = n pi/2 + r + tail for a finite x: n modulo 4, |r| <= pi/4 apart from rounding."""
    if abs(x) >= LIMIT:
        return reduce_large(x)
    n = x * TWO_OVER_PI + ROUND - ROUND
    a = x - n * PART_1
    b = n * PART_2
    r = a - b
    if abs(r) > 0.001:
        b = ((a - r) - b) - n * TAIL_3
        s = r + b
        return int(n) % 4, s, (r - s) + b
    low = sum_error(a, -b, r)
    c = n * PART_3
    s = r - c
    low = (sum_error(r, -c, s) + low) - n * PART_4
    r = s + low
    return int(n) % 4, r, (s - r) + low


def reduce_large(x: float) -> tuple[int, float, float]:
    """Return the same as `reduce_angle`, by the method for large angles, which applies to any magnitude."""
    z, exponent = math.frexp(abs(x))
    digits = [0.0] * 3
    for i in range(3):
        z = z * DIGIT
        digits[i] = float(math.floor(z))
        z = z - digits[i]
    # product digits from 2^(exponent - 24 (k + 2)) up; multiples of 4 are irrelevant
    first = (exponent - 50) // 24 + 1
    if first < 0:
        first = 0
    product = [0.0] * DIGITS
    for k in range(DIGITS):
        for i in range(3):
            if first + k >= i:
                product[k] = product[k] + digits[i] * TWO_OVER_PI_DIGITS[first + k - i]
    for k in range(DIGITS - 1, 0, -1):
        carry = float(math.floor(product[k] / DIGIT))
        product[k] = product[k] - carry * DIGIT
        product[k - 1] = product[k - 1] + carry
    weight = math.ldexp(1.0, exponent - 24 * (first + 2))
    top = product[0] * weight
    top = top - 4.0 * float(math.floor(top / 4.0))
    n = math.floor(top + product[1] * (weight / DIGIT) + 0.5)
    high = top - float(n)
    low = 0.0
    for k in range(1, DIGITS):
        weight = weight / DIGIT
        term = product[k] * weight
        s = high + term
        low = low + sum_error(high, term, s)
        high = s
    s = high + low
    low = (high - s) + low
    r = s * HALF_PI
    low = product_error(s, HALF_PI, r) + (s * HALF_PI_TAIL + low * HALF_PI)
    if x < 0.0:
        return (4 - n) % 4, -r, -low
    return n % 4, r, low
