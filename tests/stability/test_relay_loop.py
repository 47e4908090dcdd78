"""Limit cycle of a relay with dead zone in a system of FMUs, predicted from a linear study and simulated.

Truth: harmonic balance solved by hand on python-control's loop gain, with the closed form of the relay's describing
function (Gelb and Vander Velde 1968, appendix B), and the Fourier series of the simulation.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

import perilune
from tests.support.loops.exact_systems import relay_loop
from tests.support.loops.sampled_loops import response_of

LEVEL, DEAD_ZONE = 0.06, 0.02


@pytest.fixture(scope="module")
def path(exact_fmus, tmp_path_factory):
    return relay_loop(exact_fmus / "three_level_relay.fmu").packed(tmp_path_factory.mktemp("relay"), exact_fmus)


@pytest.fixture(scope="module")
def element(path):
    (loop,) = perilune.stability(path).loops
    (actual,) = loop.nonlinearities
    return actual


@pytest.fixture(scope="module")
def balance(exact_fmus):
    """Return amplitudes, the smaller one first, and period (s) at which 1 + N L = 0."""
    response = response_of(relay_loop(exact_fmus / "three_level_relay.fmu").loop)

    def linear(w):
        return complex(response(np.array([w]))[0])

    w = brentq(lambda w: linear(w).imag, 0.19, 0.3)

    def excess(a):
        return 4.0 * LEVEL / (np.pi * a) * np.sqrt(1.0 - (DEAD_ZONE / a) ** 2) * -linear(w).real - 1.0

    top = np.sqrt(2.0) * DEAD_ZONE
    return brentq(excess, DEAD_ZONE, top), brentq(excess, top, 100.0 * DEAD_ZONE), 2.0 * np.pi / w


def test_predicted_from_the_linear_rest(element, balance):
    assert (element.name, element.kind, element.unit) == ("jets", "relay", "m/s2")
    assert element.parameters == {"level": LEVEL, "dead_zone": DEAD_ZONE, "hysteresis": 0.0}
    small, large = element.cycles
    assert [small.stable, large.stable] == [False, True]
    assert [small.amplitude, large.amplitude] == pytest.approx(balance[:2], rel=1e-5)
    assert [small.period, large.period] == pytest.approx([balance[2]] * 2, rel=1e-5)
    assert large.amplitude == pytest.approx(0.0597, rel=1e-3)
    assert large.period == pytest.approx(27.9, rel=1e-3)


def test_flown_with_the_relay_itself(element):
    """As far as the loop filters the third harmonic, which is the method's own error."""
    small, large = element.cycles
    assert small.simulated_amplitude is None
    assert large.simulated_amplitude == pytest.approx(large.amplitude, rel=0.05)
    assert large.simulated_period == pytest.approx(large.period, rel=0.05)


def test_the_flight_is_what_the_report_says(element, path, exact_fmus):
    flight = perilune.simulate(path, use={"jets": str(exact_fmus / "three_level_relay.fmu")})
    signal, step = flight["lead.y"][4000:], flight.time[1]
    period = element.cycles[1].simulated_period
    samples = round(int(len(signal) * step / period) * period / step)  # whole cycles
    spectrum = 2.0 * abs(np.fft.rfft(signal[:samples])) / samples
    line = int(np.argmax(spectrum))
    assert samples * step / line == pytest.approx(period, rel=0.01)
    assert spectrum[line] == pytest.approx(element.cycles[1].simulated_amplitude, rel=0.02)
    assert set(np.unique(flight["jets.y"])) == {-LEVEL, 0.0, LEVEL}
