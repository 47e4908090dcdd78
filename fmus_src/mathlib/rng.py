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


def multiply_modulo(a: float, s: float, c: float, m: float) -> float:
    """(a s + c) mod m for integers below 2^34 held in doubles, without losing a bit."""
    v = a * s + c
    if abs(v) >= 4503599627370496.0:
        high = nearest(a / 131072.0)
        rest = a - high * 131072.0
        v = high * s
        v = v - nearest(v / m) * m
        v = v * 131072.0 + rest * s + c
    v = v - nearest(v / m) * m
    if v < 0.0:
        v = v + m
    return v


def square(power: list, cube: list, m: float) -> None:
    """power^2 mod m, of a polynomial of degree two in a matrix, with its ``cube`` as in `jump`."""
    p0 = power[0]
    p1 = power[1]
    p2 = power[2]
    d0 = multiply_modulo(p0, p0, 0.0, m)
    d1 = multiply_modulo(2.0 * p0, p1, 0.0, m)
    d2 = multiply_modulo(2.0 * p0, p2, multiply_modulo(p1, p1, 0.0, m), m)
    d3 = multiply_modulo(2.0 * p1, p2, 0.0, m)
    d4 = multiply_modulo(p2, p2, 0.0, m)
    d1 = multiply_modulo(d4, cube[0], d1, m)
    d2 = multiply_modulo(d4, cube[1], d2, m)
    d3 = multiply_modulo(d4, cube[2], d3, m)
    power[0] = multiply_modulo(d3, cube[0], d0, m)
    power[1] = multiply_modulo(d3, cube[1], d1, m)
    power[2] = multiply_modulo(d3, cube[2], d2, m)


def transform(state: list, offset: int, a: Matrix, image: list, m: float) -> None:
    """image = a state[offset : offset + 3] mod m, for a 3 x 3 matrix."""
    for i in range(3):
        v = 0.0
        for k in range(3):
            v = multiply_modulo(a[i, k], state[offset + k], v, m)
        image[i] = v


def jump(state: list, offset: int, a: Matrix, cube: list, count: int, m: float) -> None:
    """state[offset : offset + 3] = a^count state mod m, by repeated squaring from the first bit of count on.

    ``cube`` is t0, t1, t2 of a^3 = t0 + t1 a + t2 a^2 (Cayley and Hamilton), by which every power
    is a polynomial of degree two in it: squaring that takes 12 products, squaring the matrix 27 (for generators over
    bits: Haramoto, Matsumoto, Nishimura, Panneton and L'Ecuyer, INFORMS Journal on Computing 20(3), 2008).
    """
    if count > 0:
        bit = 1
        while bit <= count // 2:
            bit = 2 * bit
        power = [0.0, 1.0, 0.0]
        while bit > 1:
            bit = bit // 2
            square(power, cube, m)
            if count // bit % 2 == 1:
                last = power[2]
                power[2] = multiply_modulo(last, cube[2], power[1], m)
                power[1] = multiply_modulo(last, cube[1], power[0], m)
                power[0] = multiply_modulo(last, cube[0], 0.0, m)
        once = [0.0] * 3
        twice = [0.0] * 3
        transform(state, offset, a, once, m)
        transform(once, 0, a, twice, m)
        for i in range(3):
            v = multiply_modulo(power[0], state[offset + i], 0.0, m)
            v = multiply_modulo(power[1], once[i], v, m)
            state[offset + i] = multiply_modulo(power[2], twice[i], v, m)


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
    a1_cube = [2714382928.0, 888045435.0, 593970419.0]
    a2_cube = [117492272.0, 4204460113.0, 727712726.0]
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
    b1_cube = [179953957.0, 1238372185.0, 221148705.0]
    b2_cube = [1350139077.0, 1707256826.0, 2436175045.0]
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
