"""Loops of orbital_attitude, compared with the same loops in closed form, and the limit cycle of the jets.

Truth: tests/support/loops/exact_orbital.py, with margins by python-control; for the limit cycle, the harmonic balance
of this loop with a relay of two levels, by scipy.
"""

import numpy as np
import pytest
from scipy.optimize import fsolve

import perilune
from tests.support.lengths import either
from tests.support.loops.exact_margins import crossings, disk_margin
from tests.support.loops.exact_orbital import derivative_loop, loop
from tests.support.loops.sampled_loops import response_of

DECIBEL = 20.0 / np.log(10.0)
AXES = either({"roll": 0, "yaw": 1, "pitch": 2}, {"yaw": 1})


@pytest.fixture(scope="module")
def studied(fmus):
    report = perilune.stability("orbital_attitude", loops=list(AXES), stop_time=2000)
    return {(actual.name, actual.point): actual for actual in report.loops}


@pytest.mark.parametrize("point", ["filter", "observer"])
@pytest.mark.parametrize("name", AXES)
def test_margins_are_those_of_the_closed_form(studied, name, point):
    """1e-3 dB, 1e-2 deg and 1e-3 of the disk margin: with ideal sensors every estimate is the state."""
    actual, exact = studied[name, point], loop(AXES[name])
    gains, phases, _ = crossings(exact)
    nearest = min(gains, key=lambda k: abs(np.log(k)))
    assert DECIBEL * np.log(actual.classical.gain_margin.value / nearest) == pytest.approx(0.0, abs=1e-3)
    assert np.degrees(actual.classical.phase_margin.value) == pytest.approx(np.degrees(min(phases, key=abs)), abs=1e-2)
    assert actual.robust.disk_margin == pytest.approx(disk_margin(exact), rel=1e-3)
    assert actual.agreement.agrees
    assert actual.stable
    assert actual.verdict == "pass"


@pytest.mark.parametrize("name", AXES)
def test_the_limit_cycle_of_the_pulses(studied, name):
    """Two pulses of least length, to and fro: predicted as by hand (1e-5), flown within a quarter of that."""
    element = studied[name, "observer"].nonlinearities[0]
    half = 0.5 * element.parameters["least_pulse"]
    response = response_of(loop(AXES[name]))

    def balance(unknown):
        amplitude, frequency = np.exp(unknown)
        relay = 4.0 / np.pi * half / amplitude * (np.sqrt(1.0 - (half / amplitude) ** 2) - 1j * half / amplitude)
        value = 1.0 + relay * complex(response(np.array([frequency]))[0])
        return [value.real, value.imag]

    amplitude, frequency = np.exp(fsolve(balance, np.log([1.05 * half, 0.3])))
    (cycle,) = [cycle for cycle in element.cycles if cycle.stable]
    assert (cycle.amplitude, cycle.period) == pytest.approx((amplitude, 2.0 * np.pi / frequency), rel=1e-5)
    assert cycle.simulated_amplitude == pytest.approx(amplitude, rel=0.25)
    assert cycle.simulated_period == pytest.approx(cycle.period, rel=0.25)


@pytest.mark.slow
@pytest.mark.parametrize("axis", either([0, 1, 2], [2]))
def test_margins_of_the_derivative_fed_back(fmus, axis):
    """By linearisation and by a test signal, against the closed form: 2e-3 dB, 1e-2 deg, 1e-3 of the disk margin.

    Slow poles: a tick of 1 s.
    """
    report = perilune.stability(
        "orbital_attitude",
        loops=[f"regulator.torque_command[{axis + 1}]"],
        at=[20.0],
        use={"observer": "orbital_observer_discrete", "regulator": "orbital_derivative_control"},
        set={"pulses.mean": True},
        parameters=["tick_1s.ssv", "at_rest.ssv"],
        step=1.0,
        stop_time=400000.0,
    )
    (actual,) = report.loops
    exact = derivative_loop(axis, [0.0015, 0.003, 0.0015], [0.0015, 0.003, 0.0015], 0.0026, 1.0)
    gains, phases, _ = crossings(exact)
    nearest = min(gains, key=lambda k: abs(np.log(k)))
    assert DECIBEL * np.log(actual.classical.gain_margin.value / nearest) == pytest.approx(0.0, abs=2e-3)
    assert np.degrees(actual.classical.phase_margin.value) == pytest.approx(np.degrees(min(phases, key=abs)), abs=1e-2)
    assert actual.robust.disk_margin == pytest.approx(disk_margin(exact, 1e-4), rel=1e-3)
    assert actual.agreement.agrees
    assert actual.stable
    assert actual.verdict == "fail"
