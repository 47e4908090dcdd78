"""Set of all output feedbacks: it has m p parameters and contains every feedback found by other methods.

Output feedback independent of a plant's parameter: the published example, and plants constructed to have such a
feedback.
"""

from __future__ import annotations

import numpy as np
import pytest

from perilune import modal
from tests.support.lengths import either
from tests.support.modal.draws import assert_placed, pole_error, random_systems


@pytest.mark.parametrize(("states", "inputs", "outputs"), [(4, 2, 3), (4, 2, 2), (6, 3, 4), (6, 2, 5), (4, 1, 3)])
def test_every_member_has_the_poles_of_its_polynomial(states: int, inputs: int, outputs: int) -> None:
    random = np.random.default_rng(states)
    for a, b, c, _ in random_systems(either(50, 5), states, inputs, outputs, seed=33):
        every = modal.output_feedback_set(a, b, c)
        assert every.free == inputs * outputs
        z = random.normal(size=every.free)
        actual = every.at(z)
        loop = a + b @ actual.gain @ c
        assert np.max(np.abs(loop - actual.closed_loop)) == 0.0
        # the state feedback of the same polynomial is -F C
        state = modal.place_polynomial(a, b, every.coefficients(z))
        size = every.condition_u * max(1.0, np.max(np.abs(state.gain)))
        np.testing.assert_allclose(actual.gain @ c, -state.gain, atol=1e-11 * size)
        np.testing.assert_allclose(every.parameters_of(actual.gain), z, atol=1e-9 * size)


@pytest.mark.parametrize(("states", "inputs", "outputs"), [(4, 2, 3), (6, 3, 4)])
def test_contains_what_the_zeroth_level_finds(states: int, inputs: int, outputs: int) -> None:
    for a, b, c, poles in random_systems(either(50, 5), states, inputs, outputs, most_pairs=1, seed=34):
        other = modal.output_feedback(a, b, c, poles)
        every = modal.output_feedback_set(a, b, c)
        actual = every.at(every.parameters_of(other.gain))
        np.testing.assert_allclose(actual.gain, other.gain, atol=1e-11 * every.condition_u * max(1.0, other.norm))
        assert pole_error(other.closed_loop, actual.wanted) < 1e-6 * max(1.0, other.kappa)


def test_spectrum_is_that_of_the_block_companion() -> None:
    a, b, c, _ = next(random_systems(1, 4, 2, 3, seed=35))
    actual = modal.output_feedback_set(a, b, c).at(np.ones(6))
    assert_placed(a + b @ actual.gain @ c, actual.wanted)


def test_what_it_refuses() -> None:
    a, b, c, _ = next(random_systems(1, 5, 2, 3))
    with pytest.raises(modal.PlacementError, match="states, 5, is not a multiple of the number of inputs, 2"):
        modal.output_feedback_set(a, b, c)
    a, b, c, _ = next(random_systems(1, 4, 2, 3))
    with pytest.raises(modal.PlacementError, match="C has 3 rows, but rank 2") as refused:
        modal.output_feedback_set(a, b, c[[0, 1, 1]])
    assert refused.value.number == 2
    with pytest.raises(ValueError, match="modal: z: is 5; give 6 numbers"):
        modal.output_feedback_set(a, b, c).at(np.ones(5))


C, S = np.cos(np.radians(-20.0)), np.sin(np.radians(-20.0))
VALUES = (0.05, 0.5, 2.0, 8.0)
INPUTS = np.vstack([np.zeros((2, 2)), [[C, S], [-S, C]]])
MEASURED = np.eye(4)[[0, 2, 3]]
FREE = np.nan


def turned_plant(q: float) -> np.ndarray:
    """Return A of x = (e, b, wx, wy): e' = c wx - s wy, b' = s wx + c wy, (wx', wy') = -q b (s, c) + R v."""
    return np.array([[0, 0, C, -S], [0, 0, S, C], [0, -q * S, 0, 0], [0, -q * C, 0, 0]], dtype=float)


