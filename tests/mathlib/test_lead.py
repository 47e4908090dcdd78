"""`perilune.fmus_src.mathlib.lead`: lead compensator by Tustin's rule.

Truth: `scipy.signal.cont2discrete` (bilinear) and `lfilter` on random inputs; python-control's frequency response of
the sampled system; at a change of law, the output of the old law.
"""

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import signal

from perilune.fmus_src.mathlib.lead import advance_lead, change_lead, lead_output, tustin_lead
from perilune.fmus_src.mathlib.vectors import vector

gains = st.floats(0.01, 10.0)
times = st.floats(0.1, 100.0)
periods = st.floats(0.01, 10.0)
DESIGNS = [(1.5625e-4, 160.0, 13.3, 8.0), (6.25e-4, 80.0, 6.67, 4.0), (0.16, 5.0, 0.417, 0.25)]


def respond(law, errors):
    """Return outputs for a sequence of 3-vectors."""
    g, actual = vector(0.0, 0.0, 0.0), []
    for e in errors:
        actual.append(lead_output(law, g, vector(*e)))
        g = advance_lead(law, g, vector(*e))
    return np.array(actual)


@given(gains, times, times, periods)
def test_response_is_that_of_the_bilinear_rule(gain, lead, lag, period):
    errors = np.random.default_rng(1).normal(size=(50, 3))
    numerator, denominator, _ = signal.cont2discrete(([gain * lead, gain], [lag, 1.0]), period, method="bilinear")
    expected = signal.lfilter(np.ravel(numerator), denominator, errors, axis=0)
    actual = respond(tustin_lead(gain, lead, lag, period), errors)
    assert actual == pytest.approx(expected, rel=1e-8, abs=1e-9 * abs(expected).max())


@pytest.mark.parametrize("design", DESIGNS)
def test_frequency_response_is_that_of_python_control(design):
    gain, lead, lag, period = design
    decay, fraction, direct = tustin_lead(*design).elements()
    ours = control.ss(decay, 1.0, fraction, direct, period)
    theirs = control.sample_system(control.tf([gain * lead, gain], [lag, 1.0]), period, method="tustin")
    w = np.geomspace(1e-4, 3.0, 30) / period
    assert ours(np.exp(1j * w * period)) == pytest.approx(theirs(np.exp(1j * w * period)), rel=1e-10)


@given(gains, times, times, periods, st.lists(st.floats(-1.0, 1.0), min_size=3, max_size=3))
def test_output_does_not_jump_where_the_law_changes(gain, lead, lag, period, e):
    old, new = tustin_lead(0.3, 20.0, 2.0, 1.0), tustin_lead(gain, lead, lag, period)
    g, e = vector(0.5, -2.0, 1.0), vector(*e)
    before = lead_output(old, g, e)
    g = change_lead(old, new, e, g)
    after = lead_output(new, g, e)
    if abs(new.state_gain) > 1e-6 * abs(new.input_gain):
        assert after == pytest.approx(before, rel=1e-6, abs=1e-6)
    for _ in range(3000):  # and it forgets
        g = advance_lead(new, g, e)
    settled = lead_output(new, g, e)
    if new.decay**3000 < 1e-9:
        assert settled == pytest.approx([gain * x for x in e], rel=1e-6, abs=1e-6)


def test_law_without_a_state_takes_none_over():
    new = tustin_lead(2.0, 3.0, 3.0, 1.0)  # lead and lag cancel
    assert new.state_gain == pytest.approx(0.0, abs=1e-15)
    old = tustin_lead(0.3, 20.0, 2.0, 1.0)
    assert change_lead(old, new, vector(1.0, 1.0, 1.0), vector(1.0, 2.0, 3.0)) == [0.0, 0.0, 0.0]
