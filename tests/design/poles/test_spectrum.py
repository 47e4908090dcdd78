"""Required spectra: validation, real matrices, distribution over levels."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perilune.analysis.design.poles.spectrum import Spectrum, distance
from perilune.common.errors import InputError
from tests.support.lengths import either
from tests.support.modal.draws import pole_error, random_spectrum


@st.composite
def spectra(draw: st.DrawFn) -> Spectrum:
    pairs = draw(st.integers(0, 3))
    size = 2 * pairs + draw(st.integers(0 if pairs else 1, 4))
    random = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    return Spectrum.of(random.permutation(random_spectrum(random, size, pairs)), size)


@given(spectra())
@settings(max_examples=either(50, 12))
def test_matrix_and_polynomial_have_the_poles(spectrum: Spectrum) -> None:
    assert pole_error(spectrum.matrix, spectrum.poles) < 1e-12
    assert spectrum.polynomial[-1] == 1.0
    assert distance(np.roots(spectrum.polynomial[::-1]), spectrum.poles) < 1e-3
    for pole in spectrum.poles:
        terms = spectrum.polynomial * pole ** np.arange(spectrum.size + 1)
        assert abs(np.sum(terms)) < 1e-12 * np.sum(np.abs(terms))


@given(spectra(), st.lists(st.integers(1, 4), min_size=1, max_size=4))
@settings(max_examples=either(200, 16))
def test_spreads_use_every_pole_once_and_fail_only_where_pairs_cannot_fit(spectrum: Spectrum, sizes: list[int]) -> None:
    sizes = [*sizes, spectrum.size - sum(sizes)]
    if sizes[-1] < 0:
        return
    for parts in (spectrum.distribute(sizes), spectrum.split_by_speed(sizes)):
        if parts is None:
            assert len(spectrum.pairs) > sum(size // 2 for size in sizes)
            continue
        assert [part.size for part in parts] == sizes
        joint = Spectrum.sort(
            [pole for part in parts for pole in part.real], [pole for part in parts for pole in part.pairs]
        )
        assert joint == spectrum


def test_the_fastest_come_first_and_neighbours_apart() -> None:
    spectrum = Spectrum.of([-1.0, -2.0, -3.0, -4.0], 4)
    assert [part.real for part in spectrum.split_by_speed([2, 2])] == [(-4.0, -3.0), (-2.0, -1.0)]
    assert [part.real for part in spectrum.distribute([2, 2])] == [(-4.0, -2.0), (-3.0, -1.0)]


def test_splits_are_all_and_real() -> None:
    real = Spectrum.of([-1.0, -2.0, -3.0, -4.0, -5.0, -6.0], 6)
    splits = list(real.splits(3))
    assert len(splits) == len(set(splits)) == 20
    assert all(one.size == 3 and real.without(one) == other for one, other in splits)
    mixed = Spectrum.of([-1.0, -2.0, -3 + 1j, -3 - 1j], 4)
    assert {one.poles.sum() for one, _ in mixed.splits(2)} == {-3.0, -6.0}
    assert list(Spectrum.of([1j, -1j, 2j, -2j], 4).splits(1)) == []
    assert len(list(Spectrum.of([-1.0, -1.0, -2.0], 3).splits(1))) == 2


def test_conjugates_are_matched_within_rounding() -> None:
    spectrum = Spectrum.of([-1 + 2j, -3.0, -1 - 2j * (1 + 1e-12)], 3)
    assert spectrum.pairs[0] == pytest.approx(-1 + 2j)
    assert np.array_equal(np.sort(spectrum.poles.imag), np.sort(-spectrum.poles.imag))


@pytest.mark.parametrize(
    ("poles", "problem"),
    [
        ([-1.0, -2.0], "2 poles; give 3"),
        ([-1.0, -2.0, -3 + 1j], r"-3\+1j lacks its conjugate; also give -3-1j"),
        ([-1 - 1j, -1 - 1j, -1 + 1j], r"-1-1j lacks its conjugate; also give -1\+1j"),
        ([-1.0, -2.0, np.nan], "not a list of finite numbers"),
        ([[-1.0, -2.0, -3.0]], "not a list of finite numbers"),
        (["fast", "slow", "slow"], "not a list of finite numbers"),
    ],
)
def test_what_is_no_spectrum(poles: list, problem: str) -> None:
    with pytest.raises(InputError, match=problem):
        Spectrum.of(poles, 3)


def test_a_part_that_is_none() -> None:
    with pytest.raises(InputError, match="-4 is not one of the poles"):
        Spectrum.of([-1.0, -2.0], 2).without(Spectrum.of([-4.0], 1))
