"""Stability of satellite_pointing by both methods, compared with the same loop in closed form.

Truth: support/loops/exact_satellite.py, which is independent of the FMUs, with margins by python-control; for
proportional and derivative gains alone, the margins of a double integrator behind a hold, by hand.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import perilune
from tests.support.loops.exact_margins import crossings, disk_margin
from tests.support.loops.exact_satellite import DAMPING, FREQUENCY, TICK, loop
from tests.support.loops.sampled_loops import response_of

pytestmark = pytest.mark.usefixtures("fmus")
DECIBEL = 20.0 / np.log(10.0)


@pytest.fixture(scope="module")
def channels(fmus):
    """Return the three channels at both points."""
    loops = perilune.stability("satellite_pointing").loops
    assert [(each.name, each.point) for each in loops] == [
        (f"attitude[{axis}]", point) for point in ("truth", "filter") for axis in (1, 2, 3)
    ]
    return loops


def test_margins(channels):
    """With the filter as with the truth: it passes on what the gyros measure, and stars correct it slowly."""
    for number, channel in enumerate(channels):
        exact = loop(number % 3)
        gain, phase, frequency = crossings(exact)
        assert channel.sample_period == pytest.approx(TICK)
        gains = sorted(each.value for each in channel.classical.gain)
        np.testing.assert_allclose(gains, sorted(gain), rtol=2e-3)
        assert np.degrees(channel.classical.phase_margin.value) == pytest.approx(np.degrees(phase[0]), abs=0.02)
        assert channel.classical.phase_margin.frequency == pytest.approx(frequency[0], rel=2e-4)
        assert channel.robust.disk_margin == pytest.approx(disk_margin(exact), rel=1e-3)
        assert channel.verdict == "pass"


def test_responses_by_both_routes(channels):
    """From a third of the crossover on: below it friction of the wheels begins to count."""
    for number, channel in enumerate(channels[:3]):
        response = response_of(loop(number))
        for curve in (channel.curve, channel.measured_response.curve):
            inside = (curve.frequency > 0.2) & (curve.frequency < 0.5 * math.pi / TICK)
            assert inside.sum() > 10
            error = np.abs(curve.value[inside] / response(curve.frequency[inside]) - 1.0)
            assert error.max() < 2e-3


@pytest.mark.slow  # test_margins has the same loop with the integral, at two points
def test_without_integral_it_is_a_double_integrator_behind_a_hold(fmus):
    """L = (k + c s)/s^2 sampled: k T^2/2 (z + 1)/(z - 1)^2 + c T/(z - 1). The wheels are 3e-4 of the inertia.

    On the circle, with a = w T: (k T^2/4 + j c T/2 tan(a/2)) (-cos(a/2)/sin(a/2)^2) exp(-j a/2).
    """
    k, c = FREQUENCY**2, 2.0 * DAMPING * FREQUENCY

    def size(a):
        real, imaginary = k * TICK**2 / 4.0, c * TICK / 2.0 * math.tan(0.5 * a)
        return math.hypot(real, imaginary) * math.cos(0.5 * a) / math.sin(0.5 * a) ** 2

    a = brentq(lambda a: size(a) - 1.0, 1e-3, 1.0)
    phase = math.atan(c * TICK / 2.0 * math.tan(0.5 * a) / (k * TICK**2 / 4.0)) - 0.5 * a
    result = perilune.stability("satellite_pointing", set={"control.integral_time": 0.0})
    for channel in result.loops[:3]:
        assert channel.classical.phase_margin.frequency == pytest.approx(a / TICK, rel=1e-3)
        assert channel.classical.phase_margin.value == pytest.approx(phase, abs=1e-3)
        # at the Nyquist frequency L is real: -L = c T/2, so that the gain margin is 2/(c T)
        largest = max(each.value for each in channel.classical.gain)
        assert DECIBEL * math.log(largest) == pytest.approx(DECIBEL * math.log(2.0 / (c * TICK)), abs=0.01)
