"""Oscillations in records: analysis/stability/oscillation.py.

Truth: signals with a known amplitude and period, among them the Van der Pol oscillator, whose period is published;
signals that settle, decay, grow, drift or are noise.
"""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.signal import lfilter

from perilune.analysis.stability.loops.oscillation import find_oscillation

TIME = np.arange(4000) * 0.05  # 200 s


@given(st.floats(1e-3, 1e3), st.floats(1.0, 12.0), st.floats(-5.0, 5.0), st.floats(0.0, 6.28))
def test_sine(amplitude, period, mean, phase):
    actual = find_oscillation(TIME, amplitude * (mean + np.sin(2 * np.pi * TIME / period + phase)))
    assert actual is not None
    assert actual.amplitude == pytest.approx(amplitude, rel=1e-3)
    assert actual.period == pytest.approx(period, rel=1e-3)
    assert actual.mean == pytest.approx(amplitude * mean, abs=1e-2 * amplitude)
    assert actual.half_peak_to_peak == pytest.approx(amplitude, rel=2e-2)
    assert actual.cycles >= 6


def test_square_wave_has_the_fundamental_of_one():
    actual = find_oscillation(TIME, 2.0 * np.sign(np.sin(2 * np.pi * (TIME + 0.01) / 10.0)))
    assert actual is not None
    assert actual.amplitude == pytest.approx(2.0 * 4.0 / math.pi, rel=1e-3)
    assert actual.half_peak_to_peak == pytest.approx(2.0)
    assert actual.period == pytest.approx(10.0, rel=1e-3)


def test_triangle_wave_with_ripple_around_its_zeros():
    theta = 2 * np.pi * TIME / 10.0
    triangle = 2.0 / math.pi * np.arcsin(np.sin(theta))
    actual = find_oscillation(TIME, triangle + 0.08 * np.sin(23.0 * theta))
    assert actual is not None
    assert actual.amplitude == pytest.approx(8.0 / math.pi**2, rel=2e-3)
    assert actual.period == pytest.approx(10.0, rel=1e-2)


def test_van_der_pol():
    """mu = 1 from a small start: period 6.66329 (Andersen and Geer 1982), largest value 2.0086."""
    flown = solve_ivp(
        lambda t, y: [y[1], (1 - y[0] ** 2) * y[1] - y[0]], (0.0, 200.0), [0.01, 0.0], t_eval=TIME, rtol=1e-9
    )
    actual = find_oscillation(TIME, flown.y[0])
    assert actual is not None
    assert actual.period == pytest.approx(6.6633, rel=1e-4)
    assert actual.half_peak_to_peak == pytest.approx(2.0086, rel=1e-3)


NOISE = np.random.default_rng(3).normal(size=len(TIME))
WALK = np.cumsum(NOISE)
SINE = np.sin(2 * np.pi * TIME / 6.0)


@pytest.mark.parametrize(
    "values",
    [
        np.full(len(TIME), 3.0),
        3.0 + 1e-16 * NOISE,
        np.exp(-TIME / 10.0),
        1.0 - np.exp(-TIME / 10.0),
        0.3 * TIME,
        np.exp(-TIME / 100.0) * SINE,
        np.exp(-TIME / 5.0) * SINE,
        np.exp(TIME / 100.0) * SINE,
        SINE + 0.1 * TIME,
        SINE + 0.01 * TIME,
        NOISE,
        WALK,
        np.sin(2 * np.pi * TIME**2 / 1000.0),
        np.sin(2 * np.pi * TIME / 50.0),
    ],
    ids=[
        "constant",
        "rounding",
        "settles",
        "approaches",
        "ramp",
        "decays slowly",
        "decays fast",
        "grows",
        "drifts fast",
        "drifts slowly",
        "noise",
        "random walk",
        "chirp",
        "too few cycles",
    ],
)
def test_no_oscillation_that_lasts(values):
    assert find_oscillation(TIME, values) is None


@pytest.mark.parametrize("seed", range(20))
def test_noise_is_no_oscillation(seed):
    random = np.random.default_rng(seed)
    noise = random.normal(size=2000)
    assert find_oscillation(np.arange(2000.0), noise) is None
    assert find_oscillation(np.arange(1991.0), np.convolve(noise, np.ones(10), mode="valid")) is None


def test_noise_on_an_oscillation_is_borne():
    actual = find_oscillation(TIME, SINE + 0.05 * NOISE)
    assert actual is not None
    assert actual.amplitude == pytest.approx(1.0, rel=1e-2)
    assert actual.period == pytest.approx(6.0, rel=1e-2)


def test_phase_may_wander():
    """A sampled loop hops between cycles of 28 and 29 samples: the phase wanders, the amplitude does not."""
    lengths = np.repeat([28.0, 29.0, 28.0, 29.0, 28.0, 29.0], 23)
    angle = np.concatenate([2 * np.pi * np.arange(n) / n for n in lengths])
    actual = find_oscillation(np.arange(len(angle)) * 0.1, 2.0 * np.sin(angle))
    assert actual is not None
    assert actual.amplitude == pytest.approx(2.0, rel=1e-2)
    assert actual.period == pytest.approx(2.85, rel=1e-2)


def test_resonance_driven_by_noise_is_no_oscillation_that_lasts():
    """Damping 0.05: the right frequency, but an amplitude that comes and goes."""
    for seed in range(10):
        drive = np.random.default_rng(seed).normal(size=3000)
        ringing = lfilter([1.0], [1.0, -2 * 0.98 * math.cos(0.4), 0.98**2], drive)
        assert find_oscillation(np.arange(3000.0), ringing) is None


def test_only_the_last_part_counts():
    values = SINE * np.where(TIME < 90.0, 5.0 * np.exp(-TIME / 50.0), 1.0)
    assert find_oscillation(TIME, values) is not None
    assert find_oscillation(TIME, values, share=0.9) is None


@pytest.mark.parametrize(
    ("time", "values", "text"),
    [
        (TIME, SINE[:-1], "as many values"),
        (TIME[:10], SINE[:10], "at least 16"),
        (TIME**1.01, SINE, "not sampled uniformly"),
        (TIME[::-1], SINE, "not sampled uniformly"),
        (TIME, np.where(TIME > 100.0, math.nan, SINE), "not finite"),
    ],
)
def test_wrong_records(time, values, text):
    with pytest.raises(ValueError, match=text):
        find_oscillation(time, values)
