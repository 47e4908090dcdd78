"""Observers: poles, and error decay in simulation with the plant. Truth: numpy's eigenvalues, matrix exponentials."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import expm

from perilune import modal
from tests.support.lengths import either
from tests.support.modal.draws import assert_placed, random_spectrum, random_systems


@pytest.mark.parametrize(("method", "choice"), [("ackermann", "diagonal"), ("indices", "diagonal"), (None, "diagonal")])
def test_full_order(method: str | None, choice: str) -> None:
    for a, b, c, poles in random_systems(either(50, 6), 4, 1, 2, most_pairs=1, seed=22):
        actual = modal.observer(a, c, poles, method=method, choice=choice)
        assert_placed(a - actual.gain @ c, poles)
        assert actual.gain.shape == (4, 2)
        np.testing.assert_allclose(actual.gain.T, modal.place(a.T, c.T, poles, method=method).gain)
        # plant and observer together, with an input that both know
        joint = np.block([[a, np.zeros((4, 4)), b], [actual.gain @ c, a - actual.gain @ c, b], [np.zeros((1, 9))]])
        start = np.array([1.0, -1.0, 0.5, 2.0, 0.0, 0.0, 0.0, 0.0, 1.0])
        end = expm(0.7 * joint) @ start
        error = expm(0.7 * (a - actual.gain @ c)) @ (start[4:8] - start[:4])
        np.testing.assert_allclose(end[4:8] - end[:4], error, atol=1e-9 * np.max(np.abs(joint)))


@pytest.mark.parametrize(("states", "outputs"), [(4, 2), (5, 2), (6, 4), (3, 1)])
def test_reduced_order(states: int, outputs: int) -> None:
    random = np.random.default_rng(states)
    for a, b, c, _ in random_systems(either(50, 6), states, 2, outputs, seed=23):
        remainder = states - outputs
        poles = random_spectrum(random, remainder, int(random.integers(remainder // 2 + 1)))
        actual = modal.reduced_observer(a, c, poles, b=b)
        assert_placed(actual.closed_loop, poles)
        # plant, observer and constant inputs together
        joint = np.block(
            [
                [a, np.zeros((states, remainder)), b],
                [actual.from_y @ c, actual.closed_loop, actual.from_u],
                [np.zeros((2, states + remainder + 2))],
            ]
        )
        estimate = np.hstack([actual.of_y @ c, actual.of_zeta, np.zeros((states, 2))])
        start = random.normal(size=states + remainder + 2)
        end = expm(0.7 * joint) @ start
        size = np.linalg.norm(expm(0.7 * joint), 2) * np.linalg.norm(estimate, 2) * np.linalg.norm(start)
        # every measurement is met at once, and the rest of the error decays as the matrix says
        np.testing.assert_allclose(c @ estimate @ end, c @ end[:states], atol=1e-12 * size)
        before, after = (actual.of_zeta.T @ (estimate @ x - x[:states]) for x in (start, end))
        np.testing.assert_allclose(after, expm(0.7 * actual.closed_loop) @ before, atol=1e-11 * size)


def test_least_condition_by_duality() -> None:
    a, _, c, poles = next(random_systems(1, 5, 1, 2, most_pairs=0, seed=24))
    actual = modal.observer(a, c, poles, choice="least_condition", starts=4)
    assert actual.kappa <= modal.observer(a, c, poles).kappa
    assert_placed(a - actual.gain @ c, poles)


def test_what_is_not_observable_or_has_no_rank() -> None:
    a, c = np.diag([1.0, 2.0, 3.0]), [[1.0, 1.0, 0.0]]
    with pytest.raises(modal.PlacementError, match=r"observer: .*not observable.* measure further states") as refused:
        modal.observer(a, c, [-1.0, -2.0, -3.0])
    assert refused.value.number == 0.0
    with pytest.raises(modal.PlacementError, match="not observable"):
        modal.reduced_observer(a, c, [-1.0, -2.0])
    with pytest.raises(modal.PlacementError, match="is rank deficient") as refused:
        modal.reduced_observer(a, [[1.0, 1.0, 1.0], [2.0, 2.0, 2.0]], [-1.0])
    assert refused.value.reason is modal.Reason.RANK
    with pytest.raises(modal.PlacementError, match="is rank deficient"):
        modal.reduced_observer(a, np.ones((4, 3)), [])
    with pytest.raises(ValueError, match="C measures every state, and no observer is needed"):
        modal.reduced_observer(a, np.eye(3), [])
    with pytest.raises(ValueError, match="C: is 1 by 2, but A has 3 states; give one column per state"):
        modal.observer(a, [[1.0, 1.0]], [-1.0, -2.0, -3.0])
