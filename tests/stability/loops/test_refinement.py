"""Margins between measured lines, for loops whose response is known at every frequency.

Truth: the margins of the exact response, which test_margins.py compares with python-control.
"""

import control
import numpy as np
import pytest

from perilune.analysis.stability.loops.curves import interpolate
from perilune.analysis.stability.loops.margins import classical, robust
from perilune.analysis.stability.loops.multisine import multisine
from perilune.analysis.stability.loops.readings import FrequencyResponse, decibel_size, degree_size
from perilune.analysis.stability.loops.refinement import ROUNDS, refine
from tests.support.loops.sampled_loops import response_of

STEP, SAMPLES = 0.1, 2000
LINES = multisine(SAMPLES, 1.0, (SAMPLES - 1) // 2, 1, per_decade=20).lines * 2.0 * np.pi / (SAMPLES * STEP)


def resonant(rate, damping, gain):
    """Return an integrator with a resonance, held over a sample, with one sample of delay."""
    plant = control.tf([gain * rate**2], [1.0, 2.0 * damping * rate, rate**2, 0.0])
    return response_of(control.c2d(control.ss(plant), STEP, "zoh") * control.ss(0.0, 1.0, 1.0, 0.0, STEP))


def margins_of(curve):
    response = interpolate(curve.frequency, curve.value, STEP)
    ends = curve.frequency[0], curve.frequency[-1]
    return classical(response, *ends, STEP, None), robust(response, *ends)


@pytest.mark.parametrize(
    ("rate", "damping", "gain"), [(5.0, 0.1, 0.5), (3.0, 0.05, 0.15), (8.0, 0.05, 0.4), (5.0, 0.03, 0.15)]
)
def test_margins_at_a_resonance_between_lines(rate, damping, gain):
    """Splines of the lines alone are wrong by 0.2 to 1.9 dB."""
    truth = resonant(rate, damping, gain)
    requests = []

    def measure(frequency):
        requests.append(frequency)
        return frequency, complex(truth(np.array([frequency]))[0])

    lines = FrequencyResponse(LINES, truth(LINES))
    refined = refine(lines, margins_of, measure)
    exact, distance = classical(truth, LINES[0], LINES[-1], STEP, None), robust(truth, LINES[0], LINES[-1])
    (before, _), (after, closest) = margins_of(lines), margins_of(refined.curve)
    assert decibel_size(before.gain_margin.value / exact.gain_margin.value) > 0.1
    assert decibel_size(after.gain_margin.value / exact.gain_margin.value) < 0.005
    assert degree_size(after.phase_margin.value - exact.phase_margin.value) < 0.005
    assert closest.modulus_margin == pytest.approx(distance.modulus_margin, abs=1e-3)
    assert closest.disk_margin == pytest.approx(distance.disk_margin, abs=1e-3)
    assert refined.settled
    assert refined.remainder == ""
    assert len(requests) <= 4 * ROUNDS


def test_what_is_left_is_said():
    """A measurement that contradicts itself: the crossing is elsewhere in every round."""
    truth = resonant(5.0, 0.1, 0.5)
    count = 0

    def measure(frequency):
        nonlocal count
        count += 1
        return frequency, complex(truth(np.array([frequency]))[0]) * (1.3 if count % 2 else 0.8)

    refined = refine(FrequencyResponse(LINES, truth(LINES)), margins_of, measure)
    assert refined.rounds == ROUNDS
    assert not refined.settled
    assert f"after {ROUNDS} rounds of test frequencies at the crossings" in refined.remainder
