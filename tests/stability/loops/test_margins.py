"""Margins. Truth: closed forms, closed-loop poles and python-control."""

from __future__ import annotations

import warnings
from itertools import pairwise

import control
import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from perilune.analysis.stability.loops.curves import dense
from perilune.analysis.stability.loops.margins import classical, disk_gain, disk_phase, robust
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
RESONANT = held(0.06 * (S + 0.05) / S**2 * 0.25 / (S**2 + 2 * 0.05 * 0.5 * S + 0.25), 1.0) * delay(5, 1.0)
CONDITIONAL = held(0.3 * (S + 0.1) ** 2 / S**3, 1.0) * delay(1, 1.0)
UNSTABLE = held(0.9 * (S + 1.0) / ((S - 0.5) * (S + 2.0)) * 2.0, 0.5) * delay(1, 0.5)


def db(factor: float) -> float:
    return 20.0 * np.log10(factor)


def margins(system: control.StateSpace, low: float = 1e-4, **options):
    return classical(response_of(system), low, np.pi / system.dt, system.dt, outside(system, 0.0), **options)


@pytest.mark.parametrize(
    "loop",
    [
        HeldDoubleIntegrator(period=0.25, samples=1, phase_crossover=0.6, gain_crossover=0.3),
        HeldDoubleIntegrator(period=8.0, samples=2, phase_crossover=0.4, gain_crossover=0.15),
        HeldDoubleIntegrator(period=4.0, samples=5, phase_crossover=0.2, gain_crossover=0.12),
    ],
)
def test_held_double_integrator_with_delay_in_closed_form(loop: HeldDoubleIntegrator) -> None:
    system = loop.system
    actual = classical(response_of(system), 1e-3 / loop.period, np.pi / loop.period, loop.period, 0)
    assert outside(system) == 0
    assert actual.encirclements == 0
    gain, phase = actual.gain_margin, actual.phase_margin
    assert gain is not None
    assert phase is not None
    assert db(gain.value) == pytest.approx(db(loop.gain_margin), abs=1e-6)
    assert gain.frequency * loop.period == pytest.approx(loop.phase_crossover, rel=1e-8)
    assert len(actual.phase) == 1
    assert np.degrees(phase.value) == pytest.approx(np.degrees(loop.phase_margin), abs=1e-6)
    assert phase.frequency * loop.period == pytest.approx(loop.gain_crossover, rel=1e-8)
    assert actual.delay_margin == pytest.approx(loop.phase_margin / loop.gain_crossover * loop.period, rel=1e-8)


def test_several_crossovers_of_a_lightly_damped_resonance() -> None:
    actual = margins(RESONANT)
    assert outside(RESONANT) == 0
    assert actual.encirclements == 0
    assert len(actual.phase) == 3
    frequency = np.linspace(1e-3, np.pi, 100_001)
    value = response_of(RESONANT)(frequency)
    crossed = np.flatnonzero(np.diff(np.abs(value) > 1.0))
    np.testing.assert_allclose([crossing.frequency for crossing in actual.phase], frequency[crossed], atol=4e-5)
    lags = np.angle(-value[crossed])
    np.testing.assert_allclose([crossing.value for crossing in actual.phase], lags, atol=5e-3)
    # the delay margin is at the resonance, where the phase margin is largest: a lead counts as 2 pi less it
    assert actual.delay_frequency == actual.phase[2].frequency
    assert actual.delay_margin == pytest.approx(np.min(lags % (2 * np.pi) / frequency[crossed]), rel=1e-4)


def test_conditionally_stable_loop_has_margins_up_and_down() -> None:
    actual = margins(CONDITIONAL, 1e-3)
    assert outside(CONDITIONAL) == 0
    down, up = (crossing.value for crossing in actual.gain)
    assert down < 1.0 < up
    for margin in (down, up):
        assert nearest_to_circle(CONDITIONAL, margin) < 1e-9
    assert [outside(CONDITIONAL, factor) for factor in (0.999 * down, 1.001 * down, 0.999 * up, 1.001 * up)] == [
        2, 0, 0, 2,
    ]  # fmt: skip


