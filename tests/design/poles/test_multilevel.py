"""Multilevel decomposition: poles of any multiplicity, its identity, and refusals."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import block_diag
from scipy.signal import place_poles

from perilune.analysis.design.poles.multilevel import assemble, decompose, multilevel, place_on_levels
from perilune.analysis.design.poles.results import PlacementError, Reason
from perilune.analysis.design.poles.spectrum import Spectrum
from tests.support.lengths import either
from tests.support.modal.draws import assert_placed, random_spectrum, random_systems

COUNT = either(50, 6)
# states, inputs, the most pairs that fit on the levels
PAIRS = [(4, 1, 0), (4, 2, 2), (6, 2, 3), (6, 3, 2), (8, 2, 4), (8, 4, 4), (5, 2, 2), (7, 3, 2), (6, 4, 3), (8, 3, 3)]


@pytest.mark.parametrize(("states", "inputs", "most"), PAIRS)
def test_places_every_draw(states: int, inputs: int, most: int) -> None:
    for a, b, _, poles in random_systems(COUNT, states, inputs, most_pairs=most, seed=8):
        actual = multilevel(a, b, Spectrum.of(poles, states))
        assert_placed(a - b @ actual.gain, poles)
        assert sum(len(values) for values in actual.levels) == states


@pytest.mark.parametrize(("states", "inputs", "most"), PAIRS)
def test_the_identity_of_level_0(states: int, inputs: int, most: int) -> None:
    """B^- (A + B K) = Phi_0 B^-, however badly conditioned the closed loop."""
    for a, b, _, poles in random_systems(COUNT, states, inputs, most_pairs=most, seed=9):
        levels = decompose(a, b)
        parts = Spectrum.of(poles, states).split_by_speed([level.rank for level in levels])
        gain, inverse = assemble(levels, [part.matrix for part in parts])
        closed_loop = a + b @ gain
        left = inverse @ closed_loop - parts[0].matrix @ inverse
        assert np.linalg.norm(left, 2) < 1e-14 * np.linalg.norm(inverse, 2) * np.linalg.norm(closed_loop, 2)


def annihilated(closed_loop: np.ndarray, poles: dict[float, int]) -> float:
    """Return the product of (Ac - lambda I)^k, relative to the power of |Ac| of the same degree."""
    product = np.eye(len(closed_loop))
    for pole, index in poles.items():
        product = product @ np.linalg.matrix_power(closed_loop - pole * np.eye(len(closed_loop)), index)
    return float(np.linalg.norm(product, 2) / np.linalg.norm(closed_loop, 2) ** sum(poles.values()))


@pytest.mark.parametrize(("states", "inputs"), [(4, 2), (6, 2), (6, 3), (5, 2), (7, 3), (8, 3), (3, 1)])
def test_one_pole_of_full_multiplicity(states: int, inputs: int) -> None:
    for a, b, _, _ in random_systems(COUNT, states, inputs, seed=10):
        actual = multilevel(a, b, Spectrum.of([-1.5] * states, states))
        assert annihilated(a - b @ actual.gain, {-1.5: len(actual.levels)}) < 1e-13
        with pytest.raises(ValueError, match="repeated"):
            place_poles(a, b, [-1.5] * states)


@pytest.mark.parametrize(("states", "inputs"), [(6, 2), (6, 3), (8, 4)])
def test_several_repeated_poles(states: int, inputs: int) -> None:
    for a, b, _, _ in random_systems(COUNT, states, inputs, seed=11):
        poles = np.repeat([-1.0, -2.0], states // 2)
        actual = multilevel(a, b, Spectrum.of(poles, states))
        ranks = [len(values) for values in actual.levels]
        on_levels = np.split(np.sort(poles), np.cumsum(ranks)[:-1])  # the fastest first
        index = {pole: sum(pole in level for level in on_levels) for pole in (-1.0, -2.0)}
        assert annihilated(a - b @ actual.gain, index) < 1e-13


def test_levels_drive_each_other_one_way() -> None:
    """Multiples of I: K is unique, whatever the bases, and the levels are those of the chain of integrators."""
    a = np.eye(6, k=2)
    b = np.vstack([np.zeros((4, 2)), np.eye(2)])
    levels = decompose(a, b)
    assert [level.rank for level in levels] == [2, 2, 2]
    actual = place_on_levels(levels, [-3.0 * np.eye(2), -2.0 * np.eye(2), -np.eye(2)], np.repeat([-1.0, -2.0, -3.0], 2))
    # (s + 1)(s + 2)(s + 3) = s^3 + 6 s^2 + 11 s + 6 for each axis
    np.testing.assert_allclose(actual.gain, np.hstack([6.0 * np.eye(2), 11.0 * np.eye(2), 6.0 * np.eye(2)]), atol=1e-12)


@given(st.integers(0, 2**32 - 1), st.integers(-6, 6))
@settings(max_examples=either(200, 8))
def test_units_of_inputs_and_coordinates_do_not_matter(seed: int, decade: int) -> None:
    """Rotated states, and inputs in other units: the same closed loop in the other coordinates."""
    random = np.random.default_rng(seed)
    a, b = random.normal(size=(5, 5)), random.normal(size=(5, 2))
    turn = np.linalg.qr(random.normal(size=(5, 5)))[0]
    spectrum = Spectrum.of(random_spectrum(random, 5, int(random.integers(3))), 5)
    unit = 10.0**decade
    one, other = multilevel(a, b, spectrum), multilevel(turn.T @ a @ turn, unit * turn.T @ b, spectrum)
    np.testing.assert_allclose(unit * other.gain @ turn.T, one.gain, atol=1e-9 * one.kappa * one.norm)


def test_refuses_what_is_not_controllable() -> None:
    a, b, _, poles = next(random_systems(1, 4, 2))
    joint = block_diag(a, [[-1.0]])
    with pytest.raises(PlacementError, match="1 states are not controllable: on level 2") as refused:
        multilevel(joint, np.vstack([b, np.zeros((1, 2))]), Spectrum.of([*poles, -2.0], 5))
    assert refused.value.reason is Reason.NOT_CONTROLLABLE
    assert refused.value.number < 1e-12
    with pytest.raises(PlacementError, match="4 states are not controllable: on level 0 the largest singular value"):
        multilevel(a, np.zeros((4, 2)), Spectrum.of(poles, 4))


def test_what_counts_as_new_is_a_parameter() -> None:
    a, b = np.array([[0.0, 1e-6], [0.0, 0.0]]), np.array([[0.0], [1.0]])
    spectrum = Spectrum.of([-1.0, -2.0], 2)
    actual = multilevel(a + np.diag([1.0, 0.0]), b, spectrum)
    assert actual.levels[1] == pytest.approx([1e-6])
    with pytest.raises(PlacementError) as refused:
        multilevel(a + np.diag([1.0, 0.0]), b, spectrum, 1e-5)
    assert refused.value.number == pytest.approx(1e-6)


def test_pairs_need_room() -> None:
    a, b, _, _ = next(random_systems(1, 6, 3))
    poles = [-1 + 1j, -1 - 1j, -2 + 1j, -2 - 1j, -3 + 1j, -3 - 1j]
    with pytest.raises(
        PlacementError,
        match="3 conjugate pairs cannot be distributed over levels of ranks 3, 3 without",
    ) as refused:
        multilevel(a, b, Spectrum.of(poles, 6))
    assert refused.value.reason is Reason.SPREAD
