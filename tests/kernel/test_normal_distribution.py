"""Normal distribution and its inverse, and hypot, which no block calls. Truth: mpmath."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from perilune.fmus_src.kernel.elementary.normal_distribution import normal_distribution, normal_quantile
from perilune.fmus_src.kernel.elementary.roots import hypot
from tests.kernel.test_elementary_errors import error
from tests.support.lengths import generator

COUNT = 2000
LARGEST = 6.0  # units in the last place


def test_the_distribution_is_accurate_into_both_tails() -> None:
    random = generator("normal distribution")
    with mp.workprec(150):
        for _ in range(COUNT):
            x = random.uniform(-37.0, 9.0) if random.random() < 0.5 else random.uniform(-4.0, 4.0)
            assert error(normal_distribution(x), mp.ncdf(x)) < LARGEST, x


def test_the_quantile_is_accurate_into_both_tails() -> None:
    random = generator("normal quantile")
    with mp.workprec(150):
        for _ in range(COUNT):
            p = random.random() if random.random() < 0.5 else 10.0 ** random.uniform(-300.0, -1.0)
            x = exact = mpf(normal_quantile(p))
            for _ in range(2):  # Newton: the start has 15 digits, so the second step has 60
                exact -= (mp.ncdf(exact) - p) / mp.npdf(exact)
            assert error(float(x), exact) < LARGEST, p


def test_ends_and_what_lies_outside() -> None:
    assert [normal_distribution(x) for x in (-math.inf, -40.0, 0.0, 40.0, math.inf)] == [0.0, 0.0, 0.5, 1.0, 1.0]
    assert [normal_quantile(p) for p in (0.0, 0.5, 1.0)] == [-math.inf, 0.0, math.inf]
    assert all(math.isnan(normal_quantile(p)) for p in (-1e-9, 1.0 + 1e-9, math.nan))
    assert math.isnan(normal_distribution(math.nan))


@given(st.floats(1e-12, 0.5))
def test_the_quantile_is_odd_about_one_half(q: float) -> None:
    p = 0.5 - q
    assert normal_quantile(1.0 - p) == -normal_quantile(1.0 - (1.0 - p))


@given(st.floats(), st.floats())
def test_hypot_is_correctly_rounded_but_for_near_ties(x: float, y: float) -> None:
    mine = hypot(x, y)
    if not math.isfinite(x) or not math.isfinite(y):
        assert repr(mine) == repr(math.hypot(x, y))
        return
    with mp.workprec(2300):
        exact = mp.sqrt(mpf(x) ** 2 + mpf(y) ** 2)
        if exact < mpf(1.79e308):
            assert error(mine, exact) <= 0.5001


@pytest.mark.parametrize(("x", "y", "z"), [(3.0, 4.0, 5.0), (-5e-324, 0.0, 5e-324), (1.5e308, 1.5e308, math.inf)])
def test_hypot_of_known_triangles(x: float, y: float, z: float) -> None:
    assert hypot(x, y) == z
