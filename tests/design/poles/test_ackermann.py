"""Generalised Ackermann and Bass-Gura formulas: poles, characteristic polynomials, all gains. Truth: numpy."""

from __future__ import annotations

import control
import numpy as np
import pytest

from perilune.analysis.design.poles.ackermann import ackermann, ackermann_of, bass_gura, coefficients_of, last_rows
from perilune.analysis.design.poles.place import place
from perilune.analysis.design.poles.polynomial import block_companion, make_polynomial, polynomial_of_solvents
from perilune.analysis.design.poles.results import PlacementError, Reason
from perilune.analysis.design.poles.spectrum import Spectrum
from tests.support.lengths import either
from tests.support.modal.draws import EPS, assert_placed, pole_error, random_systems

COUNT = either(50, 6)
CLASS = [(4, 1), (4, 2), (6, 2), (6, 3), (8, 2), (8, 4)]


def determinant(coefficients: np.ndarray) -> np.ndarray:
    """Return characteristic polynomial of I s^p + .. + N_0, highest power first, from values on a circle."""
    blocks, size, _ = coefficients.shape
    order = blocks * size
    circle = np.exp(2j * np.pi * np.arange(order + 1) / (order + 1))
    powers = circle[:, None] ** np.arange(blocks)
    values = np.tensordot(powers, coefficients, axes=1) + circle[:, None, None] ** blocks * np.eye(size)
    return (np.fft.fft(np.linalg.det(values)) / (order + 1)).real[::-1]


@pytest.mark.parametrize(("states", "inputs"), CLASS)
def test_places_every_draw(states: int, inputs: int) -> None:
    for a, b, _, poles in random_systems(COUNT, states, inputs):
        actual = ackermann(a, b, Spectrum.of(poles, states))
        assert_placed(a - b @ actual.gain, poles)
        assert actual.condition_u == pytest.approx(
            np.linalg.cond(control.ctrb(a, b)[:, :states]), rel=1e-6 * max(1.0, 1e-9 * actual.condition_u)
        )


@pytest.mark.parametrize(("states", "inputs"), [pair for pair in CLASS if pair[0] <= 6])
def test_the_characteristic_polynomial_is_that_of_phi(states: int, inputs: int) -> None:
    random = np.random.default_rng(states)
    for a, b, _, _ in random_systems(COUNT, states, inputs, seed=1):
        coefficients = random.normal(size=(states // inputs, inputs, inputs))
        actual = ackermann_of(a, b, coefficients)
        desired = determinant(coefficients)
        closed = a - b @ actual.gain  # its rounding, and that of the gain, go into its polynomial
        error = np.max(np.abs(np.poly(closed) - desired)) / np.max(np.abs(desired))
        assert error < 1e-13 * actual.condition_u * max(1.0, np.linalg.norm(closed, 2))
        assert pole_error(block_companion(coefficients), np.roots(desired)) < 1e-6


@pytest.mark.parametrize(("states", "inputs"), CLASS)
def test_the_set_contains_every_gain(states: int, inputs: int) -> None:
    random = np.random.default_rng(states)
    for a, b, _, _ in random_systems(either(50, 3), states, inputs, seed=2):
        gain = random.normal(size=(inputs, states))
        repeated = ackermann_of(a, b, coefficients_of(a, b, gain))
        assert np.max(np.abs(repeated.gain - gain)) < 1e-12 * repeated.condition_u * np.max(np.abs(gain))


@pytest.mark.parametrize(("blocks", "inputs"), [(1, 3), (2, 2), (3, 2), (2, 3), (4, 1)])
def test_solvents_give_the_union_of_their_spectra(blocks: int, inputs: int) -> None:
    random = np.random.default_rng(blocks)
    solvents = random.normal(size=(blocks, inputs, inputs))
    coefficients = polynomial_of_solvents(solvents)
    poles = np.linalg.eigvals(solvents).ravel()
    assert pole_error(block_companion(coefficients), poles) < 1e-6  # eigenvalues may be close
    a, b, _, _ = next(random_systems(1, blocks * inputs, inputs))
    assert_placed(a - b @ ackermann_of(a, b, coefficients).gain, poles)
    # S_1 is a right solvent: Phi(S_1) = 0
    powers = [np.linalg.matrix_power(solvents[0], i) for i in range(blocks + 1)]
    value = powers[-1] + sum(n @ power for n, power in zip(coefficients, powers, strict=False))
    assert np.max(np.abs(value)) < 1e-12 * np.max(np.abs(powers[-1]))


def test_diagonal_solvents_are_the_choice_for_real_poles() -> None:
    spectrum = Spectrum.of([-1.0, -2.0, -3.0, -4.0], 4)
    np.testing.assert_allclose(
        make_polynomial(spectrum, [2, 2]), polynomial_of_solvents([np.diag([-2.0, -1.0]), np.diag([-4.0, -3.0])])
    )


@pytest.mark.parametrize("degrees", [(3, 3), (1, 1, 2), (3, 1, 1, 3), (5, 1)])
def test_pairs_that_lie_across(degrees: tuple[int, ...]) -> None:
    """As many pairs as there can be, through the controllable canonical form with these indices."""
    size = sum(degrees)
    poles = np.array([complex(-1.0 - i, s * (0.5 + i)) for i in range(size // 2) for s in (1, -1)])
    coefficients = make_polynomial(Spectrum.of(poles, size), degrees)
    loop, start = np.eye(size, k=1), np.cumsum([0, *degrees])
    for i in range(len(degrees)):
        row = start[i + 1] - 1
        loop[row] = 0.0
        for j, degree in enumerate(degrees):
            loop[row, start[j] : start[j + 1]] = -coefficients[:degree, i, j]
            assert not np.any(coefficients[degree:, i, j])
    assert pole_error(loop, poles) < 1e-9


def test_one_input_agrees_with_python_control() -> None:
    for a, b, _, poles in random_systems(either(50, 6), 4, 1, seed=3):
        actual = ackermann(a, b, Spectrum.of(poles, 4))
        expected = control.acker(a, b, poles).reshape(1, 4)
        np.testing.assert_allclose(actual.gain, expected, rtol=1e-12 * actual.condition_u)


def test_what_it_refuses() -> None:
    with pytest.raises(PlacementError, match="states, 5, is not a multiple of the number of inputs, 2") as refused:
        last_rows(np.eye(5), np.ones((5, 2)))
    assert (refused.value.reason, refused.value.number) == (Reason.CLASS, 2.5)
    # controllable with indices 3, 1 and not 2, 2
    chain = np.eye(4, k=1)
    chain[2, 3] = 0.0
    inputs = np.eye(4)[:, [2, 3]]
    with pytest.raises(PlacementError, match="singular") as refused:
        last_rows(chain, inputs)
    assert refused.value.reason is Reason.CLASS
    assert refused.value.number > 1e15


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
        own, desired = np.poly(a)[1:], np.poly(poles).real[1:]
        toeplitz = np.eye(4) + sum(own[i] * np.eye(4, k=i + 1) for i in range(3))
        controllability = np.hstack([np.linalg.matrix_power(a, i) @ b for i in range(4)])
        expected = (desired - own) @ np.linalg.inv(controllability @ toeplitz)
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
