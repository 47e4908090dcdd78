"""Describing functions: analysis/stability/describing_function.py.

Truth: the Fourier integral of each element, by scipy's adaptive quadrature between its switching points;
python-control's describing functions of the elements that it supports; known peaks and limits.
"""

import math
from itertools import pairwise

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from perilune.analysis.stability.loops.describing_function import (
    ELEMENTS,
    amplitude_range,
    complete_parameters,
    describing_function,
)

sizes = st.floats(0.01, 100.0)
shares = st.floats(0.0, 3.0)


def gain(kind, amplitude, **parameters):
    return complex(describing_function(kind, np.array([amplitude]), parameters)[0])


def fourier(output, amplitude, thresholds=()):
    """Integrate N(a) by quadrature: ``output(x, falling)``, the input falls in the second and
    third quarter of the cycle."""
    turns = [math.pi / 2, math.pi, 3 * math.pi / 2]
    for threshold in thresholds:
        if abs(threshold) < amplitude:
            angle = math.asin(threshold / amplitude) % (2 * math.pi)
            turns += [angle, (math.pi - angle) % (2 * math.pi)]
    edges = sorted({0.0, 2 * math.pi, *turns})

    def integral(weight):
        def integrand(theta):
            return output(amplitude * math.sin(theta), math.cos(theta) < 0.0) * weight(theta)

        return sum(quad(integrand, low, high)[0] for low, high in pairwise(edges))

    return complex(integral(math.sin), integral(math.cos)) / (math.pi * amplitude)


def relay_law(level, dead_zone, hysteresis):
    """Return the relay's output over a cycle that switches it: the branch is known from the direction of the input."""

    def output(x, falling):
        on, off = dead_zone + hysteresis, dead_zone - hysteresis
        if falling:
            return level if x > off else (-level if x < -on else 0.0)
        return -level if x < -off else (level if x > on else 0.0)

    return output


@given(sizes, sizes, shares, st.floats(1.001, 30.0))
def test_relay(level, dead_zone, share, ratio):
    hysteresis = share * dead_zone
    on, off = dead_zone + hysteresis, dead_zone - hysteresis
    expected = fourier(relay_law(level, dead_zone, hysteresis), ratio * on, (on, -on, off, -off))
    actual = gain("relay", ratio * on, level=level, dead_zone=dead_zone, hysteresis=hysteresis)
    assert actual == pytest.approx(expected, rel=1e-7, abs=1e-9 * level / on)


@given(sizes, sizes, st.floats(1.001, 30.0))
def test_relay_with_hysteresis_is_that_of_python_control(level, hysteresis, ratio):
    expected = control.relay_hysteresis_nonlinearity(level, hysteresis).describing_function(ratio * hysteresis)
    assert gain("relay", ratio * hysteresis, level=level, hysteresis=hysteresis) == pytest.approx(expected, rel=1e-9)


def test_relay_that_is_not_switched_puts_nothing_out():
    assert gain("relay", 0.99, level=2.0, dead_zone=1.0) == 0.0
    assert gain("relay", 1.49, level=2.0, dead_zone=1.0, hysteresis=0.5) == 0.0


def test_ideal_relay_is_the_fundamental_of_a_square_wave():
    assert gain("relay", 3.0, level=2.0) == pytest.approx(4.0 * 2.0 / (math.pi * 3.0))


def test_relay_peak():
    amplitude = np.linspace(1.0, 3.0, 200001)
    values = describing_function("relay", amplitude, {"level": 0.5, "dead_zone": 1.0}).real
    assert values.max() == pytest.approx(2.0 * 0.5 / math.pi, rel=1e-9)
    assert amplitude[values.argmax()] == pytest.approx(math.sqrt(2.0), abs=1e-4)


@given(sizes, st.floats(0.1, 30.0))
def test_saturation_is_that_of_python_control(limit, ratio):
    expected = control.saturation_nonlinearity(limit).describing_function(ratio * limit)
    assert gain("saturation", ratio * limit, limit=limit) == pytest.approx(expected, rel=1e-9)


@given(sizes, st.floats(0.1, 30.0))
def test_saturation_and_dead_zone(size, ratio):
    amplitude = ratio * size

    def clipped(x, falling):
        return min(max(x, -size), size)

    expected = fourier(clipped, amplitude, (size, -size))
    assert gain("saturation", amplitude, limit=size) == pytest.approx(expected, rel=1e-7, abs=1e-9)
    expected = fourier(lambda x, falling: x - clipped(x, falling), amplitude, (size, -size))
    assert gain("dead zone", amplitude, dead_zone=size) == pytest.approx(expected, rel=1e-7, abs=1e-9)


@given(sizes, st.floats(0.1, 12.0))
def test_quantiser(step, ratio):
    thresholds = [(k + 0.5) * step for k in range(-13, 13)]
    expected = fourier(lambda x, falling: step * math.floor(x / step + 0.5), ratio * step, thresholds)
    assert gain("quantiser", ratio * step, step=step) == pytest.approx(expected, rel=1e-6, abs=1e-8)


def test_quantiser_against_python_control_and_its_limit():
    class Quantiser(control.DescribingFunctionNonlinearity):
        def __call__(self, x):
            return math.floor(x + 0.5)

        def _isstatic(self):
            return True

    amplitude = np.array([0.7, 1.2, 3.3, 9.0])
    expected = control.describing_function(Quantiser(), amplitude, num_points=20000)
    assert describing_function("quantiser", amplitude, {"step": 1.0}) == pytest.approx(expected, rel=1e-3, abs=1e-3)
    # one level only: a relay one step high with a dead zone of half a step
    assert gain("quantiser", 1.2, step=1.0) == gain("relay", 1.2, level=1.0, dead_zone=0.5)
    assert gain("quantiser", 1e5, step=1.0) == pytest.approx(1.0, abs=1e-6)


