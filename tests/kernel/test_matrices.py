"""Matrices of kernels against numpy and rational numbers: within the rounding that the condition number allows."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from perilune.fmus_src.kernel.matrices import (
    add_diagonal,
    add_isotropic,
    add_outer,
    add_product,
    column,
    element,
    exponential,
    identity,
    inverse,
    inverse_quadratic_form,
    mirror,
    multiply,
    multiply_vector,
    row,
    set_column,
    set_element,
    set_isotropic,
    set_row,
)
from perilune.fmus_src.kernel.vector_types import vector

seeds = st.integers(0, 2**32 - 1)
sizes = st.integers(1, 6)
EPSILON = 2.2e-16


def random_matrices(seed, n, count=1):
    return np.random.default_rng(seed).normal(size=(count, n, n))


@settings(max_examples=50)
@given(seeds, sizes)
def test_products(seed, n):
    a, b = random_matrices(seed, n, 2)
    product = [0.0] * 36
    multiply(a.ravel().tolist(), b.ravel().tolist(), product, n)
    assert product[: n * n] == pytest.approx((a @ b).ravel(), abs=1e-13)
    one = [7.0] * 36
    identity(one, n)
    assert one[: n * n] == np.eye(n).ravel().tolist()


@settings(max_examples=50)
@given(seeds, st.integers(1, 15))
def test_sums_of_products(seed, n):
    a, b, q = random_matrices(seed, n, 3)
    x, y = random_matrices(seed, n)[0][0], b[0]
    total = [0.0] * n * n
    add_product(a.ravel().tolist(), b.ravel().tolist(), q.ravel().tolist(), total, n)
    assert total == pytest.approx((q + a @ b.T).ravel(), abs=1e-12)
    add_outer(total, -0.5, x.tolist(), y.tolist(), n)
    assert total == pytest.approx((q + a @ b.T - 0.5 * np.outer(x, y)).ravel(), abs=1e-12)
    transformed = [0.0] * n
    multiply_vector(a.ravel().tolist(), x.tolist(), transformed, n)
    assert transformed == pytest.approx(a @ x, abs=1e-13)


@given(seeds, st.integers(3, 15), st.data())
def test_elements_and_blocks_are_those_of_numpy(seed, n, data):
    (a,) = random_matrices(seed, n)
    i, j = data.draw(st.integers(0, n - 3)), data.draw(st.integers(0, n - 3))
    actual = a.ravel().tolist()
    assert element(actual, n, i, j) == a[i, j]
    assert tuple(row(actual, n, i, j)) == tuple(a[i, j : j + 3])
    assert tuple(column(actual, n, i, j)) == tuple(a[i : i + 3, j])
    set_element(actual, n, j, i, 7.0)
    a[j, i] = 7.0
    set_row(actual, n, i, j, vector(1.0, 2.0, 3.0))
    a[i, j : j + 3] = 1.0, 2.0, 3.0
    set_column(actual, n, j, i, vector(4.0, 5.0, 6.0))
    a[j : j + 3, i] = 4.0, 5.0, 6.0
    add_isotropic(actual, n, i, j, 0.5)
    a[i : i + 3, j : j + 3] += 0.5 * np.eye(3)
    add_diagonal(actual, n, j, i, vector(1.0, -2.0, 3.0))
    a[j : j + 3, i : i + 3] += np.diag([1.0, -2.0, 3.0])
    set_isotropic(actual, n, j, j, 8.0)
    np.fill_diagonal(a[j : j + 3, j : j + 3], 8.0)
    mirror(actual, n, n - 1)
    assert actual == (np.triu(a) + np.triu(a, 1).T).ravel().tolist()


@given(st.integers(1, 15), seeds)
@settings(max_examples=40, deadline=None)
def test_an_inverse_quadratic_form_is_that_of_a_solved_system(n, seed):
    (root,) = random_matrices(seed, n)
    p = root @ root.T + np.eye(n)
    e = np.random.default_rng(seed).normal(size=n)
    retained = p.ravel().tolist()
    assert inverse_quadratic_form(retained, e.tolist(), n) == pytest.approx(e @ np.linalg.solve(p, e), rel=1e-9)
    assert retained == p.ravel().tolist()


def test_an_inverse_quadratic_form_says_where_a_matrix_is_not_positive():
    assert inverse_quadratic_form([1.0, 2.0, 2.0, 1.0], [1.0, 1.0], 2) == -1.0
    assert inverse_quadratic_form([0.0], [0.0], 1) == -1.0
    assert inverse_quadratic_form([float("nan")], [0.0], 1) == -1.0


@settings(max_examples=50)
@given(seeds, sizes)
def test_inverses(seed, n):
    (a,) = random_matrices(seed, n)
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
    (a,) = random_matrices(seed, n)
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
