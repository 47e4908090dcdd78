"""Random numbers with independent streams: MRG32k3a, exact in doubles. Kernel functions.

The generator's state is a list of six floats held by the block. Source: L'Ecuyer, "Good
parameters and implementations for combined multiple recursive random number generators",
Operations Research 47(1), 1999; streams and jumps: L'Ecuyer, Simard, Chen and Kelton, "An
object-oriented random-number package with many long streams and substreams", 2002. Constants
are those of the 2002 package: streams 2^127 apart, substreams 2^76.
"""

import math

from ..kernel.elementary.two_doubles import ROUND
from ..kernel.functions import cos, log
from ..kernel.matrices import Matrix, matrix
from .vectors import Vector3, vector

M1 = 4294967087.0
M2 = 4294944443.0
NORM = 2.328306549295727688e-10


def nearest(x: float) -> float:
    """The nearest whole number, for x below 2^51: ROUND leaves no place for what lies behind the point."""
    return x + ROUND - ROUND


def reduce_modulo(high: float, low: float, m: float) -> float:
    """(65536 high + low) mod m, the residue nearest to 0, for whole numbers below 2^52, without losing a bit."""
    inverse = 1.0 / m
    v = high - nearest(high * inverse) * m
    v = 65536.0 * v + low
    return v - nearest(v * inverse) * m


def high_words(v: Vector3) -> Vector3:
    """v / 65536 in whole numbers. What is left of v has 16 bits: products of it with numbers of 32 bits are exact."""
    return vector(nearest(v.x / 65536.0), nearest(v.y / 65536.0), nearest(v.z / 65536.0))


def combine(s: Vector3, a: Vector3, b: Vector3, c: Vector3, m: float) -> Vector3:
    """(s.x a + s.y b + s.z c) mod m, for whole numbers of at most 2^32."""
    words = high_words(s)
    low_words = s - 65536.0 * words
    high = words.x * a + words.y * b + words.z * c
    low = low_words.x * a + low_words.y * b + low_words.z * c
    return vector(
        reduce_modulo(high.x, low.x, m),
        reduce_modulo(high.y, low.y, m),
        reduce_modulo(high.z, low.z, m),
    )


def square(p: Vector3, cube: Vector3, fourth: Vector3, m: float) -> Vector3:
    """p^2 mod m, of a polynomial of degree two in a matrix, with its powers as in `jump`."""
    high = high_words(p)
    low = p - 65536.0 * high
    d0 = reduce_modulo(p.x * high.x, p.x * low.x, m)
    d1 = reduce_modulo(2.0 * p.x * high.y, 2.0 * p.x * low.y, m)
    d2 = reduce_modulo(2.0 * p.x * high.z + p.y * high.y, 2.0 * p.x * low.z + p.y * low.y, m)
    d3 = reduce_modulo(2.0 * p.y * high.z, 2.0 * p.y * low.z, m)
    d4 = reduce_modulo(p.z * high.z, p.z * low.z, m)
    return combine(vector(1.0, d3, d4), vector(d0, d1, d2), cube, fourth, m)


def times_matrix(p: Vector3, cube: Vector3, m: float) -> Vector3:
    """p a mod m, of a polynomial of degree two in a matrix a."""
    return combine(vector(1.0, p.z, 0.0), vector(0.0, p.x, p.y), cube, cube, m)


def transform(a: Matrix, v: Vector3, m: float) -> Vector3:
    """a v mod m, for a 3 x 3 matrix."""
    return combine(
        v,
        vector(a[0, 0], a[1, 0], a[2, 0]),
        vector(a[0, 1], a[1, 1], a[2, 1]),
        vector(a[0, 2], a[1, 2], a[2, 2]),
        m,
    )


