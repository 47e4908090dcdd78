"""Attitude loop of earth_pointing far from the central body, by both methods, and the page's statements on the orbit.

Truth: a double integrator behind a hold, with the friction of wheels, in closed form; the gradient of a point's
gravity. `make long` studies all axes and points, and the orbit.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

import perilune
from perilune.analysis.runtime.flight.simulation import Simulation
from perilune.analysis.runtime.system.options import SystemOptions
from perilune.analysis.stability.request.request import Subject, read_request
from tests.support.lengths import LONG
from tests.support.space.pointing_page import DAMPING, FREQUENCY, NADIR, row, section

pytestmark = pytest.mark.usefixtures("fmus")
HEADING, SYSTEM = "Stability", "earth_pointing"
TICK, SPIN = 0.25, 3e-4 * 4.0 / 3.0  # s; kg m2 of four wheels along the axes of a cube's corners
SLOWING = 1e-7 / 3e-4  # rad/s: viscous friction over spin inertia of a wheel
INERTIA = (4.2, 4.0, 3.0)
DECIBEL = 20.0 / math.log(10.0)
ORBIT = {"satellite.initial_position[1]": 6878137.0}


def response(axis, w):
    """Return L: the wheels' spin is no inertia of the satellite, and the control counts it as one; their friction slows
    them.

    A torque u of the motors changes the rate by u s/(s + p)/(J s), p the friction over the spin inertia.
    """
    gain = INERTIA[axis] / (INERTIA[axis] - SPIN)
    z = np.exp(1j * w * TICK)
    slower = math.exp(-SLOWING * TICK)
    reached = (1.0 - slower) / SLOWING
    rate = reached / (z - slower)
    angle = (reached * rate + (TICK - reached) / SLOWING) / (z - 1.0)
    return gain * (FREQUENCY**2 * angle + 2.0 * DAMPING * FREQUENCY * rate)


def crossover(axis):
    """Return frequency (rad/s) of gain one, and the phase (rad) left there."""
    w = brentq(lambda w: abs(response(axis, w)) - 1.0, 0.05, 1.0)
    return w, float(np.angle(-response(axis, w)))


def check_channel(channel, axis):
    """Check margins within a thousandth of the closed form, and both methods along it."""
    w, phase = crossover(axis)
    assert channel.verdict == "pass"
    assert channel.classical.phase_margin.frequency == pytest.approx(w, rel=1e-3)
    assert channel.classical.phase_margin.value == pytest.approx(phase, abs=1e-3)
    gain = -DECIBEL * math.log(abs(response(axis, math.pi / TICK)))
    largest = max(each.value for each in channel.classical.gain)
    assert DECIBEL * math.log(largest) == pytest.approx(gain, abs=0.01)
    for curve in (channel.curve, channel.measured_response.curve):
        inside = (curve.frequency > 0.05) & (curve.frequency < 0.5 * math.pi / TICK)
        assert inside.sum() > 10
        np.testing.assert_allclose(curve.value[inside], response(axis, curve.frequency[inside]), rtol=2e-3)


@pytest.fixture(scope="module")
def report(fmus):
    return perilune.stability(SYSTEM)


def test_the_page_states_the_closed_form():
    w, phase = crossover(0)
    stated = row("truth, filter", HEADING)
    assert stated[0] == f"{math.degrees(phase):.2f}, {w:.3f}"
    assert stated[1] == f"{-DECIBEL * math.log(abs(response(0, math.pi / TICK))):.2f}"
    grid = np.geomspace(1e-3, math.pi / TICK, 20_000)
    away = np.abs((1.0 - response(0, grid)) / (1.0 + response(0, grid))).max()  # S - T
    assert stated[2] == f"{2.0 / away:.3f}"
    growth = math.exp(math.sqrt(2.0 * 3.986004415e14 / 6878137.0**3))
    assert f"= {growth:.5f} a second" in section(HEADING)


@pytest.mark.parametrize("name", ["truth", "filter"])
def test_a_point_is_in_nadir_mode_and_nothing_but_a_field_is_missing(fmus, name):
    request = read_request(SYSTEM, SystemOptions(stop_time=1200.0))
    with Simulation(Subject(request.system, request.options).at(request.point(name))) as simulation:
        final = simulation.fly().final()
    assert final["modes.mode"] == NADIR
    assert abs(final["monitor.half_cone"]) < 1e-6
    assert np.all(np.abs([final[f"satellite.wheel_speeds[{wheel}]"] for wheel in (1, 2, 3, 4)]) > 90.0)
    assert {each for each, number in final.items() if each.endswith(".status") and number} == {"torquers.status"}


@pytest.mark.skipif(not LONG, reason="two operating points of 650 states")
def test_margins(report):
    loops = report.loops
    assert [(each.name, each.point) for each in loops] == [
        (f"attitude[{axis}]", point) for point in ("truth", "filter") for axis in (1, 2, 3)
    ]
    for number, channel in enumerate(loops):
        check_channel(channel, number % 3)
        assert row("truth, filter", HEADING)[2] == f"{channel.robust.disk_margin:.3f}"


@pytest.mark.skipif(not LONG, reason="two operating points of 650 states")
def test_the_orbit_is_outside_and_named(fmus):
    unloading = perilune.stability(SYSTEM, set=ORBIT).loops
    crossings = [math.degrees(channel.classical.phase[0].value) for channel in unloading]
    assert f"are {min(crossings):.2f} to {max(crossings):.2f} deg" in section(HEADING)
    apart = max(math.degrees(channel.agreement.phase) for channel in unloading)
    assert f"differ by up to {apart:.1f} deg" in section(HEADING)
    still = perilune.stability(SYSTEM, set=ORBIT | {"torquers.dipole_limit": 0.0}).loops
    for channel in still:
        assert f"are at {math.degrees(channel.classical.phase[0].value):.2f} deg" in section(HEADING)
        assert channel.agreement.agrees
    for channel in (*unloading, *still):
        assert channel.verdict == "fail"
        assert {f"satellite.position[{axis}]" for axis in (1, 2, 3)} <= set(channel.outside)
        assert f"({channel.largest:.5f} in the study" in section(HEADING)
