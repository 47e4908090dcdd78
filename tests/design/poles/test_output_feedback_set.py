"""The set of all output feedbacks: it has m p numbers, and contains every feedback found otherwise."""

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
    with pytest.raises(modal.PlacementError, match="n/m = 5/2"):
        modal.output_feedback_set(a, b, c)
    a, b, c, _ = next(random_systems(1, 4, 2, 3))
    with pytest.raises(modal.PlacementError, match="C of 3 rows has rank 2") as refused:
        modal.output_feedback_set(a, b, c[[0, 1, 1]])
    assert refused.value.number == 2
    with pytest.raises(ValueError, match="modal: z: it is 5; give 6 numbers"):
        modal.output_feedback_set(a, b, c).at(np.ones(5))
