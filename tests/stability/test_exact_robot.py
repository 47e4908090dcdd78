"""The robot's loops in closed form, compared with simulations of the complete system without noise, and their margins.

Truth: two simulations that differ in their initial state, or in an error of the ranger, differ as predicted by the
closed form, since the loops are linear below saturation. Crossings by bisection on L(z) and by python-control.
"""

import numpy as np
import pytest
from scipy.optimize import brentq

import perilune
from tests.support.loops.exact_robot import attitude_loop, translation_loop

PER_SECOND = 8  # communication points
TICKS = 100
QUIET = {"ranger.far_sigma": 0.0, "ranger.near_sigma": 0.0, "star.attitude_sigma": 0.0}
LOOPS = {"8 s": translation_loop(8.0), "4 s": translation_loop(4.0), "attitude": attitude_loop()}
# Gain margin (dB), phase margin (deg) and modulus margin, exact; and with means as interpolated delays.
EXACT = {"8 s": (12.39, 44.28, 0.597), "4 s": (12.82, 44.94, 0.607), "attitude": (16.10, 49.14, 0.667)}
INTERPOLATED = {"8 s": (12.6, 44.0), "4 s": (13.1, 45.0), "attitude": (16.5, 49.0)}
each_loop = pytest.mark.parametrize("name", LOOPS)


def flight(settings, stop_time, faults=()):
    return perilune.simulate(
        "robot_rendezvous",
        use={"jets": "jet_allocation_pseudo_inverse"},
        parameters=["paper.ssv"],
        set=QUIET | settings,
        stop_time=stop_time,
        faults=faults,
    )


def difference(one, other, name, period, start=0.0):
    """Return the difference of a signal at ticks from ``start`` (s) on."""
    rows = np.arange(TICKS) * round(period * PER_SECOND) + round(start * PER_SECOND)
    return (one[name] - other[name])[rows]


def assert_near(actual, expected, tolerance):
    assert actual == pytest.approx(expected, abs=tolerance * np.max(np.abs(expected)))


@each_loop
def test_polynomials_and_states_are_the_same_loop(name):
    loop = LOOPS[name]
    frequency = np.pi / loop.period * np.geomspace(1e-3, 1.0, 50)
    a, b, c = loop.state_space
    states = [c @ np.linalg.solve(z * np.eye(5) - a, b) for z in np.exp(1j * frequency * loop.period)]
    assert loop.response(frequency) == pytest.approx(np.array(states), rel=1e-8)


@pytest.mark.parametrize(
    ("name", "numerator"),
    [("8 s", [1, 281, 651, 91]), ("4 s", [0, 240, 672, 112]), ("attitude", [0, 64, 640, 320])],
)
def test_the_plant_is_the_rational_one(name, numerator):
    """T^2 N(z)/(1024 z^2 (z - 1)^2), by hand in fractions."""
    loop = LOOPS[name]
    z = np.exp(1j * np.linspace(0.1, 3.0, 20))
    lead = loop.gain * (2.0 * loop.lead_time * (z - 1) + loop.period * (z + 1))
    lag = 2.0 * loop.lag_time * (z - 1) + loop.period * (z + 1)
    plant = loop.period**2 / 1024.0 * np.polynomial.polynomial.polyval(z, numerator) / (z * (z - 1)) ** 2
    assert loop(z) == pytest.approx(lead / lag * plant, rel=1e-12)


@each_loop
def test_at_low_frequencies_the_loop_is_lead_double_integrator_and_the_delays(name):
    """exp(-s (d + T/2 + (n - 1)/2 T/n)) C(s)/s^2: the hold's half period, the jets' delay, the mean's samples."""
    loop = LOOPS[name]
    s = 1j * 1e-3 / loop.period
    lag = loop.delay + loop.period / 2.0 + (loop.samples - 1) / 2.0 * loop.period / loop.samples
    expected = loop.gain * (loop.lead_time * s + 1) / (loop.lag_time * s + 1) / s**2 * np.exp(-s * lag)
    assert loop.response(s.imag) == pytest.approx(expected, rel=1e-6)