def test_the_example() -> None:
    wanted = [[[0.25, 0.0], [0.0, FREE]], np.eye(2)]
    actual = modal.common_feedback([turned_plant(q) for q in VALUES], INPUTS, MEASURED, wanted)
    expected = [[-0.25, -0.93969, -0.34202], [0.0, 0.34202, -0.93969]]
    np.testing.assert_allclose(actual.gain, expected, atol=5e-6)
    assert actual.residual < 1e-14
    np.testing.assert_allclose(actual.coefficients[:, 0, 1, 1], VALUES, rtol=1e-12)
    for q, loop in zip(VALUES, actual.loops, strict=True):
        # (s^2 + s + 1/4)(s^2 + s + q), the first with a double root
        closed = turned_plant(q) + INPUTS @ actual.gain @ MEASURED
        np.testing.assert_allclose(np.poly(closed), np.convolve([1, 1, 0.25], [1, 1, q]), atol=1e-14 * (1.0 + q))
        assert pole_error(closed, np.roots(np.convolve([1, 1, 0.25], [1, 1, q]))) < 1e-6
        np.testing.assert_array_equal(loop.closed_loop, closed)


def test_what_the_plants_do_not_let_be_prescribed() -> None:
    wanted = [[[0.25, 0.0], [0.0, 0.5]], np.eye(2)]
    with pytest.raises(
        modal.PlacementError, match=r"no F meets the prescription for all 4 plants: a relative residual of 0.94"
    ) as refused:
        modal.common_feedback([turned_plant(q) for q in VALUES], INPUTS, MEASURED, wanted)
    assert refused.value.reason is modal.Reason.RESIDUAL
    assert refused.value.number == pytest.approx(0.94, abs=0.005)
    # one plant alone lets it
    actual = modal.common_feedback([turned_plant(0.5)], INPUTS, MEASURED, wanted)
    np.testing.assert_allclose(actual.coefficients[0], wanted, atol=1e-13)


def test_plants_that_a_common_feedback_made() -> None:
    """A_k = companion of N_k - B F C in coordinates that leave B and C: then F is found again from some of the N_k."""
    random = np.random.default_rng(2)
    for _ in range(either(50, 6)):
        gain, prescribed = random.normal(size=(2, 3)), random.normal(size=(2, 2, 2))
        c = np.hstack([np.zeros((3, 1)), np.eye(3)]) @ np.linalg.qr(random.normal(size=(4, 4)))[0]
        b = np.vstack([np.zeros((2, 2)), np.eye(2)])
        plants, wanted = [], prescribed.copy()
        for _ in range(3):
            own = prescribed.copy()
            own[0, 1, 1] = random.normal()  # this one differs from plant to plant
            companion = np.block([[np.zeros((2, 2)), np.eye(2)], [-own[0], -own[1]]])
            plants.append(companion - b @ gain @ c)
        wanted[0, 1, 1] = FREE
        actual = modal.common_feedback(plants, b, c, wanted)
        assert actual.residual < 1e-12
        np.testing.assert_allclose(actual.gain, gain, atol=1e-9 * (1.0 + np.max(np.abs(gain))))


@pytest.mark.parametrize(
    ("plants", "wanted", "problem"),
    [
        ([], np.eye(2), "plants: no plant"),
        ([np.eye(4), np.eye(2)], np.zeros((2, 2, 2)), "plants: the plants have 4, 2 states and 2 inputs"),
        ([turned_plant(1.0)], [np.eye(2), [1.0]], "wanted: not an array of numbers; give p matrices"),
        ([turned_plant(1.0)], np.eye(2), r"wanted: has shape \(2, 2\); give shape \(2, 2, 2\)"),
    ],
)
def test_wrong_input_is_one_line(plants: list, wanted: np.ndarray, problem: str) -> None:
    with pytest.raises(ValueError, match=problem):
        modal.common_feedback(plants, INPUTS, MEASURED, wanted)
