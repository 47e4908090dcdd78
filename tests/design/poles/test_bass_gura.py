"""Generalised Bass-Gura formula: poles, and the gain of the Ackermann formula."""

from __future__ import annotations

import numpy as np
import pytest

from perilune.analysis.design.poles.ackermann import ackermann
from perilune.analysis.design.poles.bass_gura import bass_gura
from perilune.analysis.design.poles.place import place
from perilune.analysis.design.poles.refusal import PlacementError
from perilune.analysis.design.poles.spectrum import Spectrum
from tests.support.lengths import either
from tests.support.modal.draws import EPS, assert_placed, random_systems


@pytest.mark.parametrize(("states", "inputs"), [(4, 1), (4, 2), (6, 2), (6, 3), (8, 2), (8, 4)])
def test_places_every_draw_with_ackermanns_gain(states: int, inputs: int) -> None:
    for a, b, _, poles in random_systems(either(50, 6), states, inputs, seed=4):
        spectrum = Spectrum.of(poles, states)
        actual, other = bass_gura(a, b, spectrum), ackermann(a, b, spectrum)
        assert_placed(a - b @ actual.gain, poles)
        assert np.linalg.norm(actual.gain - other.gain) <= 100.0 * EPS * other.condition_u * np.linalg.norm(other.gain)


def test_one_input_is_the_formula_of_the_textbook() -> None:
    """k = (alpha - a) (U W)^-1, W the upper triangular Toeplitz matrix of the open loop's coefficients."""
    for a, b, _, poles in random_systems(either(50, 6), 4, 1, seed=5):
        own, wanted = np.poly(a)[1:], np.poly(poles).real[1:]
        toeplitz = np.eye(4) + sum(own[i] * np.eye(4, k=i + 1) for i in range(3))
        controllability = np.hstack([np.linalg.matrix_power(a, i) @ b for i in range(4)])
        expected = (wanted - own) @ np.linalg.inv(controllability @ toeplitz)
        actual = bass_gura(a, b, Spectrum.of(poles, 4))
        np.testing.assert_allclose(actual.gain[0], expected, rtol=1e-12 * actual.condition_u)


@pytest.mark.parametrize("plant", [(np.eye(5), np.eye(5)[:, :2]), (np.eye(4), np.eye(4)[:, :2])])
@pytest.mark.parametrize(("method", "formula"), [("bass_gura", "Bass-Gura"), ("ackermann", "Ackermann")])
def test_a_refusal_names_the_formula_that_was_chosen(plant, method: str, formula: str) -> None:
    """n no multiple of m, and U singular: both formulas need the same of a plant, and each says it by its own name."""
    a, b = plant
    with pytest.raises(PlacementError) as refused:
        place(a, b, -np.arange(1.0, len(a) + 1.0), method=method)
    assert refused.value.file == f"generalised {formula}"
