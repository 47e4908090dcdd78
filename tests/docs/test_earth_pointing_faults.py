"""Faults of earth_pointing: the statements of the page agree with the results of its commands.

Truth: angular momentum is the integral of the torque of the stuck torquer; the drift of gyros in closed form; the chord
of the angle at which the gate closes.
"""

import functools
import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import chi2

import perilune
from perilune.fmus_src.navigation.attitude_navigation import AttitudeNavigationStatus
from perilune.fmus_src.plants.spacecraft import SpacecraftStatus
from tests.support.space.pointing_page import ARCSEC, NADIR, WALK, row, section

pytestmark = pytest.mark.usefixtures("fmus")
HEADING = "Faults"
DEAD = "torquers.dipole[3]=override:0@0"
STUCK, STUCK_AT = "torquers.dipole[1]=override:5@4000", 4000.0
LOST, LOST_AT, BACK = "star.sample_count=freeze@5000..5600", 5000.0, 5600.0
SPIKE, SPIKE_AT = "magnetometer.measured_field[1]=bias:-1e-4@5500..5501", 5500.0
NARROW = math.radians(0.05)
GATE, FIELD_SIGMA = 16.27, 0.3


@functools.cache
def fly(stop_time, *faults):
    return perilune.simulate("earth_pointing", faults=list(faults), stop_time=stop_time)


def fly_without_gate(*faults):
    return perilune.simulate("earth_pointing", faults=list(faults), stop_time=BACK, set={"navigation.gate": 0.0})


def first(flown, condition, since=0.0):
    """Return time (s) at which a condition holds for the first time since another."""
    return flown.time[np.argmax(condition & (flown.time >= since))] - since


def verdicts(flown):
    return {str(limit["name"]): str(limit["verdict"]) for limit in flown.limits}


def test_a_dead_torquer_delays_detumbling():
    flown = fly(7000.0, DEAD)
    mode = flown["modes.mode"]
    calm, nadir = first(flown, mode > 0), first(flown, mode == NADIR)
    text = row("torquer about z dead", HEADING)
    assert text[0].startswith(f"detumbled after {calm:.0f} s instead of {row('detumbled')[0]} s")
    assert text[0].endswith(f"in nadir mode after {nadir:.0f} s")
    assert calm > 5460.0
    assert set(verdicts(flown).values()) == {"met"}


def test_a_stuck_torquer_fills_the_wheels():
    flown = fly(5000.0, STUCK)
    momentum = np.linalg.norm(flown["satellite.wheel_momentum"], axis=1)
    off = first(flown, flown["monitor.half_cone"] > NARROW, STUCK_AT)
    full = first(flown, momentum > 0.02, STUCK_AT)
    fastest = first(flown, flown["satellite.status"] == SpacecraftStatus.SPEED_LIMITED, STUCK_AT)
    text = row("torquer about x stuck", HEADING)[0]
    assert f"beyond 0.05 deg after {off:.0f} s" in text
    assert f"beyond 0.02 N m s after {full:.0f} s and at their speed limit after {fastest:.0f} s" in text
    assert set(verdicts(flown).values()) == {"violated"}


def test_its_torque_is_all_that_the_momentum_gains():
    """The field of the sensors has degree 13, that of the plant 8: a thousandth."""
    flown = fly(5000.0, STUCK)
    during = slice(4 * 4001, 4 * 4400)  # dipoles act from a sample to the next
    field, dipole = flown["environment.magnetic_field_body"][during], flown["satellite.applied_dipole"][during]
    torque = np.cross(dipole[1:], 0.5 * (field[1:] + field[:-1]))
    torque += flown["satellite.disturbance_torque"][during][1:]
    attitude = Rotation.from_quat(flown["satellite.quaternion"][during][1:], scalar_first=True)
    integral = 0.25 * np.sum(attitude.apply(torque), axis=0)
    gained = np.diff(flown["satellite.angular_momentum"][during][[0, -1]], axis=0)[0]
    np.testing.assert_allclose(gained, integral, rtol=0.0, atol=0.01 * np.linalg.norm(gained))


