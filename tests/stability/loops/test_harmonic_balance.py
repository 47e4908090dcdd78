"""Limit cycles by harmonic balance: analysis/stability/harmonic_balance.py.

Truth: closed forms, python-control's describing_function_response, a dense grid, and loops simulated sample by sample
with a real relay or pulses, whose final oscillation is measured by ``find_oscillation`` (tested separately).
"""

import math

import control
import numpy as np
import pytest
from scipy.signal import cont2discrete

from perilune.analysis.stability.loops.describing_function import describing_function
from perilune.analysis.stability.loops.harmonic_balance import predict
from perilune.analysis.stability.loops.oscillation import find_oscillation


def third_order(gain):
    """Return gain/(s (s + 1)^2): -180 deg at 1 rad/s, where it is gain/2."""
    return lambda w: gain / (1j * w * (1j * w + 1.0) ** 2)


def only(balances):
    (balance,) = balances
    return balance


def stable_one(balances):
    return only([balance for balance in balances if balance.stable])


def test_ideal_relay():
    actual = only(predict(third_order(1.0), 1e-3, 1e2, "relay", {"level": 3.0}))
    assert actual.frequency == pytest.approx(1.0, rel=1e-9)
    assert actual.amplitude == pytest.approx(2.0 * 3.0 / math.pi, rel=1e-9)
    assert actual.stable


@pytest.mark.parametrize("excess", [1e-6, 1e-3, 0.1, 10.0, 1e4])
def test_relay_with_dead_zone(excess):
    """N(a) = 1/abs(L) is a quadratic in a^2; both solutions from just above the peak of N on."""
    level, dead_zone = 3.0, 0.2
    size = (1.0 + excess) * math.pi * dead_zone / (2.0 * level)  # of L at -180 deg
    square = np.sort(np.roots([(math.pi / (4.0 * level * size)) ** 2, -1.0, dead_zone**2]))
    parameters = {"level": level, "dead_zone": dead_zone}
    small, large = predict(third_order(2.0 * size), 1e-3, 1e2, "relay", parameters)
    assert [small.amplitude, large.amplitude] == pytest.approx(np.sqrt(square), rel=1e-6)
    assert [small.frequency, large.frequency] == pytest.approx([1.0, 1.0], rel=1e-9)
    assert not small.stable
    assert large.stable


def test_none_below_the_peak():
    size = 0.999 * math.pi * 0.2 / (2.0 * 3.0)
    assert predict(third_order(2.0 * size), 1e-3, 1e2, "relay", {"level": 3.0, "dead_zone": 0.2}) == []
    assert predict(third_order(1.99), 1e-3, 1e2, "saturation", {"limit": 1.0}) == []
    assert predict(third_order(1.99), 1e-3, 1e2, "dead zone", {"dead_zone": 1.0}) == []
    assert predict(lambda w: 1.0 / (1j * w + 1.0), 1e-3, 1e2, "relay", {"level": 1.0}) == []
    assert predict(lambda w: 1e-9 / (1j * w + 1.0), 1e-3, 1e2, "relay", {"level": 1.0, "hysteresis": 1.0}) == []


def test_saturation_against_python_control():
    actual = only(predict(third_order(6.0), 1e-3, 1e2, "saturation", {"limit": 1.0}))
    theirs = control.describing_function_response(
        control.tf([6.0], [1.0, 2.0, 1.0, 0.0]),
        control.saturation_nonlinearity(1.0),
        np.linspace(1.0, 20.0, 200),
        np.geomspace(0.1, 10.0, 500),
        warn_nyquist=False,
    )
    ((amplitude, frequency),) = theirs.intersections
    assert actual == pytest.approx((amplitude, frequency, True), rel=1e-4)


def test_dead_zone_grows_beyond_its_cycle():
    actual = only(predict(third_order(4.0), 1e-3, 1e2, "dead zone", {"dead_zone": 1.0}))
    assert describing_function("dead zone", actual.amplitude, {"dead_zone": 1.0}) == pytest.approx(0.5)
    assert not actual.stable


