"""Output feedback gone down along the set that has the poles."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize

from perilune import modal
from tests.support.lengths import LONG, either
from tests.support.modal.draws import assert_placed, random_systems


def test_the_smallest_has_the_poles_and_is_smaller() -> None:
    norms = []
    for a, b, c, poles in random_systems(either(20, 1), 6, 3, 4, most_pairs=2, seed=36):
        least = modal.output_feedback(a, b, c, poles, choice="least_norm")
        found = modal.output_feedback(a, b, c, poles, choice="smallest")
        assert (found.method, found.upper, found.condition_x) == ("smallest", None, None)
        assert_placed(a + b @ found.gain @ c, poles)
        norms.append((np.linalg.norm(found.gain), np.linalg.norm(least.gain)))
        assert norms[-1][0] <= norms[-1][1]
    if LONG:
        smallest, least = np.median(norms, axis=0)
        assert smallest < 0.5 * least


def test_no_way_down_remains() -> None:
    """scipy's SLSQP on coefficients of the characteristic polynomial, from where we stopped, finds nothing smaller."""
    for a, b, c, poles in random_systems(either(10, 2), 4, 3, 3, most_pairs=0, seed=37):
        found = modal.output_feedback(a, b, c, poles, choice="smallest")

        def lacking(f: np.ndarray, plant=(a, b, c), wanted=poles) -> np.ndarray:
            return np.poly(plant[0] + plant[1] @ f.reshape(3, 3) @ plant[2])[1:] - np.poly(wanted)[1:]

        other = minimize(
            lambda f: f @ f,
            found.gain.ravel(),
            jac=lambda f: 2.0 * f,
            method="SLSQP",
            constraints={"type": "eq", "fun": lacking},
            options={"ftol": 1e-12, "maxiter": 500},
        )
        assert np.sqrt(other.fun) > 0.97 * np.linalg.norm(found.gain)


def test_poles_that_the_plant_has_need_no_gain() -> None:
    for a, b, c, _ in random_systems(either(10, 2), 5, 3, 3, seed=38):
        poles = np.linalg.eigvals(a)
        found = modal.output_feedback(a, b, c, poles, choice="smallest")
        least = modal.output_feedback(a, b, c, poles, choice="least_norm")
        assert found.norm <= least.norm
        assert_placed(a + b @ found.gain @ c, poles)


def test_repeated_poles_have_no_derivative() -> None:
    a, b, c, _ = next(random_systems(1, 5, 3, 4))
    with pytest.raises(modal.PlacementError, match="poles are repeated") as refused:
        modal.output_feedback(a, b, c, [-1.0] * 5, choice="smallest")
    assert refused.value.reason is modal.Reason.RANK