def test_unstable_plant_has_a_margin_down_at_frequency_zero() -> None:
    actual = margins(UNSTABLE)
    assert outside(UNSTABLE, 0.0) == 1
    assert outside(UNSTABLE) == 0
    assert actual.encirclements == 1
    first, *_ = actual.gain
    assert first.frequency == 0.0
    at_one = UNSTABLE.C @ np.linalg.solve(np.eye(UNSTABLE.nstates) - UNSTABLE.A, UNSTABLE.B)
    assert db(first.value) == pytest.approx(db(-1.0 / at_one[0, 0]), abs=1e-6)
    assert outside(UNSTABLE, 0.999 * first.value) == 1


def test_gain_margin_at_the_nyquist_frequency() -> None:
    """k/(z - 0.5) has its only negative real value at z = -1: -k/1.5."""
    loop = control.ss(0.5, 1.0, 0.6, 0.0, 2.0)
    (crossing,) = margins(loop).gain
    assert crossing.value == pytest.approx(2.5, rel=1e-12)
    assert crossing.frequency == np.pi / 2.0
    below = classical(response_of(loop), 1e-3, 0.99 * np.pi / 2.0, 2.0, None)
    assert below.gain == ()
    assert below.encirclements is None


@pytest.mark.parametrize("system", [RESONANT, CONDITIONAL, UNSTABLE])
def test_equals_python_control_between_the_ends(system: control.StateSpace) -> None:
    response, high = response_of(system), np.pi / system.dt
    actual = margins(system, 1e-3)
    curve = dense(response, 1e-3, high)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # about the FRD's own conversion to the complex plane
        data = control.FRD(curve.value, curve.frequency, smooth=True)
        gain, phase, distance, at_gain, at_phase, _ = control.stability_margins(data, returnall=True)
    inner = [crossing for crossing in actual.gain if 0.0 < crossing.frequency < high]
    np.testing.assert_allclose([db(crossing.value) for crossing in inner], db(gain), atol=1e-6)
    np.testing.assert_allclose([crossing.frequency for crossing in inner], at_gain, rtol=1e-5)
    np.testing.assert_allclose([np.degrees(crossing.value) for crossing in actual.phase], phase, atol=1e-6)
    np.testing.assert_allclose([crossing.frequency for crossing in actual.phase], at_phase, rtol=1e-5)
    assert robust(response, 1e-3, high).modulus_margin <= np.min(distance) * (1.0 + 1e-6)


@given(random_loops())
@settings(max_examples=either(60, 20))
def test_poles_cross_the_circle_at_the_gain_margins_and_nowhere_else(system: control.StateSpace) -> None:
    """The number of unstable closed-loop poles over the gain is constant between margins and changes at each."""
    actual = classical(response_of(system), 1e-5 / system.dt, np.pi / system.dt, system.dt, None)
    factors = np.array(sorted(crossing.value for crossing in actual.gain if 1e-3 < crossing.value < 1e3))
    assume(np.all(np.diff(np.log(factors)) > 1e-2))
    assume(system.D[0, 0] == 0.0)  # else a pole can go through infinity
    for factor in factors:
        assert nearest_to_circle(system, factor) < 1e-6
    edges = np.concatenate([[1e-3], factors, [1e3]])
    for lowest, highest in pairwise(edges):
        inside = np.geomspace(lowest * 1.004, highest / 1.004, 7)
        assert len({outside(system, factor) for factor in inside}) == 1
    for factor in factors:
        assert outside(system, factor / 1.004) != outside(system, factor * 1.004)


@given(random_loops(), st.floats(0.2, 5.0))
@settings(max_examples=either(40, 13))
def test_scaling_the_loop_divides_the_gain_margins(system: control.StateSpace, scale: float) -> None:
    scaled = system * scale
    low, high = 1e-5 / system.dt, np.pi / system.dt
    before = classical(response_of(system), low, high, system.dt, None)
    after = classical(response_of(scaled), low, high, system.dt, None)
    retained = [crossing.value / scale for crossing in before.gain]
    np.testing.assert_allclose([crossing.value for crossing in after.gain], retained, rtol=1e-7)