def test_conditionally_stable_loop():
    """(s + 1)^2/s^3 is stable for gains above 1/2 only: saturation makes a cycle beyond which it diverges."""
    actual = only(predict(lambda w: (1j * w + 1) ** 2 / (1j * w) ** 3, 1e-3, 1e2, "saturation", {"limit": 1.0}))
    assert actual.frequency == pytest.approx(1.0)
    assert describing_function("saturation", actual.amplitude, {"limit": 1.0}) == pytest.approx(0.5)
    assert not actual.stable


def test_quantiser_against_a_dense_grid():
    amplitude = np.linspace(0.4, 20.0, 30001)
    gains = describing_function("quantiser", amplitude, {"step": 1.0}).real
    for size in (0.97, 0.83):
        above = gains > 1.0 / size
        expected = amplitude[np.flatnonzero(above[1:] != above[:-1])]
        actual = predict(third_order(2.0 * size), 1e-3, 1e2, "quantiser", {"step": 1.0})
        actual = [balance for balance in actual if balance.amplitude < 19.9]
        expected = expected[expected < 19.9]
        assert [balance.amplitude for balance in actual] == pytest.approx(expected, abs=7e-4)
        # N crosses upwards and downwards in turn
        assert [balance.stable for balance in actual] == [i % 2 == 1 for i in range(len(actual))]
        assert len(actual) > 1


@pytest.mark.parametrize("hysteresis", [0.01, 0.1, 1.0])
def test_relay_with_hysteresis(hysteresis):
    """-1/N has the constant imaginary component -pi h/(4 M): with 1/(s (s + 1)) a cubic for the frequency."""
    actual = only(
        predict(lambda w: 1.0 / (1j * w * (1j * w + 1.0)), 1e-3, 1e2, "relay", {"level": 1.0, "hysteresis": hysteresis})
    )
    roots = np.roots([math.pi * hysteresis / 4.0, 0.0, math.pi * hysteresis / 4.0, -1.0])
    frequency = float(roots[abs(roots.imag) < 1e-9].real[0])
    size = 1.0 / (frequency * math.sqrt(1.0 + frequency**2))
    assert actual == pytest.approx((4.0 / math.pi * size, frequency, True), rel=1e-6)
    theirs = control.describing_function_response(
        control.tf([1.0], [1.0, 1.0, 0.0]),
        control.relay_hysteresis_nonlinearity(1.0, hysteresis),
        np.geomspace(1.001 * hysteresis, 100.0 * hysteresis, 300),
        np.geomspace(0.01, 30.0, 800),
        warn_nyquist=False,
    )
    assert actual[:2] == pytest.approx(theirs.intersections[0], rel=1e-3)


def test_three_level_relay_with_hysteresis():
    """-1/L = -j w (1 + j w)^2/gain has the angle 2 atan(w) - 90 deg: w from the angle of N, then a from its size."""
    parameters, gain = {"level": 1.0, "dead_zone": 0.1, "hysteresis": 0.003}, 0.5
    amplitude = np.geomspace(0.10301, 2.0, 200001)
    values = describing_function("relay", amplitude, parameters)
    frequency = np.tan(0.5 * (np.angle(values) + 0.5 * math.pi))
    above = frequency * (1.0 + frequency**2) / gain < abs(values)
    expected = np.flatnonzero(above[1:] != above[:-1])
    actual = predict(third_order(gain), 1e-3, 1e2, "relay", parameters)
    assert [balance.amplitude for balance in actual] == pytest.approx(amplitude[expected], rel=1e-4)
    assert [balance.frequency for balance in actual] == pytest.approx(frequency[expected], rel=1e-3)
    assert [balance.stable for balance in actual] == [False, True]


