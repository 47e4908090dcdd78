"""Ticks of axes with arbitrary limits: a few round numbers within the limits, computed in bounded time.

Truth: integers and powers of ten, in exact arithmetic.
"""

import itertools
from decimal import Decimal
from fractions import Fraction
from random import Random

import pytest

from tests.support.pages.node import call

ENDS = 10_000
SEED = 58
FITTING = 6  # ticks that fit
# Where steps that are added never end: an axis that begins a little below a power of ten.
FREEZING = [(0.95 * 10.0**power, 30.0 * 10.0**power) for power in range(-12, 1)]
DIGITS = {"1", "2", "25", "3", "4", "5", "6", "7", "8", "9"}  # of a step, and of a tick of a logarithmic axis


def zoomed(random, low, high, *, logarithmic):
    """Draw the ends of a zoom or a pan, of a range that is many times smaller or as large."""
    if logarithmic:
        ratio = (high / low) ** random.choice([1.0, random.random(), 1e-3 * random.random(), 1e-9])
        at = low * (high / low) ** random.random()
        return at, at * ratio
    width = (high - low) * 10.0 ** -random.choice([0.0, random.uniform(0.0, 4.0), random.uniform(0.0, 15.0)])
    at = low + random.random() * (high - low)
    return at, at + width


def logarithmic_ends():
    random = Random(SEED)
    ends = [*FREEZING, (0.0, 1.0), (-1.0, 1.0), (1.0, 1.0), (1e-300, 1e300), (5e-324, 1e-300)]
    while len(ends) < ENDS:
        low = random.choice([random.uniform(0.94, 1.0), random.uniform(1.0, 10.0)]) * 10.0 ** random.randint(-12, 9)
        high = low * 10.0 ** random.uniform(0.01, 12.0)
        ends += [(low, high), zoomed(random, low, high, logarithmic=True)]
    return ends


def linear_ends():
    random = Random(SEED)
    ends = [
        (0.0, 0.0),
        (1.0, 0.0),
        (1e6, 1e6 + 1e-10),
        (1e308, -1e308),
        (-1e308, 1e308),
        (0.0, 5e-324),
        (1e9, 1e9 + 3e-7),
    ]
    while len(ends) < ENDS:
        low = random.choice([0.0, random.uniform(-1.0, 1.0) * 10.0 ** random.randint(-9, 9)])
        high = low + 10.0 ** random.uniform(-9.0, 9.0)
        ends += [(low, high), zoomed(random, low, high, logarithmic=False)]
    return ends


@pytest.mark.parametrize(("name", "ends"), [("linearSplits", linear_ends()), ("logarithmicSplits", logarithmic_ends())])
def test_any_ends_have_a_few_ticks(name, ends):
    for (low, high), ticks in zip(
        ends, call("chart/splits.ts", name, [[*each, FITTING] for each in ends]), strict=True
    ):
        slack = 1e-8 * (high - low)
        assert len(ticks) <= 4 * FITTING, (low, high)
        assert all(low - slack <= at <= high + slack for at in ticks), (low, high)
        assert all(one < other for one, other in itertools.pairwise(ticks)), (low, high)


def test_what_is_seen_has_ticks():
    """A logarithmic axis of at least half a decade, a linear one of any that floating-point numbers tell apart."""
    for name, ends in (("linearSplits", linear_ends()), ("logarithmicSplits", logarithmic_ends())):
        wide = [
            (low, high) for low, high in ends
            if high > low > 0.0 and high / low > 1.0 + 1e-9 and high < 1e300 and low > 1e-300
        ]  # fmt: skip
        for (low, high), ticks in zip(
            wide, call("chart/splits.ts", name, [[*each, FITTING] for each in wide]), strict=True
        ):
            assert len(ticks) >= 2, (name, low, high)


def test_logarithmic_ticks_are_whole_multiples_of_powers_of_ten():
    ends = [(low, high) for low, high in logarithmic_ends() if low > 0.0 and high > 30.0 * low]
    for ticks in call("chart/splits.ts", "logarithmicSplits", [[*each, FITTING] for each in ends]):
        for at in ticks:
            digits = "".join(map(str, Decimal(repr(at)).normalize().as_tuple().digits))
            assert digits in DIGITS, at


def test_linear_ticks_are_evenly_spaced():
    ends = [(low, high) for low, high in linear_ends() if high - low > 1e-6 * max(abs(low), abs(high))]
    for ticks in call("chart/splits.ts", "linearSplits", [[*each, FITTING] for each in ends]):
        steps = [Fraction(other) - Fraction(one) for one, other in itertools.pairwise(ticks)]
        for step in steps:
            assert abs(step / steps[0] - 1) < Fraction(1, 10**6)