@given(sizes, sizes, st.floats(0.0, 1.0), st.floats(0.05, 30.0))
def test_pulse_width(level, slope, share, ratio):
    full = level / slope
    dead_zone = share * full

    def mean(x, falling):
        return 0.0 if abs(x) < dead_zone else min(max(slope * x, -level), level)

    expected = fourier(mean, ratio * full, (full, -full, dead_zone, -dead_zone))
    actual = gain("pulse width", ratio * full, level=level, dead_zone=dead_zone, gain=slope)
    assert actual == pytest.approx(expected, rel=1e-6, abs=1e-8 * slope)


def test_pulses_of_a_slow_sine_have_this_fundamental():
    """The assumption itself: pulses flown one by one, 200 periods of modulation to a cycle, centred in the period."""
    level, shortest, amplitude, periods = 2.0, 0.2, 3.0, 200
    centre = (np.arange(periods) + 0.5) * 2.0 * np.pi / periods
    command = amplitude * np.sin(centre)
    duty = np.minimum(abs(command) / level, 1.0)
    duty[duty < shortest] = 0.0
    half = duty * np.pi / periods
    # the integral of exp(j(pi/2 - theta)) over each pulse, exactly
    fundamental = np.sum(np.sign(command) * level * 2.0 * np.sin(half) * (np.sin(centre) + 1j * np.cos(centre)))
    actual = gain("pulse width", amplitude, level=level, dead_zone=shortest * level)
    assert actual == pytest.approx(fundamental / (np.pi * amplitude), rel=5e-3)


def test_pulse_width_with_all_of_it_dead_is_a_relay():
    assert gain("pulse width", 3.0, level=2.0, dead_zone=2.0) == pytest.approx(
        gain("relay", 3.0, level=2.0, dead_zone=2.0)
    )


EXAMPLES = {
    "relay": {"level": 2.0, "dead_zone": 0.5},
    "dead zone": {"dead_zone": 0.5},
    "saturation": {"limit": 0.5},
    "quantiser": {"step": 0.5},
    "carried pulses": {"least_pulse": 0.5},
    "pulse width": {"level": 2.0, "dead_zone": 0.5},
}


@pytest.mark.parametrize("kind", ELEMENTS)
def test_what_an_element_says_of_itself(kind):
    """The bound from the largest output, the range for a figure, the shape of the result."""
    parameters = complete_parameters(kind, EXAMPLES[kind])
    element = ELEMENTS[kind]
    low, high = amplitude_range(kind, EXAMPLES[kind])
    amplitude = np.geomspace(low, high, 60).reshape(3, 20)
    values = describing_function(kind, amplitude, EXAMPLES[kind])
    assert values.shape == (3, 20)
    assert values.dtype == complex
    assert np.all(abs(values) <= 4.0 * element.output(parameters) / (math.pi * amplitude) + 1e-12)
    assert np.ptp(abs(values)) > 0.1
    if math.isfinite(element.farthest(parameters)):
        far = element.farthest(parameters) * np.geomspace(1.0, 10.0, 50)
        assert np.all(abs(describing_function(kind, far, EXAMPLES[kind]) - 1.0) < 1e-3)


@pytest.mark.parametrize("amplitude", [0.0, -1.0, math.inf, math.nan])
def test_amplitudes_are_positive(amplitude):
    with pytest.raises(ValueError, match="amplitudes"):
        gain("saturation", amplitude, limit=1.0)


@pytest.mark.parametrize(
    ("kind", "parameters", "text"),
    [
        ("rely", {}, "'rely' is not a kind of element; choose one of relay, "),
        ("relay", {}, r"relay lacks its parameter 'level'; it takes level \(unit of the output\), dead_zone"),
        ("relay", {"level": 1.0, "deadzone": 1.0}, "relay has no parameter 'deadzone'"),
        ("relay", {"level": 0.0}, "level = 0.0 is not above 0"),
        ("relay", {"level": 1.0, "dead_zone": -1.0}, "dead_zone = -1.0 is negative"),
        ("quantiser", {"step": math.nan}, "step = nan is not a finite number"),
        ("quantiser", {"step": "1"}, "step = '1' is not a finite number"),
        ("quantiser", {"step": True}, "step = True is not a finite number"),
        ("pulse width", {"level": 1.0, "dead_zone": 2.0}, "dead_zone = 2.0 exceeds level/gain = 1.0"),
    ],
)
def test_wrong_parameters(kind, parameters, text):
    with pytest.raises(ValueError, match=text):
        complete_parameters(kind, parameters)


@given(sizes, st.floats(0.501, 12.0))
def test_carried_pulses_are_a_staircase_that_lags(least, ratio):
    """The element itself, stepped along a sine of the integrated demand until it repeats: 1 % of N."""
    if abs(ratio % 1.0 - 0.5) < 0.02:
        return  # at a step's very threshold
    amplitude, points = ratio * least, 20000
    angle = np.linspace(0.0, 2.0 * math.pi, points, endpoint=False)
    fired, rows = -0.5 * least, []
    for demanded in np.tile(amplitude * np.sin(angle), 2):
        while demanded - fired >= least:
            fired += least
        while fired - demanded >= least:
            fired -= least
        rows.append(fired)
    wave = np.array(rows[points:])
    expected = 2.0 / (points * amplitude) * complex(wave @ np.sin(angle), wave @ np.cos(angle))
    assert gain("carried pulses", amplitude, least_pulse=least) == pytest.approx(expected, rel=0.01, abs=0.003)