def test_only_the_slowest_cycle_of_a_delay_is_stable():
    """Loeb's rule alone would take every odd turn; but the gain of each makes all slower pairs unstable."""

    def response(w):
        return np.exp(-1j * w) / (1j * w + 1.0)

    actual = predict(response, 1e-2, 30.0, "relay", {"level": 1.0})
    assert len(actual) > 3
    assert actual[-1].stable  # the largest is the slowest
    assert not any(balance.stable for balance in actual[:-1])


@pytest.mark.parametrize(
    ("kind", "parameters"),
    [
        ("relay", {"level": 0.3}),
        ("relay", {"level": 0.3, "dead_zone": 0.1}),
        ("relay", {"level": 0.3, "dead_zone": 0.1, "hysteresis": 0.02}),
        ("relay", {"level": 0.3, "dead_zone": 0.1, "hysteresis": 0.2}),
        ("dead zone", {"dead_zone": 0.1}),
        ("saturation", {"limit": 0.3}),
        ("quantiser", {"step": 0.1}),
        ("pulse width", {"level": 0.3, "dead_zone": 0.1, "gain": 2.0}),
    ],
)
def test_every_solution_balances(kind, parameters):
    """Random stable sampled loops of third order: what is found solves 1 + N L = 0 between the frequencies."""
    count = 0
    for seed in range(8):
        random = np.random.default_rng(seed)
        poles = np.append(random.uniform(0.3, 0.99), random.uniform(0.5, 0.97) * np.exp(1j * random.uniform(0, 2)))
        zeros, size = random.uniform(-1.5, 1.5, 2), random.uniform(0.02, 1.0)

        def response(w, poles=poles, zeros=zeros, size=size):
            z = np.exp(1j * w)
            below = (z - poles[0]) * (z - poles[1]) * (z - poles[1].conjugate())
            return size * (z - zeros[0]) * (z - zeros[1]) / below

        for amplitude, frequency, _ in predict(response, 1e-3, math.pi, kind, parameters, points=1000):
            gain = describing_function(kind, amplitude, parameters)
            assert abs(1.0 + gain * response(frequency)) < 1e-5
            assert 1e-3 < frequency < math.pi
            count += 1
    assert count > 3


@pytest.mark.parametrize(
    ("low", "high", "kind", "parameters", "text"),
    [
        (0.0, 1.0, "relay", {"level": 1.0}, "not an interval"),
        (2.0, 1.0, "relay", {"level": 1.0}, "not an interval"),
        (0.1, 1.0, "relay", {}, "lacks its parameter"),
        (0.1, 1.0, "rely", {}, "not a kind"),
    ],
)
def test_wrong_arguments(low, high, kind, parameters, text):
    with pytest.raises(ValueError, match=text):
        predict(third_order(1.0), low, high, kind, parameters)


def test_response_has_to_be_finite():
    with pytest.raises(ValueError, match="one finite complex number"):
        predict(lambda w: np.full(len(w), np.nan + 0j), 0.1, 1.0, "relay", {"level": 1.0})


