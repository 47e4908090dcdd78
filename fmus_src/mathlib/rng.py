"""Random numbers with independent streams: MRG32k3a, exact in doubles. Kernel functions.

The state of the generator is a list of six floats in the block. Source: L'Ecuyer, "Good parameters and implementations
for combined multiple recursive random number generators", Operations Research 47(1), 1999; streams and jumps: L'Ecuyer,
Simard, Chen and Kelton, "An object-oriented random-number package with many long streams and substreams", 2002. The
constants are taken from the 2002 package: streams are 2^127 numbers apart, substreams 2^76 numbers.
"""

import math

from ..kernel.elementary.two_doubles import ROUND
from ..kernel.functions import cos, log
from .rng_jumps import JUMPS, ROWS
from .vectors import Vector3, vector

M1 = 4294967087.0
M2 = 4294944443.0
NORM = 2.328306549295727688e-10
STREAM = 51  # row of `JUMPS` with the distance of streams, 2^127


def nearest(x: float) -> float:
    """Return the integer nearest to x below 2^51: adding ROUND leaves no bits for the fraction."""
    return x + ROUND - ROUND


def reduce_modulo(high: float, low: float, m: float) -> float:
    """Return (65536 high + low) mod m exactly, as the residue nearest to 0, for integers below 2^52."""
    inverse = 1.0 / m
    v = high - nearest(high * inverse) * m
    v = 65536.0 * v + low
    return v - nearest(v * inverse) * m


def high_words(v: Vector3) -> Vector3:
    """Return v / 65536 rounded to integers; products of the 16-bit remainder with 32-bit numbers are exact."""
    return vector(nearest(v.x / 65536.0), nearest(v.y / 65536.0), nearest(v.z / 65536.0))


def combine(s: Vector3, a: Vector3, b: Vector3, c: Vector3, m: float) -> Vector3:
    """Return (s.x a + s.y b + s.z c) mod m for integers of at most 2^32."""
    words = high_words(s)
    low_words = s - 65536.0 * words
    high = words.x * a + words.y * b + words.z * c
    low = low_words.x * a + low_words.y * b + low_words.z * c
    return vector(
        reduce_modulo(high.x, low.x, m),
        reduce_modulo(high.y, low.y, m),
        reduce_modulo(high.z, low.z, m),
    )


def advance(state: list) -> None:
    """Advance the state by one number."""
    p1 = 1403580.0 * state[1] - 810728.0 * state[0]
    p2 = 527612.0 * state[5] - 1370589.0 * state[3]
    state[0] = state[1]
    state[1] = state[2]
    state[2] = p1 - float(math.floor(p1 / M1)) * M1
    state[3] = state[4]
    state[4] = state[5]
    state[5] = p2 - float(math.floor(p2 / M2)) * M2


def store(state: list, offset: int, v: Vector3, m: float) -> None:
    """Store the residues v, nearest to 0, as residues in [0, m) in state[offset : offset + 3]."""
    state[offset] = v.x + m if v.x < 0.0 else v.x
    state[offset + 1] = v.y + m if v.y < 0.0 else v.y
    state[offset + 2] = v.z + m if v.z < 0.0 else v.z


def jump(state: list, row: int) -> None:
    """Advance the state by 2^(76 + row) numbers with the polynomials of `JUMPS`."""
    a0 = vector(state[0], state[1], state[2])
    b0 = vector(state[3], state[4], state[5])
    advance(state)
    a1 = vector(state[0], state[1], state[2])
    b1 = vector(state[3], state[4], state[5])
    advance(state)
    a2 = vector(state[0], state[1], state[2])
    b2 = vector(state[3], state[4], state[5])
    i = 6 * row
    store(state, 0, combine(vector(JUMPS[i], JUMPS[i + 1], JUMPS[i + 2]), a0, a1, a2, M1), M1)
    store(state, 3, combine(vector(JUMPS[i + 3], JUMPS[i + 4], JUMPS[i + 5]), b0, b1, b2, M2), M2)


def jump_times(state: list, count: int, first: int) -> None:
    """Advance the state by ``count`` times 2^(76 + first) numbers."""
    left = count
    for row in range(first, ROWS):
        if left % 2 == 1:
            jump(state, row)
        left = left // 2


def seed_streams(state: list, seed: int, stream: int) -> None:
    """Set the generator to the start of substream ``stream`` of stream ``seed`` (both >= 0).

    Different pairs (seed, stream) with stream < 2^51 have no numbers in common.
    """
    for i in range(6):
        state[i] = 12345.0
    jump_times(state, seed, STREAM)
    jump_times(state, stream, 0)


def uniform(state: list) -> float:
    """Return the next uniform random number in (0, 1)."""
    advance(state)
    p1 = state[2]
    p2 = state[5]
    if p1 > p2:
        return (p1 - p2) * NORM
    return (p1 - p2 + M1) * NORM


def normal(state: list) -> float:
    """Return the next standard normal random number (Box and Muller 1958, cosine branch; uses two uniform numbers)."""
    radius = uniform(state)
    angle = uniform(state)
    return math.sqrt(-2.0 * log(radius)) * cos(6.283185307179586 * angle)


def normals(state: list) -> Vector3:
    """Return the next three standard normal random numbers."""
    x = normal(state)
    y = normal(state)
    z = normal(state)
    return vector(x, y, z)