def jump(state: list, offset: int, a: Matrix, cube: Vector3, count: int, m: float) -> None:
    """state[offset : offset + 3] = a^count state mod m, by repeated squaring from the first bit of count on.

    ``cube`` is t in a^3 = t.x + t.y a + t.z a^2 (Cayley and Hamilton), by which every power
    is a polynomial of degree two in a: squaring that takes 12 products, squaring the matrix 27 (for generators over
    bits: Haramoto, Matsumoto, Nishimura, Panneton and L'Ecuyer, INFORMS Journal on Computing 20(3), 2008).
    """
    if count > 0:
        fourth = times_matrix(cube, cube, m)
        bit = 1
        while bit <= count // 2:
            bit = 2 * bit
        left = count - bit
        power = vector(0.0, 1.0, 0.0)
        while bit > 1:
            bit = bit // 2
            power = square(power, cube, fourth, m)
            if left >= bit:
                left = left - bit
                power = times_matrix(power, cube, m)
        v = vector(state[offset], state[offset + 1], state[offset + 2])
        once = transform(a, v, m)
        v = combine(power, v, once, transform(a, once, m), m)
        state[offset] = v.x + m if v.x < 0.0 else v.x
        state[offset + 1] = v.y + m if v.y < 0.0 else v.y
        state[offset + 2] = v.z + m if v.z < 0.0 else v.z


def seed_streams(state: list, seed: int, stream: int) -> None:
    """Put the generator at stream number ``seed``, substream number ``stream`` (both >= 0).

    Pairs (seed, stream) with stream < 2^51 never share a number.
    """
    for i in range(6):
        state[i] = 12345.0
    # A1^(2^127), A2^(2^127): one stream
    a1 = matrix(
        [2427906178.0, 3580155704.0, 949770784.0],
        [226153695.0, 1230515664.0, 3580155704.0],
        [1988835001.0, 986791581.0, 1230515664.0],
    )
    a2 = matrix(
        [1464411153.0, 277697599.0, 1610723613.0],
        [32183930.0, 1464411153.0, 1022607788.0],
        [2824425944.0, 32183930.0, 2093834863.0],
    )
    a1_cube = vector(2714382928.0, 888045435.0, 593970419.0)
    a2_cube = vector(117492272.0, 4204460113.0, 727712726.0)
    jump(state, 0, a1, a1_cube, seed, M1)
    jump(state, 3, a2, a2_cube, seed, M2)
    # A1^(2^76), A2^(2^76): one substream
    b1 = matrix(
        [82758667.0, 1871391091.0, 4127413238.0],
        [3672831523.0, 69195019.0, 1871391091.0],
        [3672091415.0, 3528743235.0, 69195019.0],
    )
    b2 = matrix(
        [1511326704.0, 3759209742.0, 1610795712.0],
        [4292754251.0, 1511326704.0, 3889917532.0],
        [3859662829.0, 4292754251.0, 3708466080.0],
    )
    b1_cube = vector(179953957.0, 1238372185.0, 221148705.0)
    b2_cube = vector(1350139077.0, 1707256826.0, 2436175045.0)
    jump(state, 0, b1, b1_cube, stream, M1)
    jump(state, 3, b2, b2_cube, stream, M2)


def uniform(state: list) -> float:
    """The next number, in (0, 1)."""
    p1 = 1403580.0 * state[1] - 810728.0 * state[0]
    p1 = p1 - float(math.floor(p1 / M1)) * M1
    state[0] = state[1]
    state[1] = state[2]
    state[2] = p1
    p2 = 527612.0 * state[5] - 1370589.0 * state[3]
    p2 = p2 - float(math.floor(p2 / M2)) * M2
    state[3] = state[4]
    state[4] = state[5]
    state[5] = p2
    if p1 > p2:
        return (p1 - p2) * NORM
    return (p1 - p2 + M1) * NORM


def normal(state: list) -> float:
    """The next standard normal number (Box and Muller 1958, cosine branch; uses two uniform ones)."""
    radius = uniform(state)
    angle = uniform(state)
    return math.sqrt(-2.0 * log(radius)) * cos(6.283185307179586 * angle)


def normals(state: list) -> Vector3:
    """The next three standard normal numbers."""
    x = normal(state)
    y = normal(state)
    z = normal(state)
    return vector(x, y, z)
