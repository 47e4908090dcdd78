"""Translation control: its two laws, its sample times, and the margins of its loop.

Truth: scipy's bilinear discretisation of the lead; the law of position and velocity by numpy; python-control's margins
of the sampled double integrator with the jets' delay, against the published design's 44 deg and 12.6 dB at 8 s, 45 deg
and 13.1 dB at 4 s; the poles defined by natural frequency and damping ratio.
"""

import math

import control
import numpy as np
import pytest
from scipy import signal

from perilune.fmus_src.control.translation_control import TranslationControl

SLOW, FAST = (1.5625e-4, 160.0, 13.3, 8.0), (6.25e-4, 80.0, 6.67, 4.0)  # gain, lead, lag, period
ERRORS = np.random.default_rng(5).normal(scale=0.02, size=(60, 3))
RATES = np.random.default_rng(6).normal(scale=0.001, size=(60, 3))
PLAN = np.array([1e-4, -2e-4, 3e-5])


def fly(block, errors, rates, periods):
    """Return forces at ticks; the block is stepped between them, too, with inputs that must not matter."""
    actual = []
    for k, (error, rate, period) in enumerate(zip(errors, rates, periods, strict=True)):
        block.translation_count = k + 1
        block.translation_period = period
        block.position_error = error.tolist()
        block.velocity_error = rate.tolist()
        block.planned_acceleration = PLAN.tolist()
        if k == 0:
            block.initialize()
        else:
            block.step(0.0, 0.125)
        actual.append(list(block.force_command))
        assert block.command_count == k + 1
        block.position_error = [9.0] * 3
        block.planned_acceleration = [9.0] * 3
        block.step(0.0, 0.125)
        assert list(block.force_command) == actual[-1]
    return np.array(actual)


def lead_response(gain, lead, lag, period, errors, first_state=None):
    numerator, denominator, _ = signal.cont2discrete(([gain * lead, gain], [lag, 1.0]), period, method="bilinear")
    return signal.lfilter(np.ravel(numerator), denominator, errors, axis=0)


@pytest.mark.parametrize("design", [SLOW, FAST], ids=["8 s", "4 s"])
def test_lead_is_the_bilinear_one(design):
    actual = fly(TranslationControl(law=0), ERRORS, RATES, [design[3]] * 60)
    assert actual == pytest.approx(1000.0 * (PLAN - lead_response(*design, ERRORS)), rel=1e-9)


def test_output_of_the_lead_does_not_jump_at_the_change_of_period():
    """At the tick of the change the force is that of the slow law; then it forgets as the fast lead does."""
    changed = fly(TranslationControl(law=0), ERRORS, RATES, [8.0] * 20 + [4.0] * 40)
    slow = 1000.0 * (PLAN - lead_response(*SLOW, ERRORS))
    assert changed[:21] == pytest.approx(slow[:21], rel=1e-9)
    fast = 1000.0 * (PLAN - lead_response(*FAST, ERRORS[20:]))
    decay = (2.0 * 6.67 - 4.0) / (2.0 * 6.67 + 4.0)
    expected = fast + (changed[20] - fast[0]) * decay ** np.arange(40)[:, None]
    assert changed[20:] == pytest.approx(expected, rel=1e-9)


def test_position_and_velocity_by_the_design_of_the_period():
    block = TranslationControl(natural_frequency=[0.03, 0.05], damping=[0.9, 0.7], mass=900.0)
    actual = fly(block, ERRORS, RATES, [8.0] * 30 + [4.0] * 30)
    for k, (error, rate) in enumerate(zip(ERRORS, RATES, strict=True)):
        w, zeta = (0.03, 0.9) if k < 30 else (0.05, 0.7)
        assert actual[k] == pytest.approx(900.0 * (PLAN - w * w * error - 2.0 * zeta * w * rate), rel=1e-12)


@pytest.mark.parametrize("law", [0, 1])
@pytest.mark.parametrize("name", ["position_error", "velocity_error", "planned_acceleration"])
def test_inputs_that_are_not_finite_leave_the_force(law, name):
    block = TranslationControl(law=law)
    fly(block, ERRORS[:3], RATES[:3], [8.0] * 3)
    held = list(block.force_command)
    block.position_error = block.planned_acceleration = [0.0] * 3
    values = list(getattr(block, name))
    values[1] = math.nan
    setattr(block, name, values)
    block.translation_count += 1
    block.step(0.0, 0.125)
    assert (block.status, block.force_command, block.command_count) == (1, held, 3)
    values = list(getattr(block, name))
    values[1] = 0.0
    setattr(block, name, values)
    block.translation_count += 1
    block.step(0.0, 0.125)
    assert (block.status, block.command_count) == (0, 4)
    assert all(math.isfinite(x) for x in block.force_command)


def double_integrator(period, delay):
    """Return position at the ticks from an acceleration held from ``delay`` after each tick on."""
    remainder = period - delay
    z = control.tf([1, 0], [1], period)
    position = 0.5 * remainder * remainder + (0.5 * period * period - 0.5 * remainder * remainder) / z
    velocity = remainder + delay / z
    return position / (z - 1) + period * velocity / (z - 1) ** 2


@pytest.mark.parametrize(
    ("design", "samples", "phase", "gain"), [(SLOW, 8, 44.0, 12.6), (FAST, 4, 45.0, 13.1)], ids=["8 s", "4 s"]
)
@pytest.mark.filterwarnings("ignore:stability_margins")
def test_margins_of_the_lead(design, samples, phase, gain):
    """The mean of n samples lags by (n - 1)/2 s: between two ticks, interpolated."""
    k, lead, lag, period = design
    numerator, denominator, _ = signal.cont2discrete(([k * lead, k], [lag, 1.0]), period, method="bilinear")
    law = control.tf(np.ravel(numerator), denominator, period)
    z = control.tf([1, 0], [1], period)
    late = 0.5 * (samples - 1) / period
    loop = control.minreal(law * double_integrator(period, 0.25 * period) * (1 - late + late / z), verbose=False)
    gain_margin, phase_margin, *_ = control.margin(loop)
    assert phase_margin == pytest.approx(phase, abs=0.5)
    assert 20.0 * math.log10(gain_margin) == pytest.approx(gain, abs=0.1)


@pytest.mark.parametrize(("design", "period"), [(0, 8.0), (1, 4.0)])
def test_law_of_position_and_velocity_is_stable_with_the_delay(design, period):
    """Closed loop of the sampled double integrator and a held, delayed command: poles near exp(s period)."""
    w, zeta = TranslationControl().natural_frequency[design], TranslationControl().damping[design]
    delay = 0.25 * period
    remainder = period - delay
    a = np.array([[1.0, period], [0.0, 1.0]])
    now = np.array([0.5 * remainder * remainder, remainder])
    before = np.array([0.5 * period**2 - 0.5 * remainder**2, delay])
    feedback = -np.array([w * w, 2.0 * zeta * w])
    loop = np.block([[a + np.outer(now, feedback), before[:, None]], [feedback[None, :], np.zeros((1, 1))]])
    poles = np.log(np.linalg.eigvals(loop).astype(complex)) / period
    assert (poles.real < -0.3 * w).all()
