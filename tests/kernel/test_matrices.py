"""Matrices of kernels. Truth: numpy and rational numbers, within rounding errors scaled by the condition."""

import pickle
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from perilune.fmus_src.block import Block, State
from perilune.fmus_src.kernel.matrices import (
    Matrix,
    add_product,
    block,
    cross_matrix,
    diagonal,
    exponential,
    identity,
    inverse,
    inverse_quadratic_form,
    matrix,
    mirror,
    outer,
    zeros,
)
from perilune.fmus_src.kernel.vector_types import vector
from tests.support.lengths import either

seeds = st.integers(0, 2**32 - 1)
sizes = st.integers(1, 6)
EPSILON = 2.2e-16


def random_matrices(seed, n, count=1):
    return np.random.default_rng(seed).normal(size=(count, n, n))


def ours(a):
    return Matrix(a.tolist())


@given(seeds)
def test_the_cross_matrix_is_that_of_the_vector_product(seed):
    v, u = np.random.default_rng(seed).normal(size=(2, 3))
    assert np.asarray(cross_matrix(vector(*v))) @ u == pytest.approx(np.cross(v, u), rel=1e-14, abs=1e-15)


@settings(max_examples=either(50, 16))
@given(seeds, st.integers(1, 15), st.integers(1, 15), st.integers(1, 15))
def test_operators_are_those_of_numpy(seed, n, m, k):
    generator = np.random.default_rng(seed)
    a, b, c = generator.normal(size=(n, m)), generator.normal(size=(n, m)), generator.normal(size=(m, k))
    x, y = ours(a), ours(b)
    for mine, truth in (
        (x + y, a + b),
        (x - y, a - b),
        (-x, -a),
        (2.5 * x, 2.5 * a),
        (x * 2.5, a * 2.5),
        (x / 3.0, a / 3.0),
        (x.T, a.T),
        (x.copy(), a),
    ):
        assert np.array_equal(np.array(mine), truth)
    assert np.array(x @ ours(c)) == pytest.approx(a @ c, abs=1e-13)
    assert np.array_equal(np.array(np.float64(2.0) * x), 2.0 * a)
    assert len(x) == n
    assert x.shape == (n, m)
    assert (x == y, x == x.copy()) == (False, True)


@pytest.mark.parametrize("size", [2, 3, 4])
@pytest.mark.parametrize("n", [1, 2, 3, 4, 6])
def test_a_matrix_times_a_vector(n, size):
    a, v = np.random.default_rng(n).normal(size=(n, size)), vector(*[0.5, -2.0, 3.0, 1.5][:size])
    product = ours(a) @ v
    assert np.ravel(product if n in (1, 6) else [*product]) == pytest.approx(a @ [*v], abs=1e-14)


def test_sums_run_from_the_first_product():
    large = matrix([1e16, 1.0, -1e16])
    assert (large @ matrix([1.0], [1.0], [1.0]))[0, 0] == (1e16 + 1.0) - 1e16
    assert str((matrix([-0.0]) @ matrix([1.0]))[0, 0]) == "-0.0"


@given(seeds, st.integers(5, 15), st.data())
def test_elements_and_blocks_are_those_of_numpy(seed, n, data):
    (a,) = random_matrices(seed, n)
    actual = ours(a)
    i, j = data.draw(st.integers(0, n - 3)), data.draw(st.integers(0, n - 3))
    rows, columns = block(i, 3), block(j, 2)
    assert actual[i, j] == a[i, j]
    assert tuple(actual[i, columns]) == tuple(a[i, columns])
    assert tuple(actual[rows, j]) == tuple(a[rows, j])
    assert np.array_equal(np.array(actual[rows, columns]), a[rows, columns])
    assert np.array_equal(np.array(actual[i, :]), a[i : i + 1, :])
    assert np.array_equal(np.array(actual[:, j]), a[:, j : j + 1])
    actual[j, i] = a[j, i] = 7.0
    actual[i, columns] = vector(1.0, 2.0)
    a[i, columns] = 1.0, 2.0
    actual[rows, j] = vector(4.0, 5.0, 6.0)
    a[rows, j] = 4.0, 5.0, 6.0
    actual[rows, columns] += 0.5 * actual[rows, columns]
    a[rows, columns] += 0.5 * a[rows, columns]
    actual[:, i] = actual[:, j]
    a[:, i] = a[:, j]
    actual[i, :] = 2.0 * actual[i, :]
    a[i, :] *= 2.0
    mirror(actual, n)
    assert np.array_equal(np.array(actual), np.triu(a) + np.triu(a, 1).T)


def test_what_does_not_fit_is_refused():
    with pytest.raises(ValueError, match="unpack"):
        identity(2) @ identity(3)
    with pytest.raises(ValueError, match=r"size \(2, 2\): their size is \(3, 3\)"):
        identity(2) + identity(3)
    with pytest.raises(ValueError, match=r"size \(2, 2\): their size is \(3, 3\)"):
        identity(3)[0:2, 0:2] = identity(3)
    with pytest.raises(TypeError, match="a product of matrices is a @ b"):
        identity(2) * identity(2)
    with pytest.raises(IndexError):
        identity(2)[0, 2]


