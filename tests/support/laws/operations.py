"""Operations of network operators by numpy, and the value of a node from the values of its predecessors.

Saturation as in docs/systems/lunar_descent_2d.md: powers and products at +-1e8, exp if it exceeds 1e8.
"""

from functools import cache

import numpy as np

LARGE = 1e8
NEUTRAL = {0: 0.0, 1: 1.0, 2: -LARGE, 3: LARGE}


def sign(z):
    """Return the sign, +1 at 0."""
    return 1.0 if z >= 0 else -1.0


# The published formulas where they hold, that is without saturation.
FORMULAS = {
    1: lambda z: z,
    2: lambda z: z**2,
    3: lambda z: -z,
    4: lambda z: sign(z) * np.sqrt(np.abs(z)),
    5: lambda z: 1 / z,
    6: np.exp,
    7: lambda z: np.log(np.abs(z)),
    8: lambda z: (1 - np.exp(-z)) / (1 + np.exp(-z)),
    9: lambda z: float(z >= 0),
    10: sign,
    11: np.cos,
    12: np.sin,
    13: np.arctan,
    14: lambda z: z**3,
    15: lambda z: sign(z) * np.abs(z) ** (1 / 3),
    16: lambda z: max(-1.0, min(1.0, z)),
    17: lambda z: sign(z) * np.log(np.abs(z) + 1),
    18: lambda z: sign(z) * (np.exp(np.abs(z)) - 1),
    19: lambda z: sign(z) * np.exp(-np.abs(z)),
    20: lambda z: z / 2,
    21: lambda z: 2 * z,
    23: lambda z: z - z**3,
}


def saturated(operation, z):
    """Apply a unary operation to any z, exp saturating at 1e8."""
    if operation in (5, 7):
        z = np.copysign(max(abs(z), 1 / LARGE), z)
    if operation == 8:
        z = max(z, -700.0)  # where exp(-z) is finite
    with np.errstate(over="ignore"):
        value = float(FORMULAS[operation](np.float64(z)))
    return value if operation == 1 else max(-LARGE, min(LARGE, value))


def backwards(matrix, sources, unary=saturated):
    """Return a function from a node, from 0, to its value: from its predecessors' values, recursively."""

    @cache
    def value_of(node):
        if node < len(sources):
            return sources[node]
        kind = matrix[node][node]
        value = NEUTRAL[kind]
        for before in range(node):
            if matrix[before][node]:
                term = unary(int(matrix[before][node]), value_of(before))
                value = {
                    0: value + term,
                    1: max(-LARGE, min(LARGE, value * term)),
                    2: max(value, term),
                    3: min(value, term),
                }[kind]
        return value

    return value_of
