"""Encirclements. Truth: poles from eigenvalues, and python-control's Nyquist count."""

from __future__ import annotations

import control
import numpy as np
import pytest
from hypothesis import assume, given, settings

from perilune.analysis.stability.loops.encirclements import encirclements
from tests.support.lengths import either
from tests.support.loops.sampled_loops import (
    HeldDoubleIntegrator,
    delay,
    held,
    nearest_to_circle,
    outside,
    random_loops,
    response_of,
)

S = control.tf("s")


def count(system: control.StateSpace, low: float = 1e-5, **options) -> int:
    return encirclements(response_of(system), low / system.dt, np.pi / system.dt, **options)


@given(random_loops())
@settings(max_examples=either(120, 30))
def test_open_loop_poles_less_closed_loop_poles(system: control.StateSpace) -> None:
    assume(nearest_to_circle(system) > 1e-3)
    integrators = int(np.sum(np.abs(system.poles() - 1.0) < 1e-9))
    expected = outside(system, 0.0) - outside(system)
    assert count(system) == expected
    assert count(system, poles_at_one=integrators) == expected


@given(random_loops(channels=2))
@settings(max_examples=either(60, 20))
def test_determinant_of_two_channels(system: control.StateSpace) -> None:
    assume(nearest_to_circle(system) > 1e-3)
    assert count(system) == outside(system, 0.0) - outside(system)


@pytest.mark.parametrize("gain", [0.05, 1.0, 4.0])
@pytest.mark.parametrize("integrators", [0, 1, 2, 3])
def test_integrators_are_passed_on_the_outside(integrators: int, gain: float) -> None:
    system = held(gain * 0.3 * (S + 0.1) ** integrators / S**integrators / (S + 1.0), 1.0) * delay(2, 1.0)
    assert nearest_to_circle(system) > 1e-3
    assert count(system, poles_at_one=integrators) == count(system) == -outside(system)


def test_double_integrator_with_delay_before_and_after_its_gain_margin() -> None:
    loop = HeldDoubleIntegrator(period=0.25, samples=1, phase_crossover=0.6, gain_crossover=0.3)
    assert count(loop.system) == 0
    assert count(loop.system * (0.999 * loop.gain_margin)) == 0
    assert count(loop.system * (1.001 * loop.gain_margin)) == -2


@pytest.mark.parametrize(
    "system",
    [
        held(0.3 / (S + 0.01) / (S + 1.0), 1.0) * delay(1, 1.0),
        held(3.0 / (S + 0.01) / (S + 1.0), 1.0) * delay(1, 1.0),
        held(1.8 * (S + 1.0) / ((S - 0.5) * (S + 2.0)), 0.5) * delay(1, 0.5),
        held(0.5 / ((S - 0.5) * (S + 2.0)), 0.5),
    ],
)
def test_equals_python_control(system: control.StateSpace) -> None:
    """Without poles on the unit circle, where python-control 0.10.2 miscounts, and says so."""
    clockwise = control.nyquist_response(system, np.linspace(0.0, np.pi / system.dt, 4001)).count
    assert count(system) == -clockwise


@pytest.mark.parametrize("gain", [0.1, -0.1])
def test_undamped_poles_elsewhere_on_the_circle_are_named(gain: float) -> None:
    """An oscillator with rate feedback, damped by one sign of the gain and driven by the other."""
    frequency, period = 0.2, 1.0
    system = gain * held(S / (S**2 + frequency**2), period)
    assert outside(system) == (0 if gain > 0.0 else 2)
    assert count(system, poles_at_one=0, undamped=[frequency]) == -outside(system)
    twice = system * held(S / (S**2 + frequency**2), period)
    assert count(twice, poles_at_one=0, undamped=[frequency, frequency]) == -outside(twice)
    with pytest.raises(ValueError, match="pole of the open loop is on the unit circle"):
        count(system)


def test_refuses_what_it_cannot_settle() -> None:
    loop = HeldDoubleIntegrator(period=1.0, samples=1, phase_crossover=0.6, gain_crossover=0.3)
    marginal = loop.system * loop.gain_margin
    with pytest.raises(ValueError, match="marginal"):
        count(marginal)
    for low in (0.2, 0.35, 0.6):  # around the crossover, where the integrators do not show
        with pytest.raises(ValueError, match="start at a lower frequency"):
            count(loop.system, low)
    with pytest.raises(ValueError, match="start at a lower frequency"):
        count(loop.system, poles_at_one=1)
    with pytest.raises(ValueError, match="start at a lower frequency"):
        count(loop.system * 1e-3, 0.2)  # below 1 everywhere from there on
