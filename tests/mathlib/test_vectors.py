"""Vectors of three components: `perilune.fmus_src.mathlib.vectors` against exact rational arithmetic.

Truth: Python fractions (exact sums of products) and exact cases. Tolerance: 4 rounding errors of the
largest term.
"""

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.mathlib.vectors import clip, copy3, dot, norm

ROUNDING = 2.0**-53
components = st.floats(-1e6, 1e6).filter(lambda value: value == 0.0 or abs(value) > 1e-100)
vectors = st.lists(components, min_size=3, max_size=3)


@given(vectors, vectors)
def test_dot_is_the_exact_sum_rounded(a, b):
    terms = [Fraction(x) * Fraction(y) for x, y in zip(a, b, strict=True)]
    assert abs(Fraction(dot(a, b)) - sum(terms)) <= Fraction(4 * ROUNDING) * sum(abs(term) for term in terms)


@given(vectors)
def test_norm_is_the_exact_root_rounded(a):
    assert norm(a) == pytest.approx(math.hypot(*a), rel=4 * ROUNDING, abs=0.0)


@given(vectors, st.integers(-40, 40))
def test_norm_scales_exactly_by_powers_of_two(a, exponent):
    factor = 2.0**exponent
    assert norm([factor * x for x in a]) == factor * norm(a)


def test_norms_of_whole_numbers():
    assert norm([2.0, 3.0, 6.0]) == 7.0
    assert norm([-1.0, 4.0, -8.0]) == 9.0
    assert norm([0.0, 0.0, 0.0]) == 0.0


@given(vectors)
def test_copy_keeps_the_list_and_takes_the_elements(source):
    target = [1.0, 2.0, 3.0]
    same = target
    copy3(target, source)
    assert same is target
    assert target == source
    assert target is not source


@given(components, components, st.floats(0.0, 1e6))
def test_clip_is_the_nearest_value_between_the_bounds(value, low, width):
    high = low + width
    assert clip(value, low, high) == sorted([low, value, high])[1]