@given(random_loops())
@settings(max_examples=either(60, 20))
def test_the_delay_margin_makes_the_loop_marginal(system: control.StateSpace) -> None:
    response = response_of(system)
    actual = classical(response, 1e-5 / system.dt, np.pi / system.dt, system.dt, None)
    assume(np.isfinite(actual.delay_margin))
    for crossing in actual.phase:
        assert abs(1.0 + response(np.array([crossing.frequency]))[0] * np.exp(-1j * crossing.value)) < 1e-8
        assert -np.pi < crossing.value <= np.pi
    frequency = actual.delay_frequency
    late = response(np.array([frequency]))[0] * np.exp(-1j * frequency * actual.delay_margin)
    assert abs(1.0 + late) < 1e-8
    assert min(crossing.value % (2 * np.pi) / crossing.frequency for crossing in actual.phase) == actual.delay_margin


@given(random_loops())
@settings(max_examples=either(30, 10))
def test_robust_margins_bound_every_point(system: control.StateSpace) -> None:
    response, high = response_of(system), np.pi / system.dt
    assume(nearest_to_circle(system) > 1e-3)
    actual = robust(response, 1e-4 / system.dt, high)
    value = response(np.linspace(1e-4 / system.dt, high, 20001))
    sensitivity, complementary = np.abs(1.0 / (1.0 + value)), np.abs(value / (1.0 + value))
    alpha = 1.0 / np.abs(1.0 / (1.0 + value) - 0.5)
    for peak, grid in (
        (actual.sensitivity_peak, np.max(sensitivity)),
        (actual.complementary_peak, np.max(complementary)),
        (1.0 / actual.disk_margin, 1.0 / np.min(alpha)),
    ):
        assert grid * (1.0 - 1e-9) <= peak <= grid * 1.01
    assert actual.modulus_margin * actual.sensitivity_peak == pytest.approx(1.0)
    at = response(np.array([actual.disk_frequency]))[0]
    assert abs(1.0 / (1.0 + at) - 0.5) * actual.disk_margin == pytest.approx(1.0)


def test_peaks_of_a_second_order_loop_in_closed_form() -> None:
    """L = w0^2/(s (s + 2 d w0)), as a response alone: T peaks with 1/(2 d sqrt(1 - d^2)) at w0 sqrt(1 - 2 d^2)."""
    natural, damping = 2.0, 0.2

    def response(frequency: np.ndarray) -> np.ndarray:
        return natural**2 / (1j * frequency * (1j * frequency + 2.0 * damping * natural))

    actual = robust(response, 1e-3, 1e3)
    assert actual.complementary_peak == pytest.approx(1.0 / (2.0 * damping * np.sqrt(1.0 - damping**2)), rel=1e-9)
    assert actual.complementary_frequency == pytest.approx(natural * np.sqrt(1.0 - 2.0 * damping**2), rel=1e-6)
    crossover = np.sqrt(np.sqrt(4.0 * damping**4 + 1.0) - 2.0 * damping**2)
    phase = classical(response, 1e-3, 1e3, 1e-4, 0).phase_margin
    assert phase is not None
    assert phase.value == pytest.approx(np.arctan2(2.0 * damping, crossover), rel=1e-10)
    assert phase.frequency == pytest.approx(natural * crossover, rel=1e-10)


@pytest.mark.parametrize("alpha", [0.1, 0.75, 1.5, 1.999])
def test_disk_gain_and_phase_lie_on_the_disk(alpha: float) -> None:
    """The perturbations are (1 + d alpha/2)/(1 - d alpha/2), |d| <= 1: real for d = 1, of size 1 for d = j."""
    assert disk_gain(alpha) == pytest.approx((1 + alpha / 2) / (1 - alpha / 2))
    assert np.exp(1j * disk_phase(alpha)) == pytest.approx((1 + 0.5j * alpha) / (1 - 0.5j * alpha))
    assert disk_gain(2.0) == np.inf
