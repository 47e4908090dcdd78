"""`perilune.fmus_src.mathlib.polynomial`: roots. Truth: polynomials of chosen roots, and `numpy.roots`.

Tolerance: 1e-12 relative for well-separated chosen roots, 1e-9 for roots found by numpy.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.polynomial import Polynomial

from perilune.fmus_src.mathlib.polynomial import (
    LARGEST,
    evaluate,
    first_crossing,
    positive_roots,
    quadratic_roots,
    root_between,
)

numbers = st.integers(-1000, 1000).filter(lambda number: number != 0).map(float)
scales = st.sampled_from([1e-9, 1e-3, 1.0, 1e3, 1e9])


def five(polynomial):
    return [float(value) for value in polynomial.coef] + [0.0] * (5 - len(polynomial.coef))


def found_roots(polynomial):
    """Find roots by positive_roots, with the turning points by numpy."""
    turning = sorted(root.real for root in polynomial.deriv().roots() if abs(root.imag) < 1e-9 * abs(root))
    roots = [0.0] * 4
    count = positive_roots(five(polynomial), turning + [0.0] * (4 - len(turning)), len(turning), roots)
    return roots[:count]


@given(numbers, numbers, numbers, scales)
def test_quadratic_of_chosen_roots(first, second, factor, scale):
    chosen = sorted([scale * first, scale * second])
    c = factor * Polynomial.fromroots(chosen)
    roots = [0.0] * 2
    count = quadratic_roots(*c.coef, roots)
    if first == second:  # rounding may leave no real root, or two next to each other
        assert all(root == pytest.approx(chosen[0], rel=1e-7) for root in roots[:count])
    else:
        assert count == 2
        assert roots == pytest.approx(chosen, rel=1e-12)


def test_small_root_of_a_quadratic_without_cancellation():
    roots = [0.0] * 2
    assert quadratic_roots(1.0, -1e9, 1.0, roots) == 2
    assert roots == pytest.approx([1e-9, 1e9], rel=1e-15)


@pytest.mark.parametrize(
    ("c", "expected"),
    [
        ((-6.0, 2.0, 0.0), [3.0]),
        ((5.0, 0.0, 0.0), []),
        ((1.0, 0.0, 1.0), []),
        ((0.0, 0.0, 2.0), [0.0]),
        ((0.0, 0.0, 0.0), []),
        ((0.0, -3.0, 1.0), [0.0, 3.0]),
        ((-4.0, 0.0, 1.0), [-2.0, 2.0]),
    ],
)
def test_degenerate_quadratics(c, expected):
    roots = [0.0] * 2
    assert roots[: quadratic_roots(*c, roots)] == expected


@given(st.lists(numbers, min_size=1, max_size=4, unique=True), numbers, scales)
def test_positive_roots_of_chosen_roots(chosen, factor, scale):
    roots = sorted(scale * root for root in chosen)
    expected = [root for root in roots if root > 0.0]
    polynomial = factor * Polynomial.fromroots(roots)
    actual = found_roots(polynomial)
    # as well determined as the slope there lets them be
    slope = abs(polynomial.deriv()(np.array(expected)))
    error = 1e-14 * Polynomial(abs(polynomial.coef))(np.array(expected))
    assert len(actual) == len(expected)
    assert np.all(abs(np.array(actual) - expected) <= 10.0 * error / slope)


@given(st.lists(numbers, min_size=2, max_size=5))
def test_signs_change_at_the_positive_roots_and_nowhere_else(coefficients):
    polynomial = Polynomial(coefficients)
    actual = found_roots(polynomial)
    edges = [0.0, *actual, 2.0 * (actual[-1] if actual else 1.0) + 1e4]
    for number, (low, high) in enumerate(itertools.pairwise(edges)):
        inside = polynomial(np.linspace(low, high, 41)[1:-1])
        doubtful = abs(inside) <= 1e-9 * Polynomial(np.abs(coefficients))(high)
        assert np.all(doubtful | (np.sign(inside) == np.sign(coefficients[0]) * (-1) ** number))


@pytest.mark.parametrize("root", [1e-12, 0.3, 1.0, 7.0, 1e12])
def test_a_root_in_a_bracket_to_the_last_bits(root):
    c = [-root * root * root, 0.0, 0.0, 1.0, 0.0]
    assert first_crossing(c, 0.0, LARGEST, 0.0) == pytest.approx(root, rel=4e-16)
    assert root_between(c, 0.0, 3.0 * root, True, 1.01 * root) == pytest.approx(root, rel=4e-16)


def test_no_crossing_within_the_limits():
    assert first_crossing([1.0, 1.0, 0.0, 0.0, 0.0], 0.0, LARGEST, 0.0) == 0.0
    assert first_crossing([-2.0, 1.0, 0.0, 0.0, 0.0], 0.0, 1.5, 0.0) == 0.0
    assert first_crossing([-1.0, 1e-16, 0.0, 0.0, 0.0], 0.0, LARGEST, 0.0) == 0.0
    assert first_crossing([0.0, 1.0, 0.0, 0.0, 0.0], 0.0, LARGEST, 0.0) == 0.0


@pytest.mark.parametrize("wrong", [math.inf, -math.inf, math.nan])
def test_ends_whatever_it_is_given(wrong):
    roots = [0.0] * 4
    for place in range(5):
        c = [-1.0, 2.0, -3.0, 4.0, -5.0]
        c[place] = wrong
        assert positive_roots(c, [wrong, 1.0, 2.0, 0.0], 3, roots) <= 4
        assert quadratic_roots(c[0], c[1], c[2], roots) <= 2


def test_evaluates():
    assert evaluate([1.0, 2.0, 3.0, 4.0, 5.0], -2.0) == np.polyval([5.0, 4.0, 3.0, 2.0, 1.0], -2.0)
