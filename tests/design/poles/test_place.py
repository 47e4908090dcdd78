"""Public interface of state feedback: choice of method, sign, and one line per error."""

from __future__ import annotations

import pickle

import control
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm
from scipy.signal import place_poles

import perilune
from perilune import modal
from perilune.common.errors import InputError
from tests.support.lengths import either
from tests.support.modal.draws import assert_placed, pole_error, random_systems

METHODS = ("ackermann", "bass_gura", "indices", "multilevel")


@pytest.mark.parametrize("method", METHODS)
def test_the_sign_is_that_of_scipy_and_python_control(method: str) -> None:
    for a, b, _, poles in random_systems(either(20, 4), 4, 1, most_pairs=0, seed=21):
        actual = modal.place(a, b, poles, method=method)
        assert (actual.method, actual.gain.shape) == (method, (1, 4))
        for other in (place_poles(a, b, poles.real).gain_matrix, control.place(a, b, poles.real)):
            np.testing.assert_allclose(actual.gain, other, rtol=1e-6)


def test_the_method_that_applies() -> None:
    a, b, _, _ = next(random_systems(1, 6, 3))
    real, pairs = [-1, -2, -3, -4, -5, -6], [-1 + 1j, -1 - 1j, -2 + 1j, -2 - 1j, -3 + 1j, -3 - 1j]
    assert modal.place(a, b, real).method == "multilevel"
    assert modal.place(a, b, pairs).method == "indices"
    assert modal.place(a, b, pairs, choice="least_condition", starts=1).method == "multilevel"
    assert modal.place(a, b[:, :1], pairs).method == "indices"


@given(st.integers(2, 6), st.integers(1, 4), st.integers(0, 2**32 - 1))
@settings(max_examples=either(300, 13))
def test_any_sizes(states: int, inputs: int, seed: int) -> None:
    a, b, _, poles = next(random_systems(1, states, inputs, seed=seed))
    actual = modal.place(a, b, poles)
    assert_placed(a - b @ actual.gain, poles)
    assert actual.error == pytest.approx(pole_error(actual.closed_loop, poles))
    assert actual.norm == pytest.approx(np.linalg.svd(actual.gain, compute_uv=False)[0])


def test_sampled_plants_and_deadbeat() -> None:
    a, b, _, _ = next(random_systems(1, 4, 2))
    sampled = expm(0.1 * a)
    actual = modal.place(sampled, b, [0.0] * 4)
    assert np.linalg.norm(np.linalg.matrix_power(sampled - b @ actual.gain, len(actual.levels)), 2) < 1e-10


def test_levels_in_the_coordinates_that_are_given() -> None:
    """Angles and rates of a rigid body: z = rates - N angles, angles' = S1 angles + z, z' = S0 z."""
    random = np.random.default_rng(1)
    inertia = np.eye(3) + 0.1 * random.normal(size=(3, 3))
    a = np.block([[0.1 * random.normal(size=(3, 3)), np.eye(3)], [random.normal(size=(3, 6))]])
    b = np.vstack([np.zeros((3, 3)), inertia])
    one, two = -np.diag([0.1, 0.2, 0.3]), np.array([[-1.0, 0.5, 0.0], [-0.5, -1.0, 0.0], [0.0, 0.0, -2.0]])
    actual = modal.place_levels(a, b, [two, one], bases=[np.eye(6)[:, 3:], np.eye(6)[:, :3]])
    to_z = np.block([[np.eye(3), np.zeros((3, 3))], [a[:3, :3] - one, np.eye(3)]])
    expected = np.block([[one, np.eye(3)], [np.zeros((3, 3)), two]])
    np.testing.assert_allclose(to_z @ (a - b @ actual.gain) @ np.linalg.inv(to_z), expected, atol=1e-13)
    assert pole_error(actual.closed_loop, actual.wanted) < 1e-12


def test_levels_without_bases_have_the_spectra() -> None:
    a, b, _, _ = next(random_systems(1, 5, 2))
    desired = [np.array([[-1.0, 2.0], [-2.0, -1.0]]), np.diag([-3.0, -4.0]), [[-5.0]]]
    actual = modal.place_levels(a, b, desired)
    assert_placed(a - b @ actual.gain, np.array([-1 + 2j, -1 - 2j, -3, -4, -5]))


def test_the_set_of_all_gains() -> None:
    a, b, _, poles = next(random_systems(1, 6, 2))
    actual = modal.place(a, b, poles)
    coefficients = modal.polynomial_of_gain(a, b, actual.gain)
    assert coefficients.shape == (3, 2, 2)
    repeated = modal.place_polynomial(a, b, coefficients)
    np.testing.assert_allclose(repeated.gain, actual.gain, atol=1e-10 * actual.norm)


