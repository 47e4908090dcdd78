"""Files of docs/guides/own_satellite.md: orbit, simulation and worst trial, and the numbers next to them.

Truth: an orbit with J2 by DOP853, and the equation of time of 1 June in almanacs; the binomial distribution; the offset
T/(J w0^2) that a constant torque leaves. `make long` also simulates the campaign.
"""

from __future__ import annotations

import math
import re
import tomllib

import numpy as np
import pytest
from scipy import stats
from scipy.integrate import solve_ivp

import perilune
from tests.support.documented import page_text, saved_files
from tests.support.lengths import LONG

pytestmark = pytest.mark.usefixtures("fmus")
PAGE = page_text("docs/guides/own_satellite.md")
FILES = dict(saved_files(PAGE))
CAMPAIGN = "cubesat/campaigns/dispersed.toml"
MU, RADIUS, J2 = 3.986004415e14, 6378136.3, 1.0826356e-3  # m3/s2, m, 1
YEAR = 365.25636  # days, sidereal
EQUATION_OF_TIME = 2.3 / 60.0  # h, apparent over mean solar time at 0 h on 1 June
WORST = 61
FREQUENCY = 0.1  # rad/s, of the control
INERTIA = np.array([0.035, 0.035, 0.008])  # kg m2


@pytest.fixture(scope="module")
def orbit_lines():
    """Return the lines that the script of the page prints."""
    lines = []
    exec(FILES["orbit.py"], {"print": lines.append})
    return "\n".join(lines)


@pytest.fixture(scope="module")
def folder(tmp_path_factory, orbit_lines):
    """Return the system of the page, by the edits that the page describes."""
    root = tmp_path_factory.mktemp("cubesat")
    toml = root / "cubesat/system.toml"
    perilune.compose("earth_pointing", output=toml)
    text = re.sub(r"^name = .*", 'name = "cubesat"', toml.read_text(encoding="utf-8"), flags=re.MULTILINE)
    text = re.sub(r"^stop_time = .*", "stop_time = 17217", text, flags=re.MULTILINE)
    toml.write_text(f"{text}{FILES['cubesat.toml']}{orbit_lines}\n", encoding="utf-8")
    (root / CAMPAIGN).parent.mkdir()
    (root / CAMPAIGN).write_text(FILES[CAMPAIGN], encoding="utf-8")
    perilune.compose(toml)
    return toml.parent


def calm_time(flight):
    """Return the time at which detumbling ends, s."""
    return flight.time[np.argmax(flight["modes.mode"] > 0)]


def with_j2(_, state):
    r, z = state[:3], state[2]
    distance = np.linalg.norm(r)
    factor = 1.5 * J2 * (RADIUS / distance) ** 2
    bulge = factor * (np.array([1.0, 1.0, 3.0]) - 5.0 * (z / distance) ** 2)
    return np.concatenate([state[3:], -MU / distance**3 * r * (1.0 + bulge)])


def node(state):
    """Return right ascension of the ascending node, rad."""
    normal = np.cross(state[:3], state[3:])
    return math.atan2(normal[0], -normal[1])


def test_there_is_what_the_page_replaces(folder):
    lines = [line for line in PAGE.splitlines() if line.startswith("sed ") and "annotations.xml" in line]
    replaced = [text for line in lines for text in re.findall(r"s/([^/]+)/", line)]
    assert len(replaced) == 5
    annotations = (folder / "annotations.xml").read_text(encoding="utf-8")
    assert all(text in annotations for text in replaced)


def test_the_plane_turns_once_a_year(orbit_lines):
    start = tomllib.loads(orbit_lines)
    state = np.array(start["satellite.initial_position"] + start["satellite.initial_velocity"])
    revolution = 2.0 * math.pi * math.sqrt((RADIUS + 550e3) ** 3 / MU)
    assert f"stop_time = {3 * round(revolution)}/" in PAGE
    span = 15 * revolution
    track = solve_ivp(with_j2, (0.0, span), state, method="DOP853", rtol=1e-10, atol=1e-4, dense_output=True)
    angle = node(track.sol(span)) - node(state)
    assert angle == pytest.approx(2.0 * math.pi / YEAR * span / 86400.0, rel=0.01)
    heights = np.linalg.norm(track.sol(np.linspace(0.0, span, 5000))[:3], axis=0) - RADIUS
    assert "by up to 7.5 km" in PAGE
    assert heights.max() - heights.min() == pytest.approx(7.5e3, abs=0.25e3)


