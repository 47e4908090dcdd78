"""Output feedback for m + p > n: poles, all distributions, both methods, refusals. Truth: numpy's eigenvalues."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import block_diag

from perilune import modal
from perilune.analysis.design.poles.spectrum import Spectrum
from perilune.common.errors import InputError
from tests.support.lengths import LONG, either
from tests.support.modal.draws import assert_placed, random_spectrum, random_systems

COUNT = either(50, 6)
DIMENSIONS = [(4, 2, 3), (4, 3, 2), (5, 3, 3), (5, 2, 4), (6, 3, 4), (6, 4, 3)]


@pytest.mark.parametrize("method", ["direct", "dual"])
@pytest.mark.parametrize(("states", "inputs", "outputs"), DIMENSIONS)
def test_places_every_draw(states: int, inputs: int, outputs: int, method: str) -> None:
    """Pairs as many as split over the levels: all, but for one real pole on each of two levels of odd size."""
    upper = states - (inputs if method == "direct" else outputs)
    maximum = (upper // 2) + ((states - upper) // 2)
    for a, b, c, poles in random_systems(COUNT, states, inputs, outputs, most_pairs=maximum, seed=25):
        actual = modal.output_feedback(a, b, c, poles, method=method)
        assert (actual.method, actual.gain.shape, len(actual.upper)) == (method, (inputs, outputs), upper)
        assert_placed(a + b @ actual.gain @ c, poles, actual.condition_x)
        np.testing.assert_array_equal(actual.closed_loop.shape, (states, states))
        np.testing.assert_allclose(
            actual.closed_loop, a + b @ actual.gain @ c, atol=1e-12 * np.max(np.abs(actual.gain))
        )


def test_every_pole_on_every_level() -> None:
    a, b, c, poles = next(random_systems(1, 5, 3, 3, most_pairs=0, seed=26))
    for upper, lower in Spectrum.of(poles, 5).splits(2):
        actual = modal.output_feedback(a, b, c, poles, method="direct", upper=upper.poles)
        assert_placed(a + b @ actual.gain @ c, poles, actual.condition_x)
        # the poles of the upper level stay when level 0 is closed with others
        other = modal.output_feedback(a, b, c, [*upper.poles, *(lower.poles - 3.0)], method="direct", upper=upper.poles)
        shared = np.linalg.eigvals(a + b @ other.gain @ c)
        assert all(np.min(np.abs(shared - pole)) < 1e-6 for pole in upper.poles)


def test_least_norm_is_the_least_of_all_spreads() -> None:
    norms = []
    for a, b, c, poles in random_systems(either(30, 2), 6, 3, 4, most_pairs=0, seed=27):
        spectrum = Spectrum.of(poles, 6)
        tried = [
            modal.output_feedback(a, b, c, poles, method=method, upper=upper.poles).norm
            for method, size in (("direct", 3), ("dual", 2))
            for upper, _ in spectrum.splits(size)
        ]
        assert len(tried) == 20 + 15
        actual = modal.output_feedback(a, b, c, poles, choice="least_norm")
        assert actual.norm == min(tried)
        assert_placed(a + b @ actual.gain @ c, poles, actual.condition_x)
        direct = modal.output_feedback(a, b, c, poles, choice="least_norm", method="direct")
        assert direct.norm == min(tried[:20])
        norms.append((tried[0], direct.norm, actual.norm))
    if LONG:
        first, direct, both = np.median(norms, axis=0)
        assert both <= direct < first


def test_measuring_every_state_is_state_feedback() -> None:
    for a, b, c, poles in random_systems(COUNT, 4, 2, 4, seed=28):
        actual = modal.output_feedback(a, b, c, poles)
        assert_placed(a + b @ actual.gain @ c, poles)
        assert actual.condition_x == 1.0
        dual = modal.output_feedback(a.T, c.T, b.T, poles)
        assert_placed(a.T + c.T @ dual.gain @ b.T, poles)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=either(100, 8))
def test_the_dual_of_the_transposed_plant_is_the_direct_route(seed: int) -> None:
    random = np.random.default_rng(seed)
    a, b, c, poles = next(random_systems(1, 5, 3, 3, most_pairs=1, seed=seed))
    one = modal.output_feedback(a, b, c, poles, method="direct")
    other = modal.output_feedback(a.T, c.T, b.T, poles, method="dual")
    np.testing.assert_array_equal(one.gain, other.gain.T)
    # F does not depend on the coordinates of the state
    turn = np.linalg.qr(random.normal(size=(5, 5)))[0]
    turned = modal.output_feedback(turn.T @ a @ turn, turn.T @ b, c @ turn, poles, choice="least_norm")
    same = modal.output_feedback(a, b, c, poles, choice="least_norm")
    assert turned.norm == pytest.approx(same.norm, rel=1e-6)


def test_repeated_poles() -> None:
    for a, b, c, _ in random_systems(COUNT, 5, 3, 4, seed=29):
        actual = modal.output_feedback(a, b, c, [-1.0] * 5)
        loop = a + b @ actual.gain @ c
        # index of the pole: levels of (A_1, B_1), and those of (Y X^+, Q)
        left = np.linalg.matrix_power(loop + np.eye(5), 5)
        assert np.linalg.norm(left, 2) < 1e-13 * max(1.0, actual.condition_x) * np.linalg.norm(loop, 2) ** 5


def test_what_it_refuses() -> None:
    a, b, c, poles = next(random_systems(1, 6, 3, 4, most_pairs=0))
    for arguments, reason, problem in (
        (
            (a, b[:, :2], c[:3], poles),
            modal.Reason.CLASS,
            r"n = 6 states, m = 2 inputs, p = 3 outputs: m \+ p = 5 must not be less than n",
        ),
        (
            (a[:2, :2], b[:2, :1], c[:1, :2], [-1, -2]),
            modal.Reason.CLASS,
            r"F has m p = 1 elements, too few to place n poles",
        ),
        ((a, b[:, [0, 1, 1]], c, poles), modal.Reason.RANK, "B does not have full rank"),
        ((a, b, c[[0, 1, 2, 2]], poles), modal.Reason.RANK, "C does not have full rank"),
    ):
        with pytest.raises(modal.PlacementError, match=problem) as refused:
            modal.output_feedback(*arguments)
        assert refused.value.reason is reason
    pairs = [-1 + 1j, -1 - 1j, -2 + 1j, -2 - 1j, -3 + 1j, -3 - 1j]
    with pytest.raises(modal.PlacementError, match="cannot be distributed over the levels without splitting a pair"):
        modal.output_feedback(a, b, c, pairs, method="direct")
    actual = modal.output_feedback(a, b, c, pairs)
    assert actual.method == "dual"
    assert_placed(a + b @ actual.gain @ c, pairs, actual.condition_x)


def test_plants_with_modes_out_of_reach() -> None:
    a, b, c, _ = next(random_systems(1, 4, 2, 4))
    apart = block_diag(a, [[-7.0]])
    poles = [-1.0, -2.0, -3.0, -4.0, -5.0]
    with pytest.raises(modal.PlacementError, match="not controllable") as refused:
        modal.output_feedback(apart, np.vstack([b, np.zeros((1, 2))]), np.eye(5)[:4], poles, method="direct")
    assert refused.value.number < 1e-12
    observed = np.hstack([c, np.zeros((4, 1))])
    with pytest.raises(modal.PlacementError, match=r"not observable|X does not have full column rank"):
        modal.output_feedback(apart, np.vstack([b, np.ones((1, 2))]), observed, poles, method="direct")


@pytest.mark.parametrize(
    ("options", "line"),
    [
        ({"method": "both"}, "modal: method 'both': unknown; use one of direct, dual"),
        (
            {"choice": "best"},
            "modal: choice 'best': unknown; use one of first, least_norm, smallest",
        ),
        (
            {"upper": [-1.0, -2.0]},
            "modal: upper: the number of upper poles depends on the method; give method direct or dual",
        ),
        ({"starts": 0}, "modal: starts: 0 starts; give 1 or more"),
        (
            {"upper": [-9.0], "method": "direct"},
            "modal: upper: 1 poles; give 2 poles, with each repeated pole listed as often as it occurs",
        ),
        (
            {"upper": [-9.0, -1.0], "method": "direct"},
            "modal: upper: -9 is not one of the poles; choose the upper poles among the poles",
        ),
    ],
)
def test_wrong_input_is_one_line(options: dict, line: str) -> None:
    a, b, c, _ = next(random_systems(1, 4, 2, 3))
    with pytest.raises(InputError) as wrong:
        modal.output_feedback(a, b, c, [-1.0, -2.0, -3.0, -4.0], **options)
    assert str(wrong.value) == line


def test_random_spectra_of_the_specification() -> None:
    poles = random_spectrum(np.random.default_rng(0), 8, 2)
    apart = np.abs(poles[:, None] - poles[None, :])[~np.eye(8, dtype=bool)]
    assert np.min(apart) >= 0.2
    assert np.sum(poles.imag > 0.0) == 2