class Jet:
    """Double integrator, error -x, Tustin lead gain (lead s + 1)/(lag s + 1), relay, whole samples of delay, hold."""

    def __init__(self, gain, lead, lag, period, delay, level, dead_zone, hysteresis=0.0):
        self.gain, self.lead, self.lag, self.period, self.delay = gain, lead, lag, period, delay
        self.relay = {"level": level, "dead_zone": dead_zone, "hysteresis": hysteresis}

    def response(self, w):
        z = np.exp(1j * w * self.period)
        s = 2.0 / self.period * (z - 1.0) / (z + 1.0)
        compensator = self.gain * (self.lead * s + 1.0) / (self.lag * s + 1.0)
        return compensator * z**-self.delay * self.period**2 * (z + 1.0) / (2.0 * (z - 1.0) ** 2)

    def predict(self):
        return predict(self.response, 1e-4 / self.period, math.pi / self.period, "relay", self.relay)

    def fly(self, position, velocity, samples):
        """Simulate the input of the relay at every sample."""
        (numerator,), denominator, _ = cont2discrete(
            ([self.gain * self.lead, self.gain], [self.lag, 1.0]), self.period, method="bilinear"
        )
        level, on, off = (
            self.relay["level"],
            self.relay["dead_zone"] + self.relay["hysteresis"],
            self.relay["dead_zone"] - self.relay["hysteresis"],
        )
        h, error, command, output = self.period, 0.0, 0.0, 0.0
        queue, commands = [0.0] * self.delay, np.empty(samples)
        for i in range(samples):
            command = numerator[0] * -position + numerator[1] * error - denominator[1] * command
            error = -position
            commands[i] = command
            if output * command <= abs(output) * off:
                output = 0.0
            if abs(command) > on:
                output = math.copysign(level, command)
            queue.append(output)
            force = queue.pop(0)
            position += h * velocity + 0.5 * h * h * force
            velocity += h * force
        return commands

    def errors(self, position=1.0, velocity=0.0, cycles=60):
        """Return relative errors of amplitude and period; the start in units of the predicted amplitude."""
        cycle = stable_one(self.predict())
        period = 2.0 * math.pi / cycle.frequency
        scale = cycle.amplitude / self.gain
        commands = self.fly(position * scale, velocity * scale, round(cycles * period / self.period))
        actual = find_oscillation(np.arange(len(commands)) * self.period, commands)
        assert actual is not None
        return cycle.amplitude / actual.amplitude - 1.0, period / actual.period - 1.0


# Positions and velocities; a sampled loop has several cycles near the predicted one, and the start chooses.
STARTS = [(1.0, 0.0), (2.0, 0.1), (6.0, 0.0), (-1.3, 0.07)]  # in predicted amplitudes


@pytest.mark.parametrize("start", STARTS)
@pytest.mark.parametrize(
    "jet",
    [
        Jet(0.01, 20.0, 2.0, 0.25, 16, 0.06, 0.02),
        Jet(0.01, 20.0, 2.0, 0.25, 20, 0.06, 0.03),
        Jet(0.16, 5.0, 0.5, 0.1, 6, 0.05, 0.0125),
        Jet(0.2, 4.0, 0.4, 0.1, 12, 0.05, 0.025),
    ],
    ids=["0.25 s", "0.25 s, more delay", "0.1 s", "0.1 s, more delay"],
)
def test_sampled_relay_loop(jet, start):
    """Loops that end within 5 % from every one of 64 starts; one with fewer samples to a cycle is further down."""
    assert np.max(np.abs(jet.errors(*start))) < 0.05


@pytest.mark.parametrize(
    "jet",
    [
        Jet(0.16, 2.0, 0.2, 0.01, 40, 0.05, 0.0025),
        Jet(0.2, 4.0, 0.4, 0.02, 60, 0.05, 0.025),
        Jet(0.01, 20.0, 2.0, 0.05, 80, 0.06, 0.02),
        Jet(0.16, 5.0, 0.5, 0.01, 100, 0.05, 0.01),
    ],
    ids=["2 s lead", "4 s lead", "20 s lead", "5 s lead"],
)
def test_relay_loop_in_continuous_time(jet):
    """Hundreds of samples to a cycle."""
    assert np.max(np.abs(jet.errors(2.0, 0.1, cycles=40))) < 0.05