def test_what_is_declared_once_reaches_all(folder):
    flight = perilune.simulate(folder, stop_time=1.0)
    sun, position = flight["environment.sun_direction"][0], flight["satellite.position"][0]
    hours = math.degrees(math.atan2(position[1], position[0]) - math.atan2(sun[1], sun[0])) / 15.0
    assert (hours + 12.0) % 24.0 == pytest.approx(10.5 + EQUATION_OF_TIME, abs=0.5 / 60.0)
    with pytest.raises(perilune.InputError, match="set epoch instead, since both must agree"):
        perilune.simulate(folder, set={"onboard.epoch": 0.0}, stop_time=1.0)


def test_the_flight_and_the_gain(folder):
    flight = perilune.simulate(folder)
    final = flight.final()
    assert f"at t = {flight.time[-1]:.0f} s, {len(flight.time)} samples" in PAGE
    assert f"boresight {math.degrees(final['monitor.half_cone']):.4g} deg" in PAGE
    assert f"momentum of the wheels {np.linalg.norm(flight['satellite.wheel_momentum'][-1]):.4g} N·m·s" in PAGE
    assert f"with the largest moment it takes {calm_time(flight):.0f} s" in PAGE
    rate, inclination = math.sqrt(MU / (RADIUS + 550e3) ** 3), math.radians(97.6)
    largest, smallest = (2.0 * rate * (1.0 + math.sin(inclination)) * moment for moment in (0.035, 0.008))
    gain = tomllib.loads(FILES["cubesat.toml"])["set"]["torquers.detumble_gain"]
    assert gain == pytest.approx(largest, rel=0.03)
    slow = perilune.simulate(folder, set={"torquers.detumble_gain": round(smallest, 6)}, stop_time=8000.0)
    assert f"takes {calm_time(slow):.0f} s; with the largest moment" in PAGE


@pytest.mark.slow
def test_the_worst_flight_is_off_by_its_torque(folder):
    flight = perilune.replay(folder, WORST, campaign="dispersed")
    assert f"perilune replay results {WORST} " in PAGE
    assert f"largest `error`, {flight.metrics['error']:.4f} deg" in PAGE
    nadir = (flight["modes.mode"] == 2) & (flight["modes.time_in_mode"] > 600.0)
    offset = flight["satellite.disturbance_torque"][nadir] / INERTIA / FREQUENCY**2
    across = math.degrees(np.linalg.norm(offset[:, :2], axis=1).max())
    assert f"{across:.3f} deg of the {flight.metrics['error']:.3f} deg" in PAGE
    assert flight.metrics["error"] == pytest.approx(across, rel=0.15)


@pytest.mark.skipif(not LONG, reason="two further flights")
def test_what_reduces_the_error(folder):
    """A loop of twice the frequency to a quarter, but for noise and friction; an integral more."""
    fast, integral = (
        perilune.replay(folder, WORST, campaign="dispersed", set={f"control.{name}": number}).metrics["error"]
        for name, number in (("natural_frequency", 2.0 * FREQUENCY), ("integral_time", 100.0))
    )
    assert f"reduces this error to {fast:.3f} deg" in PAGE
    assert f"of 100 s reduces it to {integral:.3f} deg" in PAGE
    assert integral < fast < 0.18 / 2.0


def test_the_risk_is_binomial():
    trials = tomllib.loads(FILES[CAMPAIGN])["trials"]
    assert PAGE.count(f"| 0 | {100.0 * 0.95**trials:.2f} | met |") == 2
    assert stats.binom.cdf(1, trials, 0.05) <= 0.1 < stats.binom.cdf(2, trials, 0.05)
    assert f"2nd worst of {trials}" in PAGE


@pytest.mark.skipif(not LONG, reason="100 flights of three revolutions")
def test_the_campaign(folder):
    (trials,) = perilune.batch(folder, "dispersed").trials.values()
    assert trials.success.all()
    assert np.argmax(trials.metrics["error"]) == WORST
    for name, unit in (("calm_time", "s"), ("error", "deg")):
        assert f"| met | {np.sort(trials.metrics[name])[-2]:.4g} {unit} |" in PAGE
    draws = [trials.column(f"draw.satellite.residual_dipole[{k}]") for k in (1, 2, 3)]
    dipole = np.linalg.norm(draws, axis=0)
    assert np.argmax(dipole) == WORST
    assert f"{dipole[WORST]:.4f} A m2" in PAGE
