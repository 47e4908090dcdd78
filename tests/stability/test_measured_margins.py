"""Margins by injection alone, for FMUs without a linear model: crossings are measured, not interpolated.

Truth: python-control on the loop's state space, as in test_exact_cases.py.
"""

import numpy as np
import pytest

import perilune
from perilune.analysis.stability.point import point_study
from perilune.common.errors import InputError
from tests.support.loops.exact_margins import crossings, disk_margin
from tests.support.loops.exact_systems import late_double_integrator, resonance


@pytest.mark.parametrize("make", [resonance, late_double_integrator])
@pytest.mark.parametrize("every", [1, 4])
def test_crossings_are_test_frequencies(make, every, exact_fmus, tmp_path, monkeypatch):
    def refuse(*_):
        raise InputError("loop", "", "no linear model", "measure")

    monkeypatch.setattr(point_study, "linearise", refuse)
    exact = make(every)
    (loop,) = perilune.stability(exact.packed(tmp_path, exact_fmus), workers=1).loops
    assert loop.linearised is None
    gain, phase, _ = crossings(exact.loop)
    nearest = np.min(abs(20.0 * np.log10(gain)))
    assert abs(20.0 * np.log10(loop.classical.gain_margin.value)) == pytest.approx(nearest, abs=0.005)
    assert abs(loop.classical.phase_margin.value) == pytest.approx(np.min(abs(phase)), abs=np.radians(0.01))
    assert loop.robust.disk_margin == pytest.approx(disk_margin(exact.loop), rel=1e-3)
    lines = loop.measured_response.curve.frequency
    for crossing in (loop.classical.gain_margin, loop.classical.phase_margin):
        assert np.min(abs(lines / crossing.frequency - 1.0)) < 1e-3
    assert "margins" not in loop.not_applicable
