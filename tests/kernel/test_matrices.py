"""Matrices of kernels against numpy and rational numbers: within the rounding that the condition number allows."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from perilune.fmus_src.kernel.matrices import exponential, identity, inverse, multiply

seeds = st.integers(0, 2**32 - 1)
sizes = st.integers(1, 6)
EPSILON = 2.2e-16


def drawn(seed, n, count=1):
    return np.random.default_rng(seed).normal(size=(count, n, n))


@settings(max_examples=50)
@given(seeds, sizes)
def test_products(seed, n):
    a, b = drawn(seed, n, 2)
    product = [0.0] * 36
    multiply(a.ravel().tolist(), b.ravel().tolist(), product, n)
    assert product[: n * n] == pytest.approx((a @ b).ravel(), abs=1e-13)
    one = [7.0] * 36
    identity(one, n)
    assert one[: n * n] == np.eye(n).ravel().tolist()


@settings(max_examples=50)
@given(seeds, sizes)
def test_inverses(seed, n):
    (a,) = drawn(seed, n)
    actual = [0.0] * 36
    assert inverse(a.ravel().tolist(), actual, n)
    bound = 50.0 * EPSILON * np.linalg.cond(a) * np.linalg.norm(np.linalg.inv(a))
    assert np.linalg.norm(np.reshape(actual[: n * n], (n, n)) - np.linalg.inv(a)) < bound


@pytest.mark.parametrize("a", [[1.0, 2.0, 2.0, 4.0], [0.0, 0.0, 0.0, 0.0], [float("nan"), 0.0, 0.0, 1.0]])
def test_without_an_inverse(a):
    assert not inverse(a, [0.0] * 4, 2)


def test_rows_are_exchanged_where_a_pivot_is_zero():
    actual = [0.0] * 9
    assert inverse([0.0, 0.0, 2.0, 4.0, 0.0, 0.0, 0.0, 8.0, 0.0], actual, 3)
    assert actual == [0.0, 0.25, 0.0, 0.0, 0.0, 0.125, 0.5, 0.0, 0.0]


def exact_exponential(a):
    """The series of exp(a) in rational numbers, 60 terms rounded to 2^-200; scipy's expm has lost four digits here."""
    n = len(a)
    exact = [[Fraction(entry) for entry in row] for row in a.tolist()]
    term = [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]
    total = term
    for k in range(1, 60):
        product = [[sum(term[i][m] * exact[m][j] for m in range(n)) / k for j in range(n)] for i in range(n)]
        term = [[Fraction(int(entry * 2**200), 2**200) for entry in row] for row in product]
        total = [[x + y for x, y in zip(*rows, strict=True)] for rows in zip(total, term, strict=True)]
    return np.array([[float(entry) for entry in row] for row in total])


@settings(max_examples=50)
@given(seeds, sizes, st.floats(-5.0, 5.0))
@example(1845, 3, 1.0)  # expm of scipy is 2e-12 off
def test_exponentials(seed, n, t):
    (a,) = drawn(seed, n)
    actual = [0.0] * 36
    exponential(a.ravel().tolist(), t, actual, n)
    expected = exact_exponential(a * t)
    scale = np.exp(np.linalg.norm(a * t, 2))
    assert np.abs(np.reshape(actual[: n * n], (n, n)) - expected).max() < 200.0 * EPSILON * scale


def test_the_exponential_of_a_rotation():
    actual = [0.0] * 9
    exponential([0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0], 0.3, actual, 3)
    c, s = np.cos(0.3), np.sin(0.3)
    assert actual == pytest.approx([c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0], abs=1e-15)