SYSTEM = ([[0.0, 1.0], [0.0, 0.0]], [[0.0], [1.0]], [-1.0, -2.0])


@pytest.mark.parametrize(
    ("arguments", "options", "line"),
    [
        (([[0.0, 1.0]], *SYSTEM[1:]), {}, "modal: A: is 1 by 2; give a square matrix, n by n"),
        (([0.0, 1.0], *SYSTEM[1:]), {}, "modal: A: has 1 dimensions; give a matrix, a list of rows"),
        (([[0.0, 1.0], [0.0]], *SYSTEM[1:]), {}, "modal: A: has rows of different lengths; give rows of equal length"),
        (([[0.0, 1j], [0.0, 0.0]], *SYSTEM[1:]), {}, "modal: A: has elements of type complex128; give real numbers"),
        (
            ([[0.0, np.inf], [0.0, 0.0]], *SYSTEM[1:]),
            {},
            "modal: A: has an element that is not finite; give finite numbers",
        ),
        (
            (SYSTEM[0], [[1.0]], SYSTEM[2]),
            {},
            "modal: B: is 1 by 1, but A has 2 states; give one row per state",
        ),
        (
            (*SYSTEM[:2], [-1.0]),
            {},
            "modal: poles: 1 poles; give 2 poles, with each repeated pole listed as often as it occurs",
        ),
        ((*SYSTEM[:2], [-1.0, 2j]), {}, "modal: poles: 0+2j lacks its conjugate; also give 0-2j"),
        (
            SYSTEM,
            {"method": "akkerman"},
            "modal: method 'akkerman': unknown; use one of ackermann, bass_gura, indices, multilevel",
        ),
        (
            SYSTEM,
            {"choice": "best"},
            "modal: choice 'best': unknown; use one of diagonal, least_condition, least_norm",
        ),
        (
            SYSTEM,
            {"choice": "least_norm", "method": "indices"},
            "modal: choice 'least_norm': method indices has no such option; use method multilevel",
        ),
        (SYSTEM, {"choice": "least_norm", "starts": 0}, "modal: starts: 0 starts; give 1 or more"),
        (SYSTEM, {"tolerance": 0.0}, "modal: tolerance: 0 is not between 0 and 1; give a number in between"),
        (
            SYSTEM,
            {"tolerance": 1e-6, "method": "ackermann"},
            "modal: tolerance: method ackermann has no such option; use method indices or multilevel",
        ),
    ],
)
def test_wrong_input_is_one_line(arguments: tuple, options: dict, line: str) -> None:
    with pytest.raises(InputError) as wrong:
        modal.place(*arguments, **options)
    assert str(wrong.value) == line


def test_wrong_levels_are_one_line() -> None:
    a, b, eye = np.eye(4, k=2), np.eye(4)[:, 2:], np.eye(4)
    desired = [-np.eye(2), -np.eye(2)]
    for matrices, bases, problem in (
        (desired[:1], None, "give one square matrix for each level, of orders 2, 2"),
        ([-np.eye(2), [[-1.0]]], None, r"matrices\[1\]: is 1 by 1; give 2 by 2 numbers"),
        (desired, [eye[:, 2:], eye[:, 2:]], "together they are not an orthonormal basis"),
        (desired, [eye[:, 2:], eye[:, :1]], "together they are not an orthonormal basis"),
        (desired, [eye[:, 2:], 2.0 * eye[:, :2]], "together they are not an orthonormal basis"),
        (
            desired,
            [eye[:, :2], eye[:, 2:]],
            "the basis of level 0 does not span the directions that the inputs drive: a fraction 1 of",
        ),
        (desired, [eye[:, 3:], eye[:, :3]], "the basis of level 0 has 1 columns, but the level has rank 2"),
    ):
        with pytest.raises(InputError, match=problem):
            modal.place_levels(a, b, matrices, bases=bases)


def test_refusals_say_a_number_and_survive_pickling() -> None:
    with pytest.raises(modal.PlacementError, match="the largest singular value of the input matrix is") as refused:
        modal.place(np.diag([1.0, 2.0, 3.0]), [[1.0], [1.0], [0.0]], [-1.0, -2.0, -3.0])
    repeated = pickle.loads(pickle.dumps(refused.value))
    assert (repeated.reason, repeated.number, str(repeated)) == (
        modal.Reason.NOT_CONTROLLABLE,
        refused.value.number,
        str(refused.value),
    )
    assert "\n" not in str(repeated)


def test_the_result_in_a_line() -> None:
    actual = modal.place(*SYSTEM)
    assert actual.text().startswith("multilevel: |K| 3.606, kappa")
    assert actual.text().endswith("levels 1 | 1")
    assert "cond(U) 1" in modal.place(*SYSTEM, method="ackermann").text()
    assert perilune.modal is modal
