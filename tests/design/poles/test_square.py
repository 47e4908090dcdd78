"""Output feedback with m + p = n."""

from __future__ import annotations

import numpy as np
import pytest

from perilune import modal
from tests.support.lengths import either
from tests.support.modal.draws import assert_placed, random_systems


@pytest.mark.parametrize(
    ("states", "inputs", "outputs", "most", "count"), [(6, 3, 3, 2, either(50, 3)), (8, 4, 4, 4, either(50, 2))]
)
def test_places_every_draw(states: int, inputs: int, outputs: int, most: int, count: int) -> None:
    for a, b, c, poles in random_systems(count, states, inputs, outputs, most_pairs=most, seed=30):
        actual = modal.output_feedback(a, b, c, poles, method="direct")
        assert_placed(a + b @ actual.gain @ c, poles, actual.condition_x)


def real_solutions(a: np.ndarray, b: np.ndarray, c: np.ndarray, poles: np.ndarray) -> bool:
    """Return True if there are real solutions. For n, m, p = 4, 2, 2 det(s I - A - B F C) is linear in the four F_ij
    and in d = det F.

    The coefficients give F = f + g d; det(f + g d) = d is a quadratic equation.
    """

    def polynomial(gain: np.ndarray) -> np.ndarray:
        return np.poly(a + b @ gain @ c)[1:]

    none = polynomial(np.zeros((2, 2)))
    linear = np.array([polynomial(unit) - none for unit in np.eye(4).reshape(4, 2, 2)]).T
    by_determinant = polynomial(np.eye(2)) - none - linear[:, 0] - linear[:, 3]
    f = np.linalg.solve(linear, np.poly(poles).real[1:] - none)
    g = -np.linalg.solve(linear, by_determinant)
    middle = f[0] * g[3] + g[0] * f[3] - f[1] * g[2] - g[1] * f[2] - 1.0
    return bool(middle**2 >= 4.0 * (g[0] * g[3] - g[1] * g[2]) * (f[0] * f[3] - f[1] * f[2]))


def test_two_by_two_is_placed_where_a_real_solution_exists() -> None:
    placed = 0
    count = either(50, 8)
    for a, b, c, poles in random_systems(count, 4, 2, 2, seed=31):
        if real_solutions(a, b, c, poles):
            actual = modal.output_feedback(a, b, c, poles)
            assert_placed(a + b @ actual.gain @ c, poles, actual.condition_x)
            placed += 1
        else:
            with pytest.raises(
                modal.PlacementError,
                match=r"the iteration did not converge \(m \+ p = n\): after the best of 3 starts, the residual of",
            ) as refused:
                modal.output_feedback(a, b, c, poles, starts=3)
            assert refused.value.reason is modal.Reason.RESIDUAL
            assert refused.value.number > 1e-4
    assert placed >= 0.75 * count


def test_least_norm_over_the_spreads() -> None:
    a, b, c, poles = next(random_systems(1, 4, 2, 2, most_pairs=0, seed=32))
    actual = modal.output_feedback(a, b, c, poles, choice="least_norm")
    assert actual.norm <= modal.output_feedback(a, b, c, poles).norm
    assert_placed(a + b @ actual.gain @ c, poles, actual.condition_x)
