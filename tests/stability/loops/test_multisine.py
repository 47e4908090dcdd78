"""Multisines: excited lines, their measurement, and detection of nonlinearity."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.signal import lfilter

from perilune.analysis.stability.loops.multisine import fraction_unexcited, line_spectrum, multisine
from tests.support.lengths import either


@given(
    half=st.integers(32, 1024),
    seed=st.integers(0, 2**32 - 1),
    amplitude=st.floats(1e-6, 1e3),
    per_decade=st.one_of(st.none(), st.floats(3.0, 40.0)),
)
@settings(max_examples=either(25, 8))
def test_only_odd_lines_and_each_of_the_amplitude(
    half: int, seed: int, amplitude: float, per_decade: float | None
) -> None:
    actual = multisine(2 * half, amplitude, half - 1, seed, per_decade=per_decade)
    spectrum = 2.0 / (2 * half) * np.fft.rfft(actual.signal)
    np.testing.assert_allclose(np.abs(spectrum[actual.lines]), amplitude, rtol=1e-9)
    np.testing.assert_allclose(np.angle(spectrum[actual.lines] * np.exp(-1j * actual.phases)), 0.0, atol=1e-9)
    others = np.setdiff1d(np.arange(half + 1), actual.lines)
    assert np.max(np.abs(spectrum[others])) < 1e-12 * amplitude * len(actual.lines)
    assert np.all(actual.lines % 2 == 1)
    assert actual.lines[0] == 1
    np.testing.assert_array_equal(np.sort([*actual.lines, *actual.unexcited]), np.arange(1, half))
    assert np.any(actual.unexcited % 2 == 1)
    assert np.mean(actual.signal**2) == pytest.approx(0.5 * amplitude**2 * len(actual.lines))


def test_linear_spacing_leaves_out_one_odd_line_in_four_and_logarithmic_covers_decades() -> None:
    full = multisine(4096, 1.0, 2047, 3)
    assert len(full.lines) == pytest.approx(0.75 * 1024, abs=2)
    few = multisine(4096, 1.0, 2047, 3, per_decade=10)
    assert 20 <= len(few.lines) <= 30
    assert few.lines[-1] > 1500
    assert np.max(few.lines[1:] / few.lines[:-1]) <= 5.0  # 1 to 5 with line 3 left out


def test_same_seed_same_signal_and_low_crest() -> None:
    one, same, other = (multisine(1024, 1.0, 400, seed) for seed in (5, 5, 6))
    np.testing.assert_array_equal(one.signal, same.signal)
    assert not np.array_equal(one.signal, other.signal)
    # one draw of 150 random phases has a crest factor of 3.3 in the mean, and the best of many is still above 2.5
    assert max(one.crest_factor, other.crest_factor) < 1.8
    sparse = multisine(1024, 1.0, 500, 1, per_decade=15)
    assert sparse.crest_factor < 2.3
    assert multisine(64, 2.0, 1, 0).crest_factor == pytest.approx(np.sqrt(2.0), rel=1e-2)


def test_frequency_response_of_a_filter_in_the_steady_state() -> None:
    signal = multisine(512, 0.3, 255, 1, per_decade=15)
    numerator, denominator = [0.2, 0.1], [1.0, -0.9, 0.3]
    record = lfilter(numerator, denominator, np.tile(signal.signal, 6))
    last = record[2 * 512 :]
    z = np.exp(2j * np.pi * signal.lines / 512)
    exact = np.polyval(numerator, z) * z / np.polyval(denominator, z)
    measured = line_spectrum(last, 512, signal.lines) / line_spectrum(signal.signal, 512, signal.lines)
    np.testing.assert_allclose(measured, exact, rtol=1e-12)
    assert fraction_unexcited(last, signal) < 1e-12
    both = line_spectrum(np.column_stack([last, 2.0 * last]), 512, signal.lines)
    np.testing.assert_allclose(both[:, 1], 2.0 * both[:, 0])


@pytest.mark.parametrize(("power", "parity"), [(2, 0), (3, 1)])
def test_nonlinearity_shows_on_lines_of_its_parity(power: int, parity: int) -> None:
    signal = multisine(1024, 1.0, 200, 2)
    record = signal.signal + 1e-3 * signal.signal**power
    stray = np.abs(line_spectrum(record, 1024, signal.unexcited))
    displayed = signal.unexcited % 2 == parity
    assert np.min(stray[displayed]) > 1e-4
    assert np.max(stray[~displayed]) < 1e-12
    assert fraction_unexcited(record, signal) == pytest.approx(np.max(stray), rel=0.3)
    assert fraction_unexcited(signal.signal, signal) < 1e-12


def test_refusals() -> None:
    with pytest.raises(ValueError, match="highest line"):
        multisine(64, 1.0, 32, 0)
    with pytest.raises(ValueError, match="positive"):
        multisine(64, 0.0, 16, 0)
    with pytest.raises(ValueError, match="whole number of periods"):
        line_spectrum(np.zeros(65), 64, np.array([1]))
    with pytest.raises(ValueError, match="no response to compare with"):
        fraction_unexcited(np.zeros(64), multisine(64, 1.0, 16, 0))
