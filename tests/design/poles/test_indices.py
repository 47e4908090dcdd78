"""Placement by controllability indices for any controllable pair."""

from __future__ import annotations

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.analysis.design.poles.controllability import controllability_indices, indices
from perilune.analysis.design.poles.results import PlacementError, Reason
from perilune.analysis.design.poles.spectrum import Spectrum
from tests.support.lengths import either
from tests.support.modal.draws import assert_placed, random_spectrum, random_systems

PAIRS = [(4, 1), (4, 2), (6, 2), (6, 3), (8, 2), (8, 4), (5, 2), (7, 3), (6, 4), (8, 3), (6, 1), (7, 1), (8, 1)]


@pytest.mark.parametrize(("states", "inputs"), PAIRS)
def test_places_every_draw(states: int, inputs: int) -> None:
    for a, b, _, poles in random_systems(either(50, 6), states, inputs, seed=6):
        assert_placed(a - b @ indices(a, b, Spectrum.of(poles, states)).gain, poles)


def brunovsky(lengths: list[int], random: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Draw a pair with these indices, in coordinates, with a feedback and with inputs mixed so that it keeps them.

    Inputs may be mixed among those of the same index, and with later ones of longer chains.
    """
    size, used = sum(lengths), [length for length in lengths if length]
    a, b = np.zeros((size, size)), np.zeros((size, len(lengths)))
    end = 0
    for i, length in enumerate(lengths):
        a[end : end + length, end : end + length] = np.eye(length, k=1)
        end += length
        if length:
            b[end - 1, i] = 1.0
    assert len(used) <= size
    coordinates = np.linalg.qr(random.normal(size=(size, size)))[0]
    closed = a + b @ random.normal(size=(len(lengths), size))
    return coordinates.T @ closed @ coordinates, coordinates.T @ b


@given(st.lists(st.integers(0, 4), min_size=1, max_size=4).filter(any), st.integers(0, 2**32 - 1))
@settings(max_examples=either(300, 13))
def test_indices_and_poles_of_pairs_with_known_indices(lengths: list[int], seed: int) -> None:
    random = np.random.default_rng(seed)
    a, b = brunovsky(lengths, random)
    assert controllability_indices(a, b) == tuple(lengths)
    size = sum(lengths)
    if size <= 8:
        poles = random_spectrum(random, size, int(random.integers(size // 2 + 1)))
        actual = indices(a, b, Spectrum.of(poles, size))
        assert_placed(a - b @ actual.gain, poles)
        unused = [i for i, length in enumerate(lengths) if not length]
        assert not np.any(actual.gain[unused])


def test_an_input_that_another_stands_for_gets_no_gain() -> None:
    a, b, _, poles = next(random_systems(1, 5, 2))
    joint = np.column_stack([b[:, 0], 2.0 * b[:, 0], b[:, 1]])
    assert controllability_indices(a, joint) == (3, 0, 2)
    actual = indices(a, joint, Spectrum.of(poles, 5))
    assert not np.any(actual.gain[1])
    assert_placed(a - joint @ actual.gain, poles)


def test_one_input_agrees_with_python_control() -> None:
    for a, b, _, poles in random_systems(either(50, 6), 5, 1, seed=7):
        actual = indices(a, b, Spectrum.of(poles, 5))
        np.testing.assert_allclose(
            actual.gain[0], np.ravel(control.acker(a, b, poles)), rtol=1e-12 * actual.condition_u
        )


@given(st.integers(1, 3), st.integers(0, 2**32 - 1))
@settings(max_examples=either(100, 8))
def test_refuses_what_is_not_reached(unreached: int, seed: int) -> None:
    random = np.random.default_rng(seed)
    a, b = random.normal(size=(5, 5)), random.normal(size=(5, 2))
    a[5 - unreached :, : 5 - unreached] = b[5 - unreached :] = 0.0
    turn = np.linalg.qr(random.normal(size=(5, 5)))[0]
    with pytest.raises(PlacementError, match=f"{unreached} of 5 states are not controllable") as refused:
        indices(turn.T @ a @ turn, turn.T @ b, Spectrum.of([-1.0] * 5, 5))
    assert refused.value.reason is Reason.NOT_CONTROLLABLE
    assert refused.value.number < 1e-12
