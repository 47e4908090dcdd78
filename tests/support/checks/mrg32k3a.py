"""MRG32k3a in exact integers, with normal numbers by mpmath.

Recurrences: L'Ecuyer 1999. Streams and substreams, 2^127 and 2^76 numbers apart: L'Ecuyer, Simard, Chen and
Kelton 2002. Normal numbers: Box and Muller 1958, cosine of the second number.
"""

import mpmath
import numpy as np

P1 = 2**32 - 209
P2 = 2**32 - 22853
STEP1 = [[0, 1, 0], [0, 0, 1], [-810728, 1403580, 0]]
STEP2 = [[0, 1, 0], [0, 0, 1], [-1370589, 0, 527612]]


def product(a, b, modulus):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) % modulus for j in range(3)] for i in range(3)]


def power(matrix, exponent, modulus):
    result = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    while exponent:
        if exponent & 1:
            result = product(result, matrix, modulus)
        matrix = product(matrix, matrix, modulus)
        exponent >>= 1
    return result


def advanced(state, steps):
    """Return the exact state ``steps`` numbers later."""
    one = power(STEP1, steps, P1)
    two = power(STEP2, steps, P2)
    return [sum(one[i][k] * state[k] for k in range(3)) % P1 for i in range(3)] + [
        sum(two[i][k] * state[3 + k] for k in range(3)) % P2 for i in range(3)
    ]


def exact_numerator(state):
    """Advance an exact state in place; the number drawn is the result over 2^32 - 208."""
    p1 = (1403580 * state[1] - 810728 * state[0]) % P1
    p2 = (527612 * state[5] - 1370589 * state[3]) % P2
    state[:] = [state[1], state[2], p1, state[4], state[5], p2]
    return p1 - p2 if p1 > p2 else p1 - p2 + P1


class Numbers:
    """The random numbers of a seed and a stream: arrays of any shape, in the order of drawing."""

    def __init__(self, seed, stream):
        self.state = advanced([12345] * 6, seed * 2**127 + stream * 2**76)

    def uniform(self, *shape):
        """Draw numbers in (0, 1)."""
        return np.array([exact_numerator(self.state) / (P1 + 1) for _ in range(int(np.prod(shape)))]).reshape(shape)

    def normal(self, *shape):
        """Draw numbers of mean 0 and variance 1."""
        pairs = self.uniform(int(np.prod(shape)), 2)
        numbers = [mpmath.sqrt(-2 * mpmath.log(radius)) * mpmath.cospi(2 * angle) for radius, angle in pairs]
        return np.array(numbers, dtype=float).reshape(shape)