class Filter(Block):
    """Has matrices."""

    named = State([1.0, 2.0, 3.0, 4.0, 5.0, 6.0], columns=3, description="named by row and column")
    numbered = State(zeros(2, 2), description="numbered through")

    def step(self, t: float, h: float) -> None:
        """Do nothing."""


def test_a_block_copies_its_matrices():
    first, a = Filter(), identity(2)
    first.numbered = a
    numbered = first.numbered
    a[0, 1] = 5.0
    first.numbered = 2.0 * first.numbered
    assert numbered is first.numbered
    assert first.numbered == 2.0 * identity(2)
    assert Filter().numbered == zeros(2, 2)
    first.named = np.arange(6.0).reshape(2, 3)
    assert first.named == matrix([0.0, 1.0, 2.0], [3.0, 4.0, 5.0])
    assert Filter.variables["named"].element_names()[3] == "named[2,1]"
    assert Filter.variables["numbered"].element_names()[3] == "numbered[4]"
    with pytest.raises(TypeError, match="give a list of 4"):
        first.numbered = identity(3)
    assert pickle.loads(pickle.dumps(numbered)) == numbered
    assert repr(numbered) == "matrix([2.0, 0.0], [0.0, 2.0])"


def test_what_makes_matrices():
    v, w = vector(1.0, 2.0, 3.0), vector(4.0, 5.0)
    assert np.array_equal(np.array(diagonal(v)), np.diag([*v]))
    assert np.array_equal(np.array(outer(v, w)), np.outer([*v], [*w]))
    assert np.array_equal(np.array(identity(3)), np.eye(3))


@settings(max_examples=either(50, 16))
@given(seeds, st.integers(1, 15))
def test_sums_of_products(seed, n):
    a, b, q = random_matrices(seed, n, 3)
    assert np.array(add_product(ours(q), ours(a), ours(b))) == pytest.approx(q + a @ b, abs=1e-12)


@given(st.integers(1, 15), seeds)
@settings(max_examples=either(40, 13), deadline=None)
def test_an_inverse_quadratic_form_is_that_of_a_solved_system(n, seed):
    (root,) = random_matrices(seed, n)
    p = root @ root.T + np.eye(n)
    e = np.random.default_rng(seed).normal(size=(n, 1))
    form = inverse_quadratic_form(ours(p), ours(e))
    assert form == pytest.approx((e.T @ np.linalg.solve(p, e)).item(), rel=1e-9)


def test_an_inverse_quadratic_form_says_where_a_matrix_is_not_positive():
    assert inverse_quadratic_form(matrix([1.0, 2.0], [2.0, 1.0]), matrix([1.0], [1.0])) == -1.0
    assert inverse_quadratic_form(matrix([0.0]), matrix([0.0])) == -1.0
    assert inverse_quadratic_form(matrix([float("nan")]), matrix([0.0])) == -1.0


@settings(max_examples=either(50, 16))
@given(seeds, sizes)
def test_inverses(seed, n):
    (a,) = random_matrices(seed, n)
    actual, invertible = inverse(ours(a))
    assert invertible
    bound = 50.0 * EPSILON * np.linalg.cond(a) * np.linalg.norm(np.linalg.inv(a))
    assert np.linalg.norm(np.array(actual) - np.linalg.inv(a)) < bound


@pytest.mark.parametrize(
    "a", [matrix([1.0, 2.0], [2.0, 4.0]), zeros(2, 2), matrix([float("nan"), 0.0], [0.0, 1.0])], ids=str
)
def test_without_an_inverse(a):
    assert not inverse(a)[1]


def test_rows_are_exchanged_where_a_pivot_is_zero():
    actual, invertible = inverse(matrix([0.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 8.0, 0.0]))
    assert invertible
    assert actual == matrix([0.0, 0.25, 0.0], [0.0, 0.0, 0.125], [0.5, 0.0, 0.0])


def exact_exponential(a):
    """Sum the series of exp(a) in rational numbers, 60 terms rounded to 2^-200; scipy's expm has lost four digits
    here."""
    n = len(a)
    exact = [[Fraction(entry) for entry in row] for row in a.tolist()]
    term = [[Fraction(int(i == j)) for j in range(n)] for i in range(n)]
    total = term
    for k in range(1, 60):
        product = [[sum(term[i][m] * exact[m][j] for m in range(n)) / k for j in range(n)] for i in range(n)]
        term = [[Fraction(int(entry * 2**200), 2**200) for entry in row] for row in product]
        total = [[x + y for x, y in zip(*rows, strict=True)] for rows in zip(total, term, strict=True)]
    return np.array([[float(entry) for entry in row] for row in total])


@settings(max_examples=either(50, 16))
@given(seeds, sizes, st.floats(-5.0, 5.0))
@example(1845, 3, 1.0)  # expm of scipy is 2e-12 off
def test_exponentials(seed, n, t):
    (a,) = random_matrices(seed, n)
    expected = exact_exponential(a * t)
    scale = np.exp(np.linalg.norm(a * t, 2))
    assert np.abs(np.array(exponential(ours(a), t)) - expected).max() < 200.0 * EPSILON * scale


def test_the_exponential_of_a_rotation():
    actual = exponential(matrix([0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]), 0.3)
    c, s = np.cos(0.3), np.sin(0.3)
    assert np.array(actual) == pytest.approx(np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]), abs=1e-15)
