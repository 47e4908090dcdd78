"""Least condition and least gain. Truth: known bounds, and scipy's place_poles."""

from __future__ import annotations

import warnings
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import approx_fprime
from scipy.signal import place_poles

from perilune.analysis.design.poles.controllability import indices
from perilune.analysis.design.poles.freedom import (
    condition,
    family_of,
    gain_norm,
    least_condition,
    least_norm,
    on_levels,
)
from perilune.analysis.design.poles.multilevel import multilevel
from perilune.analysis.design.poles.results import PlacementError, Reason
from perilune.analysis.design.poles.spectrum import Spectrum
from tests.support.lengths import LONG, either
from tests.support.modal.draws import assert_placed, kappa_of, random_spectrum, random_systems

STARTS = 8


def yang_and_tits(a: np.ndarray, b: np.ndarray, poles: np.ndarray) -> np.ndarray:
    """Return K of scipy's place_poles as it is, which warns where it has not converged."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return place_poles(a, b, poles).gain_matrix


@given(st.sampled_from([(4, 2, 1), (6, 3, 3), (5, 2, 0), (3, 3, 1)]), st.integers(0, 2**32 - 1))
@settings(max_examples=either(100, 8))
def test_every_member_of_the_family_is_a_closed_loop(case: tuple[int, int, int], seed: int) -> None:
    states, inputs, pairs = case
    random = np.random.default_rng(seed)
    a, b = random.normal(size=(states, states)), random.normal(size=(states, inputs))
    poles = random_spectrum(random, states, pairs)
    _, family = family_of(a, b, Spectrum.of(poles, states))
    vectors = family.at(random.normal(size=family.parameters))
    gain = family.gain(vectors)
    size = np.linalg.norm(vectors, 2) * np.linalg.norm(a + b @ gain, 2)
    assert np.linalg.norm((a + b @ gain) @ vectors - vectors @ family.matrix, 2) < 1e-11 * size
    # of the real matrix and of the unit eigenvectors
    assert np.linalg.cond(vectors) == pytest.approx(kappa_of(a + b @ gain), rel=1e-6)
    joint, actual = family.as_complex(vectors)
    np.testing.assert_allclose(np.linalg.norm(joint, axis=0), 1.0, rtol=1e-12)
    assert sorted(actual, key=lambda pole: (pole.real, pole.imag)) == pytest.approx(
        sorted(poles, key=lambda pole: (pole.real, pole.imag))
    )


@pytest.mark.parametrize("order", [2.0, 16.0, 128.0])
def test_gradients(order: float) -> None:
    for seed, (a, b, _, poles) in enumerate(random_systems(either(20, 4), 6, 3, seed=12)):
        _, family = family_of(a, b, Spectrum.of(poles, 6))
        free = np.random.default_rng(seed).normal(size=family.parameters)
        for objective in (condition, partial(gain_norm, family)):
            by_vectors = objective(family.at(free), order)[1]
            expected = approx_fprime(free, lambda at, f=objective, v=family: f(v.at(at), order)[0], 1e-7)
            np.testing.assert_allclose(family.slope(free, by_vectors), expected, atol=3e-6 * np.max(np.abs(expected)))


def test_as_many_inputs_as_states_give_orthogonal_eigenvectors() -> None:
    for a, b, _, poles in random_systems(either(20, 3), 4, 4, seed=13):
        actual = least_condition(a, b, Spectrum.of(poles, 4), STARTS, 0)
        assert actual.kappa == pytest.approx(1.0, abs=1e-5)
        assert_placed(a - b @ actual.gain, poles)


def test_the_least_gain_that_shifts_a_spectrum() -> None:
    """B = I: |K| is at least |tr K|/n, which K = shift I reaches."""
    for a, _, _, _ in random_systems(either(20, 2), 4, 4, seed=14):
        poles = np.linalg.eigvals(a) - 3.0
        actual = least_norm(a, np.eye(4), Spectrum.of(poles, 4), STARTS, 0)
        assert 3.0 * (1.0 - 1e-12) <= actual.norm < 3.0 * 1.02
        assert_placed(a - actual.gain, poles)


@pytest.mark.parametrize(
    ("states", "inputs", "count"), [(4, 2, either(100, 5)), (6, 2, either(20, 4)), (6, 3, either(20, 2))]
)
def test_least_condition_is_below_place_poles(states: int, inputs: int, count: int) -> None:
    ratios = []
    for a, b, _, poles in random_systems(count, states, inputs, most_pairs=0, seed=15):
        actual = least_condition(a, b, Spectrum.of(poles, states), STARTS, 0)
        assert_placed(a - b @ actual.gain, poles)
        ratios.append(actual.kappa / kappa_of(a - b @ yang_and_tits(a, b, poles.real)))
    assert max(ratios) < 1.001
    if LONG:  # single systems say nothing about a median
        assert np.median(ratios) <= 0.8


@pytest.mark.parametrize(("states", "inputs", "count"), [(4, 2, 3), (6, 2, 1), (6, 3, 1)])
def test_least_gain_is_below_the_others(states: int, inputs: int, count: int) -> None:
    norms = []
    for a, b, _, poles in random_systems(either(20, count), states, inputs, most_pairs=0, seed=16):
        spectrum = Spectrum.of(poles, states)
        actual, diagonal = least_norm(a, b, spectrum, STARTS, 0), multilevel(a, b, spectrum)
        assert_placed(a - b @ actual.gain, poles)
        norms.append((actual.norm, diagonal.norm, np.linalg.norm(yang_and_tits(a, b, poles.real), 2)))
        assert actual.norm <= min(norms[-1][1:])
    if LONG:
        minimum, diagonal, yang = np.median(norms, axis=0)
        assert minimum < 0.5 * diagonal
        assert minimum < 0.55 * yang


@pytest.mark.parametrize("search", [least_condition, least_norm])
def test_pairs_that_fit_on_no_level_are_placed_all_the_same(search) -> None:
    for a, b, _, _ in random_systems(either(10, 2), 6, 3, seed=17):
        poles = [-1 + 1j, -1 - 1j, -2 + 1j, -2 - 1j, -3 + 1j, -3 - 1j]
        assert_placed(a - b @ search(a, b, Spectrum.of(poles, 6), 3, 0).gain, poles)


@pytest.mark.parametrize("search", [least_condition, least_norm])
def test_one_input_leaves_no_choice(search) -> None:
    for a, b, _, poles in random_systems(either(20, 4), 4, 1, seed=18):
        spectrum = Spectrum.of(poles, 4)
        other = indices(a, b, spectrum)
        actual = search(a, b, spectrum, 1, 0)
        assert_placed(a - b @ actual.gain, poles)
        np.testing.assert_allclose(actual.gain, other.gain, atol=1e-11 * other.condition_u * other.norm)


def test_repeated_poles() -> None:
    a, b, _, _ = next(random_systems(1, 4, 2, seed=19))
    poles = [-1.0, -1.0, -2.0, -3.0]
    actual = least_condition(a, b, Spectrum.of(poles, 4), STARTS, 0)
    loop = a - b @ actual.gain
    assert np.linalg.matrix_rank(loop + np.eye(4), 1e-9) == 2  # a full set of eigenvectors
    with pytest.raises(PlacementError, match="occurs 3 times, but B has rank 2") as refused:
        least_condition(a, b, Spectrum.of([-1.0, -1.0, -1.0, -3.0], 4), STARTS, 0)
    assert (refused.value.reason, refused.value.number) == (Reason.RANK, 3.0)


@pytest.mark.parametrize("search", [least_condition, least_norm])
def test_the_same_seed_gives_the_same_bits(search) -> None:
    a, b, _, poles = next(random_systems(1, 4, 2, seed=20))
    spectrum = Spectrum.of(poles, 4)
    np.testing.assert_array_equal(search(a, b, spectrum, 2, 5).gain, search(a, b, spectrum, 2, 5).gain)


@pytest.mark.parametrize(("states", "inputs"), [(4, 2), (5, 2), (3, 2), (7, 3), (6, 4)])
def test_the_levels_keep_the_eigenvectors(states: int, inputs: int) -> None:
    """K is that of the eigenvectors, also where a level has more inputs than its rank."""
    random = np.random.default_rng(13)
    for a, b, _, poles in random_systems(5, states, inputs, most_pairs=1, seed=19):
        levels, family = family_of(a, b, Spectrum.of(poles, states))
        free = random.normal(size=family.parameters)
        vectors = family.at(free)
        expected = family.gain(vectors)
        actual = -on_levels(levels, family, free).gain
        scale = np.abs(expected).max() * np.linalg.cond(vectors)
        np.testing.assert_allclose(actual, expected, rtol=0.0, atol=1e-12 * scale)
