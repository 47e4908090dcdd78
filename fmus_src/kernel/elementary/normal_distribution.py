"""Standard normal distribution and its inverse. Kernel functions.

The distribution is exp(-z^2) times a polynomial in (z - 3.75)/(z + 3.75), z = x/sqrt(2) (Shepherd and Laframboise,
"Chebyshev approximation of (1 + 2 x) exp(x^2) erfc x in 0 <= x < inf", Mathematics of Computation 36, 1981); the
inverse uses the quotients of Wichura, "Algorithm AS 241: the percentage points of the normal distribution", Applied
Statistics 37, 1988. Errors are below four units in the last place.
"""

import math

from .exponential import exp
from .logarithm import log
from .two_doubles import product_error

ROOT_HALF = 0.7071067811865476
CENTRE = 3.75
END = 39.0  # the distribution function at -END is below the smallest double

TAIL_0 = 1.2375126308378275
TAIL_1 = -0.140240598585547
TAIL_2 = 0.003585415485462982
TAIL_3 = 0.08227673849014869
TAIL_4 = -0.10880393014166267
TAIL_5 = 0.09230432116029601
TAIL_6 = -0.05869339859164549
TAIL_7 = 0.028362277419530166
TAIL_8 = -0.009746579533912112
TAIL_9 = 0.0017556258555894745
TAIL_10 = 0.00029371349605502705
TAIL_11 = -0.0002901541474661017
TAIL_12 = 5.164984235308634e-05
TAIL_13 = 2.2384702613602283e-05
TAIL_14 = -1.1446226824948406e-05
TAIL_15 = -9.752925181659896e-07
TAIL_16 = 1.7552953913738198e-06
TAIL_17 = -5.333923100674541e-08
TAIL_18 = -2.624033315299168e-07
TAIL_19 = 1.805557901209375e-08
TAIL_20 = 4.032966404489239e-08
TAIL_21 = 1.3218311811302617e-10
TAIL_22 = -4.859148263203856e-09
TAIL_23 = -9.20948716225107e-10


def scaled_complement(t: float) -> float:
    """Return (1 + 2 z) exp(z^2) erfc(z) for t = (z - CENTRE)/(z + CENTRE)."""
    u = t * t * t * t
    c0 = TAIL_0 + t * (TAIL_1 + t * (TAIL_2 + t * TAIL_3))
    c1 = TAIL_4 + t * (TAIL_5 + t * (TAIL_6 + t * TAIL_7))
    c2 = TAIL_8 + t * (TAIL_9 + t * (TAIL_10 + t * TAIL_11))
    c3 = TAIL_12 + t * (TAIL_13 + t * (TAIL_14 + t * TAIL_15))
    c4 = TAIL_16 + t * (TAIL_17 + t * (TAIL_18 + t * TAIL_19))
    c5 = TAIL_20 + t * (TAIL_21 + t * (TAIL_22 + t * TAIL_23))
    return c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5))))


def normal_distribution(x: float) -> float:
    """Return the probability that a standard normal variable is below x."""
    if x != x:
        return x
    a = abs(x)
    tail = 0.0
    if a < END:
        z = a * ROOT_HALF
        square = 0.5 * (a * a)
        lost = 0.5 * product_error(a, a, a * a)
        complement = scaled_complement((z - CENTRE) / (z + CENTRE)) / (1.0 + 2.0 * z)
        tail = 0.5 * complement * (1.0 - lost) * exp(-square)
    if x > 0.0:
        return 1.0 - tail
    return tail


def normal_quantile(p: float) -> float:
    """Return the x below which a standard normal variable lies with probability p.

    The result is infinite for p = 0 and p = 1, and NaN for p outside [0, 1].
    """
    if p != p or p < 0.0 or p > 1.0:
        return math.nan
    if p == 0.0 or p == 1.0:
        return math.copysign(math.inf, p - 0.5)
    q = p - 0.5
    if abs(q) <= 0.425:
        return q * central_quantile(0.180625 - q * q)
    tail = p
    if 1.0 - p < p:
        tail = 1.0 - p
    r = math.sqrt(-log(tail))
    if r <= 5.0:
        return math.copysign(tail_quantile(r - 1.6), q)
    return math.copysign(far_quantile(r - 5.0), q)


def central_quantile(r: float) -> float:
    """Return x/q for q = p - 1/2 and r = 0.425^2 - q^2."""
    r4 = r * r * r * r
    n0 = 3.3871328727963665 + r * (133.14166789178438 + r * (1971.5909503065513 + r * 13731.69376550946))
    n1 = 45921.95393154987 + r * (67265.7709270087 + r * (33430.57558358813 + r * 2509.0809287301227))
    d0 = 1.0 + r * (42.31333070160091 + r * (687.1870074920579 + r * 5394.196021424751))
    d1 = 21213.794301586597 + r * (39307.89580009271 + r * (28729.085735721943 + r * 5226.495278852854))
    return (n0 + r4 * n1) / (d0 + r4 * d1)


def tail_quantile(r: float) -> float:
    """Return |x| for r = sqrt(-ln p) - 1.6 up to 3.4."""
    r4 = r * r * r * r
    n0 = 1.4234371107496835 + r * (4.630337846156546 + r * (5.769497221460691 + r * 3.6478483247632045))
    n1 = 1.2704582524523684 + r * (0.2417807251774506 + r * (0.022723844989269184 + r * 0.0007745450142783414))
    d0 = 1.0 + r * (2.053191626637759 + r * (1.6763848301838038 + r * 0.6897673349851))
    d1 = 0.14810397642748008 + r * (0.015198666563616457 + r * (0.0005475938084995345 + r * 1.0507500716444169e-09))
    return (n0 + r4 * n1) / (d0 + r4 * d1)


def far_quantile(r: float) -> float:
    """Return |x| for r = sqrt(-ln p) - 5."""
    r4 = r * r * r * r
    n0 = 6.657904643501103 + r * (5.463784911164114 + r * (1.7848265399172913 + r * 0.29656057182850487))
    n1 = 0.026532189526576124 + r * (0.0012426609473880784 + r * (2.7115555687434876e-05 + r * 2.0103343992922881e-07))
    d0 = 1.0 + r * (0.599832206555888 + r * (0.1369298809227358 + r * 0.014875361290850615))
    d1 = 0.0007868691311456133 + r * (1.8463183175100548e-05 + r * (1.421511758316446e-07 + r * 2.0442631033899397e-15))
    return (n0 + r4 * n1) / (d0 + r4 * d1)
