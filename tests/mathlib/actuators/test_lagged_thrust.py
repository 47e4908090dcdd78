"""Thrust with a first-order lag: `perilune.fmus_src.mathlib.actuators.lagged_thrust`.

Truth: the exponential and its quadrature by scipy; invariance under an arbitrary division of the time.
"""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from perilune.fmus_src.mathlib.actuators.lagged_thrust import lagged_thrust

thrusts = st.floats(0.0, 5000.0)


@given(thrusts, thrusts, st.floats(0.01, 5.0), st.floats(0.01, 2.0))
def test_thrust_is_exponential_and_the_impulse_its_integral(delivered, commanded, lag, h):
    def thrust(t):
        return commanded + (delivered - commanded) * math.exp(-t / lag)

    step = lagged_thrust(delivered, commanded, lag, h)
    levels = [step.start, step.middle, step.end]
    assert levels == pytest.approx([delivered, thrust(0.5 * h), thrust(h)], rel=1e-12, abs=1e-9)
    assert step.middle_impulse == pytest.approx(quad(thrust, 0.0, 0.5 * h)[0], rel=1e-9, abs=1e-9)
    assert step.impulse == pytest.approx(quad(thrust, 0.0, h, limit=200)[0], rel=1e-6, abs=1e-9)


@given(thrusts, thrusts, st.floats(0.01, 5.0), st.floats(0.01, 2.0), st.floats(0.1, 0.9))
def test_cutting_the_time_changes_nothing(delivered, commanded, lag, h, share):
    whole = lagged_thrust(delivered, commanded, lag, h)
    first = lagged_thrust(delivered, commanded, lag, share * h)
    second = lagged_thrust(first.end, commanded, lag, (1.0 - share) * h)
    assert second.end == pytest.approx(whole.end, rel=1e-12, abs=1e-9)
    assert first.impulse + second.impulse == pytest.approx(whole.impulse, rel=1e-12, abs=1e-9)


@given(thrusts, thrusts)
def test_without_a_lag_the_command_is_there_at_once(delivered, commanded):
    step = lagged_thrust(delivered, commanded, 0.0, 0.4)
    assert [step.start, step.middle, step.end] == [commanded] * 3
    assert (step.middle_impulse, step.impulse) == pytest.approx((0.2 * commanded, 0.4 * commanded))
