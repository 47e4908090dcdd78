"""Bounds of structured singular values. Truth: closed forms, and SLICOT."""

from __future__ import annotations

import numpy as np
import pytest
from slycot import ab13md

from perilune.analysis.stability.loops.structured import upper_bound

MATRICES = 40


def complex_normal(random: np.random.Generator, *shape: int) -> np.ndarray:
    return random.normal(size=shape) + 1j * random.normal(size=shape)


def unscaled(random: np.random.Generator, matrix: np.ndarray) -> np.ndarray:
    """Return D^-1 M D with gains over four decades, which leaves the bound."""
    gains = 10.0 ** random.uniform(-2.0, 2.0, matrix.shape[:2])
    return matrix / gains[:, :, None] * gains[:, None, :]


@pytest.mark.parametrize("channels", [2, 3, 4, 6])
def test_largest_singular_value_with_vectors_of_equal_sizes(channels: int) -> None:
    """With |u_i| = |v_i| the slope of the convex bound is zero: D = I is best. The others are smaller."""
    random = np.random.default_rng(channels)
    vector = complex_normal(random, MATRICES, channels, channels)
    left, _ = np.linalg.qr(vector)
    turned = vector.copy()
    turned[:, :, 0] *= np.exp(1j * random.uniform(-np.pi, np.pi, (MATRICES, channels)))
    right, _ = np.linalg.qr(turned)
    sizes = random.uniform(0.0, 0.95, (MATRICES, channels))
    sizes[:, 0] = 1.0
    matrix = left * sizes[:, None, :] @ right.conj().swapaxes(1, 2)
    np.testing.assert_allclose(upper_bound(unscaled(random, matrix)), 1.0, rtol=2e-9)


@pytest.mark.parametrize("channels", [2, 3, 4, 6])
def test_unitary_matrices_have_one_and_a_kink(channels: int) -> None:
    """All singular values meet where every D is worse: the bound cannot be below a unitary matrix's eigenvalues."""
    random = np.random.default_rng(channels)
    matrix, _ = np.linalg.qr(complex_normal(random, MATRICES, channels, channels))
    np.testing.assert_allclose(upper_bound(unscaled(random, matrix)), 1.0, rtol=5e-9)


@pytest.mark.parametrize("channels", [2, 3, 5])
def test_matrices_of_rank_one(channels: int) -> None:
    random = np.random.default_rng(channels)
    column, row = complex_normal(random, MATRICES, channels, 1), complex_normal(random, MATRICES, 1, channels)
    expected = np.sum(np.abs(column[:, :, 0] * row[:, 0, :]), axis=1)
    np.testing.assert_allclose(upper_bound(column * row), expected, rtol=1e-9)


@pytest.mark.parametrize("channels", [1, 2, 3, 5])
def test_one_way_coupling_does_not_count(channels: int) -> None:
    """Nor does it within rounding. The least value is only approached, by scaling without end."""
    random = np.random.default_rng(channels)
    matrix = np.triu(complex_normal(random, MATRICES, channels, channels))
    expected = np.max(np.abs(np.diagonal(matrix, axis1=1, axis2=2)), axis=1)
    np.testing.assert_allclose(upper_bound(matrix), expected, rtol=1e-12)
    noise = 1e-17 * complex_normal(random, MATRICES, channels, channels)
    np.testing.assert_allclose(upper_bound(matrix + np.tril(noise, -1)), expected, rtol=1e-6)


@pytest.mark.parametrize("channels", [2, 3, 4, 5])
def test_equals_slicot(channels: int) -> None:
    random = np.random.default_rng(channels)
    matrix = complex_normal(random, MATRICES, channels, channels)
    kinds = np.ones(channels, dtype=int), np.full(channels, 2)
    expected = np.array([ab13md(one, *kinds)[0] for one in matrix])
    np.testing.assert_allclose(upper_bound(matrix), expected, rtol=1e-8)


@pytest.mark.parametrize("channels", [3, 4, 6])
def test_groups_that_do_not_answer_each_other(channels: int) -> None:
    """Permuted block triangular matrices: the largest bound of a block; AB13MD 0.7.1 does not return for some."""
    random = np.random.default_rng(channels)
    matrix, order = complex_normal(random, MATRICES, channels, channels), random.permutation(channels)
    matrix[:, 2:, :2] = 0.0
    expected = np.maximum(upper_bound(matrix[:, :2, :2]), upper_bound(matrix[:, 2:, 2:]))
    np.testing.assert_allclose(upper_bound(matrix[:, order][:, :, order]), expected, rtol=5e-9)
    assert np.all(upper_bound(np.triu(matrix, 1)) == 0.0)


def test_nothing_and_size() -> None:
    random = np.random.default_rng(0)
    matrix = complex_normal(random, 3, 3, 3)
    matrix[1] = 0.0
    actual = upper_bound(matrix)
    assert actual[1] == 0.0
    np.testing.assert_allclose(upper_bound(1e-200 * matrix), 1e-200 * actual, rtol=1e-12)
    np.testing.assert_allclose(upper_bound(matrix[[2, 0]]), actual[[2, 0]], rtol=1e-12)
