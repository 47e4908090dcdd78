"""Interpolation between measured lines and the adaptive grid."""

from __future__ import annotations

import numpy as np
import pytest

from perilune.analysis.stability.loops.curves import cache_response, dense, interpolate
from perilune.analysis.stability.loops.margins import classical
from tests.support.loops.sampled_loops import HeldDoubleIntegrator, response_of

LOOP = HeldDoubleIntegrator(period=0.5, samples=1, phase_crossover=0.6, gain_crossover=0.3)


def test_margins_of_a_measured_double_integrator() -> None:
    """Ten odd lines per decade out of a period of 4096 samples."""
    numbers = np.unique(2 * np.round((np.geomspace(1.0, 2001.0, 34) - 1.0) / 2.0).astype(int) + 1)
    frequency = 2.0 * np.pi * numbers / (4096 * LOOP.period)
    exact = response_of(LOOP.system)
    response = interpolate(frequency, exact(frequency), LOOP.period)
    actual = classical(response, frequency[0], frequency[-1], LOOP.period, None)
    assert actual.gain_margin is not None
    assert actual.phase_margin is not None
    assert 20 * np.log10(actual.gain_margin.value / LOOP.gain_margin) == pytest.approx(0.0, abs=1e-3)
    assert np.degrees(actual.phase_margin.value - LOOP.phase_margin) == pytest.approx(0.0, abs=1e-2)
    between = np.geomspace(frequency[4], frequency[-1], 1000)
    ratio = response(between) / exact(between)
    assert np.max(np.abs(20 * np.log10(np.abs(ratio)))) < 0.02
    assert np.max(np.abs(np.degrees(np.angle(ratio)))) < 0.02


def test_interpolation_passes_through_the_lines_and_stays_within_them() -> None:
    frequency = np.array([0.1, 0.2, 0.5, 1.0, 2.0])
    value = np.exp(-1j * 1.1 * frequency) / (1j * frequency)
    response = interpolate(frequency, value, 1.0)
    np.testing.assert_allclose(response(frequency), value, rtol=1e-12)
    for outside in (0.09, 2.01):
        with pytest.raises(ValueError, match="outside of the measured range"):
            response(np.array([outside]))
    with pytest.raises(ValueError, match="increase"):
        interpolate(frequency[::-1], value, 1.0)
    with pytest.raises(ValueError, match="Nyquist"):
        interpolate(frequency, value, 2.0)
    with pytest.raises(ValueError, match="at least 4"):
        interpolate(frequency[:3], value[:3], 1.0)
    with pytest.raises(ValueError, match="gain at a line is zero or not finite"):
        interpolate(frequency, np.where(frequency == 0.5, 0.0, value), 1.0)


def resonance(damping: float, delay: float = 3.0):
    def response(frequency: np.ndarray) -> np.ndarray:
        return 0.1 * np.exp(-1j * delay * frequency) / (1.0 - frequency**2 + 2j * damping * frequency)

    return response


@pytest.mark.parametrize("damping", [0.1, 1e-3, 1e-5])
def test_grid_resolves_a_resonance_and_its_crossings(damping: float) -> None:
    response = resonance(damping)
    curve = dense(response, 1e-2, 10.0, include=[1.0])
    ratio = curve.value[1:] / curve.value[:-1]
    assert np.max(np.abs(np.log(ratio))) <= 0.1 * (1.0 + 1e-9)
    assert np.all(np.diff(curve.frequency) > 0.0)
    assert (curve.frequency[0], curve.frequency[-1]) == (1e-2, 10.0)
    assert len(curve.frequency) < 3000
    np.testing.assert_array_equal(curve.value, response(curve.frequency))
    if damping < 0.05:  # |L| = 1 where (1 - w^2)^2 + (2 d w)^2 = 0.01
        middle = 1.0 - 2.0 * damping**2
        crossings = np.sqrt(middle + np.array([-1.0, 1.0]) * np.sqrt(middle**2 - 0.99))
        for crossing in crossings:
            assert np.min(np.abs(curve.frequency - crossing)) < 1e-5


def test_a_touch_of_the_unit_circle_is_not_missed() -> None:
    """A peak that passes 1 by a millionth, far narrower than the grid."""
    damping = 0.1
    peak = 1.0 / (2.0 * damping * np.sqrt(1.0 - damping**2))

    def response(frequency: np.ndarray) -> np.ndarray:
        return (1.0 + 1e-6) / peak / (1.0 - frequency**2 + 2j * damping * frequency)

    actual = classical(response, 1e-2, 10.0, 1e-3, None)
    assert len(actual.phase) == 2
    for crossing in actual.phase:
        assert crossing.frequency == pytest.approx(np.sqrt(1.0 - 2.0 * damping**2), rel=1e-3)


def test_a_remembered_response_is_asked_for_each_frequency_once() -> None:
    requested: list[float] = []

    def loops(frequency: np.ndarray) -> np.ndarray:
        requested.extend(frequency)
        return frequency[:, None, None] * np.array([[1.0, 2.0j], [3.0, 4.0]])

    response = cache_response(loops)
    assert cache_response(response) is response
    first = np.array([3.0, 1.0, 3.0])
    np.testing.assert_array_equal(response(first), loops(first))
    del requested[:]
    repeated = np.array([2.0, 1.0])
    np.testing.assert_array_equal(response(repeated)[:, 1, 1], [8.0, 4.0])
    assert requested == [2.0]


def test_margins_ask_for_each_frequency_once() -> None:
    requested: list[float] = []
    exact = response_of(LOOP.system)

    def response(frequency: np.ndarray) -> np.ndarray:
        requested.extend(frequency.tolist())
        return exact(frequency)

    classical(response, 1e-2, np.pi / LOOP.period, LOOP.period, 0)
    assert len(set(requested)) == len(requested)


def test_refuses_what_it_cannot_resolve() -> None:
    with pytest.raises(ValueError, match="not resolved by 1000 points"):
        dense(resonance(0.1, delay=1e4), 1e-2, 10.0, most=1000)
    with pytest.raises(ValueError, match="0 < low < high"):
        dense(resonance(0.1), 1.0, 0.5)
    with pytest.raises(ValueError, match="not finite at 1 rad/s"), np.errstate(all="ignore"):
        dense(lambda w: 1.0 / (w - 1.0) + 0j, 0.5, 2.0, include=[1.0])
