"""Smallest output feedback among all with the required poles."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import null_space
from scipy.optimize import approx_fprime

from perilune import modal
from perilune.analysis.design.poles.smallest import polynomial_and_slope
from tests.support.lengths import LONG, either
from tests.support.modal.draws import assert_placed, random_systems


def test_coefficients_and_their_derivatives() -> None:
    random = np.random.default_rng(0)
    for size in (1, 2, 5):
        matrix = random.normal(size=(size, size))
        coefficients, adjugate = polynomial_and_slope(matrix)
        np.testing.assert_allclose(coefficients, np.poly(matrix)[1:], atol=1e-12)
        expected = approx_fprime(matrix.ravel(), lambda m, n=size: np.poly(m.reshape(n, n))[1:], 1e-7)
        slope = -adjugate.swapaxes(1, 2).reshape(size, -1)
        np.testing.assert_allclose(slope, expected.reshape(size, -1), atol=1e-5)


def test_has_the_poles_and_is_smaller() -> None:
    norms = []
    for a, b, c, poles in random_systems(either(20, 1), 6, 3, 4, most_pairs=2, seed=36):
        minimum = modal.output_feedback(a, b, c, poles, choice="least_norm")
        actual = modal.output_feedback(a, b, c, poles, choice="smallest")
        assert_placed(a + b @ actual.gain @ c, poles)
        norms.append((actual.norm, minimum.norm))
        assert norms[-1][0] <= norms[-1][1]
    if LONG:
        smallest, minimum = np.median(norms, axis=0)
        assert smallest < 0.5 * minimum


def test_no_way_down_remains() -> None:
    """F at the end of the search is at right angles to every direction that leaves the poles (Lagrange)."""
    ended = 0
    for a, b, c, poles in random_systems(either(20, 3), 4, 3, 3, most_pairs=0, seed=37):
        actual = modal.output_feedback(a, b, c, poles, choice="smallest")
        if actual.method == "smallest":
            slope = polynomial_and_slope(a + b @ actual.gain @ c)[1]
            constraints = (c @ slope @ b).swapaxes(1, 2).reshape(4, -1)
            along = null_space(constraints / np.linalg.norm(constraints, axis=1, keepdims=True))
            ended += np.linalg.norm(along.T @ actual.gain.ravel()) < 0.05 * np.linalg.norm(actual.gain)
            assert (actual.upper, actual.condition_x) == (None, None)
    assert ended >= either(15, 2)


def test_poles_that_the_plant_has_need_little_gain() -> None:
    for a, b, c, _ in random_systems(either(10, 2), 5, 3, 3, seed=38):
        actual = modal.output_feedback(a, b, c, np.linalg.eigvals(a), choice="smallest")
        assert actual.norm <= modal.output_feedback(a, b, c, np.linalg.eigvals(a), choice="least_norm").norm
        assert_placed(a + b @ actual.gain @ c, np.linalg.eigvals(a))


def test_repeated_poles_have_no_derivative() -> None:
    a, b, c, _ = next(random_systems(1, 5, 3, 4))
    with pytest.raises(modal.PlacementError, match="needs distinct poles") as refused:
        modal.output_feedback(a, b, c, [-1.0] * 5, choice="smallest")
    assert refused.value.reason is modal.Reason.RANK