@pytest.mark.slow
def test_without_stars_the_gyros_carry_on():
    flown = fly(6600.0, LOST)
    gap = (flown.time >= LOST_AT) & (flown.time < BACK)
    known = np.linalg.norm(flown["monitor.knowledge_error"], axis=1)
    wide = (flown.time >= BACK) & (flown["monitor.half_cone"] > NARROW)
    text = row("star tracker lost", HEADING)[0]
    assert f"attitude error reaches {known[gap | (flown.time == BACK)].max() / ARCSEC:.0f} arcsec" in text
    widest = flown["monitor.half_cone"].max(initial=0.0, where=flown.time >= LOST_AT) / ARCSEC
    assert f"boresight error {widest:.0f} arcsec" in text
    assert f"from {flown.time[wide].max() + 0.25 - BACK:.0f} s after the stars return" in text
    coarse = first(flown, flown["navigation.status"] == AttitudeNavigationStatus.NO_RECENT_STAR, LOST_AT)
    assert coarse == pytest.approx(30.0, abs=1.0)
    assert np.all(flown["modes.mode"][gap] == NADIR)
    assert set(verdicts(flown).values()) == {"met"}


def test_the_drift_is_that_of_the_gyros():
    """Angular random walk N sqrt(t), and the integral of a Gauss-Markov bias: 2 s^2 tau^2 (x - 1 + e^-x), x = t/tau."""
    t, tau, sigma = BACK - LOST_AT, 300.0, 4.8e-6
    variance = WALK**2 * t + 2.0 * (sigma * tau) ** 2 * (t / tau - 1.0 + math.exp(-t / tau))
    assert f"drifts by {math.sqrt(variance) / ARCSEC:.0f} arcsec (1 sigma)" in row("star tracker lost", HEADING)[1]
    flown = fly(6600.0, LOST)
    error = flown["monitor.knowledge_error"][round(4 * BACK) - 1]
    low, high = chi2.ppf([0.005, 0.995], 3)
    assert low < error @ error / variance < high


def change_by_the_spike(before, after):
    """Return largest change of the error of attitude (arcsec) until the stars come back, and
    that of the rejected samples."""
    gap = slice(round(4 * SPIKE_AT), round(4 * BACK))
    change = np.linalg.norm((after["monitor.knowledge_error"] - before["monitor.knowledge_error"])[gap], axis=1).max()
    return change / ARCSEC, (after["navigation.rejected"] - before["navigation.rejected"])[gap][-1]


def test_the_gate_leaves_a_spike_out():
    text, spiked = row("magnetometer off", HEADING), fly(6600.0, LOST, SPIKE)
    change, rejected = change_by_the_spike(fly(6600.0, LOST), spiked)
    assert text[0] == f"the gate rejects the sample: attitude changes by {change:.1f} arcsec"
    assert rejected == 1
    assert spiked["navigation.status"][round(4 * SPIKE_AT)] == AttitudeNavigationStatus.REJECTED
    assert set(verdicts(spiked).values()) == {"met"}
    change, rejected = change_by_the_spike(fly_without_gate(LOST), fly_without_gate(LOST, SPIKE))
    assert text[1].endswith(f"with `--set navigation.gate=0` attitude changes by {change:.1f} arcsec")
    assert rejected == 0


def test_where_the_gate_closes():
    """The chord 2 sin(angle/2) of two directions over the sigma of one, squared."""
    angle = 2.0 * math.asin(FIELD_SIGMA * math.sqrt(GATE) / 2.0)
    assert f"wrong by more than {math.degrees(angle):.0f} deg" in section(HEADING)
    flown = fly(6600.0, LOST, SPIKE)
    true, spiked = flown["environment.magnetic_field_body"], flown["magnetometer.measured_field"]
    at = round(4 * SPIKE_AT)
    cosine = true[at] @ spiked[at] / np.linalg.norm(true[at]) / np.linalg.norm(spiked[at])
    assert math.acos(cosine) > angle