@each_loop
def test_margins(name):
    loop = LOOPS[name]
    gain, phase, modulus = EXACT[name]
    actual = loop.margins
    assert actual.gain == pytest.approx(gain, abs=0.006)
    assert actual.phase == pytest.approx(phase, abs=0.006)
    assert actual.modulus == pytest.approx(modulus, abs=6e-4)
    near_gain, near_phase = INTERPOLATED[name]
    assert actual.gain == pytest.approx(near_gain, abs=0.45)
    assert actual.phase == pytest.approx(near_phase, abs=0.35)
    assert np.max(np.abs(loop.poles)) < 1.0


@each_loop
def test_margins_by_bisection(name):
    loop = LOOPS[name]
    nyquist = np.pi / loop.period
    crossover = brentq(lambda w: abs(loop.response(w)) - 1.0, 1e-3 * nyquist, nyquist)
    assert np.degrees(np.angle(-loop.response(crossover))) == pytest.approx(loop.margins.phase, abs=1e-6)
    # the phase of -L falls from its lead through 0 above the crossover
    turn = brentq(lambda w: np.angle(-loop.response(w)), crossover, 0.99 * nyquist)
    assert -20.0 * np.log10(abs(loop.response(turn))) == pytest.approx(loop.margins.gain, abs=1e-6)
    frequency = np.linspace(1e-3, 1.0, 100_001) * nyquist
    assert np.min(np.abs(1.0 + loop.response(frequency))) == pytest.approx(loop.margins.modulus, abs=1e-6)


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize(("period", "settings"), [(8.0, {}), (4.0, {"guidance.slow_period": 4.0})])
def test_translation_flies_as_the_closed_loop(period, settings):
    loop = translation_loop(period)
    starts = [(0.05, 0.0), (-0.02, 0.0), (0.0, 2e-4)]
    offset = {f"robot.initial_position[{axis}]": x for axis, (x, _) in enumerate(starts, 1)}
    offset |= {f"robot.initial_velocity[{axis}]": v for axis, (_, v) in enumerate(starts, 1)}
    plan = flight(settings, TICKS * period)
    actual = flight(settings | offset, TICKS * period)
    assert not actual["jets.status"].any()
    for axis, (x, v) in enumerate(starts, 1):
        expected = loop.closed(x, v, np.zeros(TICKS))
        for column, name in enumerate(("robot.position", "robot.velocity", "translation_filter.position_error")):
            change = difference(actual, plan, f"{name}[{axis}]", period)
            assert_near(change, expected[:, column], 1e-9)


@pytest.mark.usefixtures("fmus")
def test_an_error_of_the_ranger_in_hold_is_followed_as_by_the_closed_loop():
    """From the middle of a mean on: of the samples at 4401 to 4404 s the first is right."""
    error, start = 0.02, 4400.0
    plan = flight({}, start + 4.0 * TICKS)
    fault = perilune.Fault("ranger.robot_position[1]", "bias", error, 4401.5)
    actual = flight({}, start + 4.0 * TICKS, [fault])
    assert not actual["jets.status"].any()
    expected = translation_loop(4.0).closed(0.0, 0.0, error * np.array([0.0, 0.75] + [1.0] * (TICKS - 2)))
    for column, name in [(0, "robot.position"), (1, "robot.velocity"), (2, "translation_filter.position_error")]:
        assert_near(difference(actual, plan, f"{name}[1]", 4.0, start), expected[:, column], 1e-8)
        for axis in (2, 3):
            across = difference(actual, plan, f"{name}[{axis}]", 4.0, start)
            assert across == pytest.approx(np.zeros(TICKS), abs=1e-8 * error)


@pytest.mark.usefixtures("fmus")
@pytest.mark.parametrize("axis", [1, 2, 3])
def test_attitude_flies_as_the_closed_loop(axis):
    """Nonlinear terms, gimbals that turn and angles against sines, are of the order of the angle squared."""
    loop, angle = attitude_loop(), 1e-6
    actual = flight({f"robot.initial_quaternion[{axis + 1}]": 0.5 * angle}, TICKS * loop.period)
    assert not actual["gyros.status"].any()
    rows = np.arange(TICKS) * round(loop.period * PER_SECOND)
    expected = loop.closed(angle, 0.0, np.zeros(TICKS))
    assert_near(2.0 * actual[f"robot.quaternion[{axis + 1}]"][rows], expected[:, 0], 1e-8)
    assert_near(actual[f"robot.angular_velocity[{axis}]"][rows], expected[:, 1], 1e-8)
    assert_near(actual[f"attitude_filter.attitude_error[{axis}]"][rows], expected[:, 2], 1e-8)