@pytest.mark.parametrize(
    ("jet", "worst_amplitude", "worst_period"),
    [
        # little lead: the plant integrates twice, but the relay's input is a parabola with the corners of the lead
        (Jet(0.16, 3.0, 1.0, 0.01, 50, 0.05, 0.0025), 0.12, 0.08),
        (Jet(0.16, 3.0, 1.0, 0.01, 100, 0.05, 0.01), 0.18, 0.12),
        # a dead zone a fiftieth of the cycle: nearly a square wave, with all of its third harmonic
        (Jet(0.16, 5.0, 0.417, 0.25, 8, 0.05, 0.0025), 0.17, 0.14),
        # thirty samples to a cycle: its length is a whole number of samples, and which one the start decides
        (Jet(0.01, 20.0, 2.0, 1.0, 4, 0.06, 0.02), 0.03, 0.03),
    ],
    ids=["little lead", "little lead, more delay", "small dead zone", "few samples"],
)
def test_where_the_method_is_worse(jet, worst_amplitude, worst_period):
    """Outside its hypothesis the real cycle is larger and slower than predicted, by up to a sixth or so."""
    amplitude, period = np.min([jet.errors(*start, cycles=40) for start in [(0.5, 0.0), *STARTS]], axis=0)
    assert -amplitude == pytest.approx(worst_amplitude, abs=0.01)
    assert -period == pytest.approx(worst_period, abs=0.01)


@pytest.mark.parametrize("hysteresis", [0.002, 0.005, 0.008])
def test_sampled_relay_with_hysteresis(hysteresis):
    assert np.max(np.abs(Jet(0.01, 20.0, 2.0, 0.25, 16, 0.06, 0.02, hysteresis).errors(2.0, 0.1))) < 0.05


def simulate(gain, element, start, period=0.02, end=200.0):
    """Simulate gain/(s (s + 1)^2) with the element in the loop; return the input of the element over time."""
    a, b, c, _, _ = cont2discrete(
        (
            np.array([[0.0, 1.0, 0.0], [0.0, -1.0, 1.0], [0.0, 0.0, -1.0]]),
            np.array([[0.0], [0.0], [gain]]),
            np.array([[1.0, 0.0, 0.0]]),
            np.zeros((1, 1)),
        ),
        period,
    )
    state, inputs = np.array([start, 0.0, 0.0]), np.empty(round(end / period))
    for i in range(len(inputs)):
        inputs[i] = -(c @ state)[0]
        state = a @ state + b[:, 0] * element(inputs[i])
    return np.arange(len(inputs)) * period, inputs


def test_the_unstable_cycle_divides_the_starts():
    parameters = {"level": 1.0, "dead_zone": 0.2}
    small, large = predict(third_order(1.0), 1e-3, 1e2, "relay", parameters)

    def relay(x):
        return math.copysign(1.0, x) if abs(x) > 0.2 else 0.0

    assert find_oscillation(*simulate(1.0, relay, 0.9 * small.amplitude)) is None
    actual = find_oscillation(*simulate(1.0, relay, 5.0 * small.amplitude))
    assert actual is not None
    assert actual.amplitude == pytest.approx(large.amplitude, rel=0.05)
    assert actual.period == pytest.approx(2.0 * math.pi / large.frequency, rel=0.05)


def test_pulse_width_flown_pulse_by_pulse():
    """Pulses at the start of periods of 0.2 s, a thirtieth of a cycle; on and off in steps of a fiftieth of those."""
    gain, period, parts = 6.0, 0.2, 50
    parameters = {"level": 0.5, "dead_zone": 0.05}

    def response(w):  # with the delay of the hold
        return third_order(gain)(w) * np.exp(-0.5j * w * period)

    cycle = stable_one(predict(response, 1e-3, 15.0, "pulse width", parameters))
    held = {"tick": 0, "width": 0, "level": 0.0}

    def modulator(x):
        if held["tick"] % parts == 0:
            fraction = min(abs(x) / 0.5, 1.0)
            held["width"] = round(parts * fraction) if abs(x) >= 0.05 else 0
            held["level"] = math.copysign(0.5, x)
        on = held["tick"] % parts < held["width"]
        held["tick"] += 1
        return held["level"] if on else 0.0

    actual = find_oscillation(*simulate(gain, modulator, 2.0, period / parts, 150.0))
    assert actual is not None
    assert actual.amplitude == pytest.approx(cycle.amplitude, rel=0.05)
    assert actual.period == pytest.approx(2.0 * math.pi / cycle.frequency, rel=0.05)
