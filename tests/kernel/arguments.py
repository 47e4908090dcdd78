"""Arguments of the elementary functions: spread over exponents, near what is hard, at the edges."""

from __future__ import annotations

import math
from collections.abc import Callable
from random import Random

from mpmath import mp

Draw = Callable[[Random], float]

EDGES = [0.0, 5e-324, 2.2250738585072014e-308, 1e-20, 0.25, 0.5, 1.0 - 2**-53, 1.0, 1.0 + 2**-52, 1.5, 2.0, 3.0]
EDGES += [math.pi / 4, math.pi / 2, math.pi, 22.0, 65536.0, 709.782712893384, 710.4758600739439, 745.2, 1024.0, 1e22]
EDGES += [2.0**52 + 1.0, 2.0**53, 2.0**63, 1.7976931348623157e308, math.inf]
EDGES = [*EDGES, *(-value for value in EDGES), math.nan]


def spread(low: int, high: int, signed: bool = True) -> Draw:
    """Draw every exponent of 2 from ``low`` to ``high`` as often."""

    def draw(random: Random) -> float:
        value = math.ldexp(random.uniform(1.0, 2.0), random.randint(low, high))
        return random.choice((-1.0, 1.0)) * value if signed else value

    return draw


def between(low: float, high: float) -> Draw:
    """Draw uniform values."""
    return lambda random: random.uniform(low, high)


def near_quarter_turns(random: Random) -> float:
    """Draw the double nearest to a multiple of pi/2, to 1e22."""
    with mp.workdps(60):
        return float(random.randint(1, int(10 ** random.uniform(0.0, 22.0))) * mp.pi / 2)


def near_one(random: Random) -> float:
    """Draw numbers about 1."""
    return 1.0 + spread(-52, -2)(random)


ANGLES = (spread(-1074, 1023), spread(-30, 16), between(-10.0, 10.0), near_quarter_turns)
POSITIVE = (spread(-1074, 1023, signed=False), near_one, between(0.3, 3.0))
UNIT = (spread(-1074, -1), between(-1.0, 1.0), lambda random: 1.0 - spread(-50, -1, signed=False)(random))

DRAWS: dict[str, tuple[tuple[Draw, ...], ...]] = {
    "sin": (ANGLES,),
    "cos": (ANGLES,),
    "tan": (ANGLES,),
    "asin": (UNIT,),
    "acos": (UNIT,),
    "atan": ((spread(-1074, 1023), spread(-30, 30), between(-3.0, 3.0)),),
    "atan2": ((spread(-1000, 1000), between(-3.0, 3.0)), (spread(-1000, 1000), between(-3.0, 3.0))),
    "exp": ((spread(-1074, 9), between(-745.0, 709.7), between(-2.0, 2.0), between(-745.0, -708.0)),),
    "exp2": ((spread(-1074, 9), between(-1074.0, 1023.0), between(-2.0, 2.0)),),
    "expm1": ((spread(-1074, 9), between(-3.0, 3.0), between(-40.0, 80.0)),),
    "log": (POSITIVE,),
    "log2": (POSITIVE,),
    "log10": (POSITIVE,),
    "log1p": ((spread(-1074, 1023, signed=False), spread(-1074, -1), between(-0.99, 3.0), between(-0.5, 0.6)),),
    "pow": (POSITIVE, (between(-1.0, 1.0), between(-20.0, 20.0), spread(-30, 45))),
    "sinh": ((spread(-1074, 9), between(-3.0, 3.0), between(-30.0, 30.0), between(700.0, 710.4)),),
    "cosh": ((spread(-1074, 9), between(-3.0, 3.0), between(-30.0, 30.0)),),
    "tanh": ((spread(-1074, 5), between(-3.0, 3.0)),),
    "cbrt": ((spread(-1074, 1023), between(-3.0, 3.0)),),
}


def samples(name: str, count: int, random: Random) -> list[tuple[float, ...]]:
    """Draw ``count`` tuples of arguments for a function."""
    kinds = DRAWS[name]
    return [tuple(random.choice(draws)(random) for draws in kinds) for _ in range(count)]


def edges(name: str) -> list[tuple[float, ...]]:
    """Return every edge, of two arguments every pair."""
    if len(DRAWS[name]) == 1:
        return [(value,) for value in EDGES]
    return [(x, y) for x in EDGES for y in EDGES]
