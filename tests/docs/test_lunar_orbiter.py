"""System earth_pointing in orbit about the Moon: numbers of its page, and blocks without a magnetic field.

Truth: period and shadow of a circle in closed form; the balance of angular momentum; Farrenkopf's covariance and gyro
noise through the loop; the nadir by scipy.
"""

import functools
import math
import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import perilune
from perilune.fmus_src.control.magnetic_control import MagneticControlStatus
from perilune.fmus_src.mathlib.space.orientation import moon_axes
from perilune.fmus_src.navigation.attitude_navigation import AttitudeNavigationStatus
from tests.support.lengths import either
from tests.support.space.pointing_page import (
    ARCSEC,
    NADIR,
    NOISE,
    farrenkopf,
    in_nadir,
    knowledge,
    root_mean_square,
    row,
    scientific,
    section,
)

pytestmark = pytest.mark.usefixtures("fmus")
HEADING = "About the Moon"
SYSTEM, STOP, REVOLUTION = "earth_pointing", 28272.0, 7068.0
EPOCH = 827301600.0
PARAMETER, RADIUS, SEMI_AXIS = 4.902801056e12, 1737400.0, 1837400.0  # LP165P; the shadow's; of the orbit
CIRCLE = 2.0 * math.pi * math.sqrt(SEMI_AXIS**3 / PARAMETER)


@functools.cache
def flight():
    return perilune.simulate(SYSTEM, parameters=["moon.ssv"], stop_time=STOP)


def first_shadow(flown):
    """Return entry and exit (s) through half of the Sun's light, interpolated."""
    light, t = flown["environment.illumination"] - 0.5, flown.time
    (edges,) = np.nonzero(light[:-1] * light[1:] < 0.0)
    return (t[edges] - light[edges] * (t[edges + 1] - t[edges]) / (light[edges + 1] - light[edges]))[:2]


def nodes(flown):
    """Return times (s) at which the satellite crosses the Moon's equator northwards."""
    north, t = flown["satellite.position"] @ np.array(moon_axes(EPOCH).pole), flown.time
    (up,) = np.nonzero((north[:-1] < 0.0) & (north[1:] >= 0.0))
    return t[up] - north[up] * (t[up + 1] - t[up]) / (north[up + 1] - north[up])


def closed_shadow(flown):
    """Return duration (s) of the shadow of a circle: an arc of 2 acos(sqrt(1 - (R/a)^2)/cos(beta)); beta (deg) amid
    it."""
    amid = round(first_shadow(flown).mean() / 0.25)
    normal = np.cross(flown["satellite.position"][amid], flown["satellite.velocity"][amid])
    sine = normal @ flown["environment.sun_direction"][amid] / np.linalg.norm(normal)
    arc = 2.0 * math.acos(math.sqrt((1.0 - (RADIUS / SEMI_AXIS) ** 2) / (1.0 - sine**2)))
    return arc / (2.0 * math.pi) * CIRCLE, math.degrees(math.asin(sine))


def from_nadir(flown):
    """Return angle (rad) between the boresight, the body's z axis, and the direction to the Moon's centre."""
    boresight = Rotation.from_quat(flown["satellite.quaternion"], scalar_first=True).apply([0.0, 0.0, 1.0])
    down = -flown["satellite.position"]
    return np.arctan2(np.linalg.norm(np.cross(boresight, down), axis=1), np.sum(boresight * down, axis=1))


def gained(flown):
    """Return angular momentum (N m s) that the second revolution adds, and the integral of its disturbance torque."""
    during = slice(round(REVOLUTION / 0.25), round(2.0 * REVOLUTION / 0.25) + 1)
    attitude = Rotation.from_quat(flown["satellite.quaternion"][during], scalar_first=True)
    torque = attitude.apply(flown["satellite.disturbance_torque"][during])
    momentum = flown["satellite.angular_momentum"][during]
    return momentum[-1] - momentum[0], np.trapezoid(torque, dx=0.25, axis=0)


def test_the_page():
    flown, nadir = flight(), in_nadir(flight())
    height = (np.linalg.norm(flown["satellite.position"], axis=1) - RADIUS) / 1e3
    revolutions = np.diff(nodes(flown))
    start, end = first_shadow(flown)
    momentum = np.linalg.norm(flown["satellite.wheel_momentum"][nadir], axis=1)
    expected = {
        "height": f"{height.min():.1f} to {height.max():.1f}",
        "period of a revolution": f"{revolutions.min():.1f} to {revolutions.max():.1f}",
        "duration of the first shadow": f"{end - start:.1f}",
        "in nadir mode": f"{flown.time[np.argmax(flown['modes.mode'] == NADIR)]:.0f}",
        "attitude error": f"{knowledge(flown):.1f}",
        "pointing error": f"{root_mean_square(flown['monitor.attitude_error'][nadir]) / ARCSEC:.0f}",
        "angle of the boresight for": f"{np.quantile(flown['monitor.half_cone'][nadir], 0.99) / ARCSEC:.0f}",
        "angle of the boresight from the true nadir": f"{np.quantile(from_nadir(flown)[nadir], 0.99) / ARCSEC:.0f}",
        "largest wheel momentum": f"{momentum.max():.4f}",
        "momentum gained": scientific(np.linalg.norm(gained(flown)[0])),
    }
    assert {title: row(title, HEADING)[0] for title in expected} == expected
    assert f"--stop-time {STOP:.0f}" in section(HEADING)
    revolutions_left = (0.02 - float(expected["largest wheel momentum"])) / float(expected["momentum gained"])
    assert f"after {revolutions_left:.0f} revolutions" in section(HEADING)
    assert 13.0 < revolutions_left * REVOLUTION / 86400.0 < 15.0


def test_what_the_page_expects():
    duration, beta = closed_shadow(flight())
    assert row("period of a revolution", HEADING)[1].startswith(f"{CIRCLE:.1f} for a point mass")
    assert row("duration of the first shadow", HEADING)[1].startswith(f"{duration:.1f}: ")
    assert f"= {beta:.0f} deg" in row("duration of the first shadow", HEADING)[1]
    assert row("attitude error", HEADING)[1].startswith(f"{farrenkopf() / ARCSEC:.1f}")
    torque = flight()["satellite.disturbance_torque"][in_nadir(flight())]
    offset = root_mean_square(torque / [4.2, 4.0, 3.0]) / 0.1**2 / ARCSEC
    noise = NOISE / ARCSEC
    assert row("pointing error", HEADING)[1] == f"{noise:.0f}: gyro noise; disturbances {offset:.1f}"
    assert noise < float(row("pointing error", HEADING)[0]) < 1.2 * noise
    assert float(row("attitude error", HEADING)[0]) == pytest.approx(farrenkopf() / ARCSEC, rel=0.05)


def test_momentum_is_that_of_the_disturbances():
    gain, integral = gained(flight())
    np.testing.assert_allclose(gain, integral, rtol=0.0, atol=1e-9)


def test_limits_are_met_and_no_tracker_is_dazzled_at_nadir():
    assert all(limit["verdict"] == "met" for limit in flight().limits)
    assert np.all(flight()["star.status"][in_nadir(flight())] == 0)


@pytest.mark.parametrize("sets", [["moon.ssv"], ["moon.ssv", "ideal.ssv"]])
def test_without_a_field_nothing_is_lost(sets):
    """No dipole, no direction of the field, and each is reported; all signals are finite."""
    flown = flight() if len(sets) == 1 else perilune.simulate(SYSTEM, parameters=sets, stop_time=300.0)
    assert all(np.all(np.isfinite(signal)) for signal in flown.signals.values())
    assert not np.any(flown["environment.magnetic_field"])
    assert not np.any(flown["torquers.dipole"])
    assert not np.any(flown["torquers.feedforward_torque"])
    assert np.all(flown["torquers.status"] == MagneticControlStatus.WEAK_FIELD)
    left_out = flown["navigation.status"] == AttitudeNavigationStatus.NO_DIRECTION
    assert np.all(left_out[1:] == (flown.time[1:] % 1.0 == 0.0))


def test_a_point_mass_is_circled_in_its_period_and_shadow():
    point = {"satellite.gravity_degree": 0, "satellite.third_bodies": False}
    flown = perilune.simulate(SYSTEM, parameters=["moon.ssv"], set=point, stop_time=REVOLUTION)
    r, v = flown["satellite.position"], flown["satellite.velocity"]
    along = v[0] / np.linalg.norm(v[0])
    before = round(REVOLUTION / 0.25) - 4  # a second before the end
    late = (r[before] - r[0]) @ along / np.linalg.norm(v[0])
    assert flown.time[before] - late == pytest.approx(CIRCLE, abs=5e-3)  # light pushes by a metre or two
    start, end = first_shadow(flown)
    assert end - start == pytest.approx(closed_shadow(flown)[0], abs=0.05)


def test_the_degree_that_is_missing():
    """Positions of degree 7 against 8, as on the page, and how fast gravity turns the plane of the orbit."""
    revolutions, degree = either([1, 4], [1]), {"satellite.gravity_degree": 7}
    stop = revolutions[-1] * REVOLUTION
    other = perilune.simulate(SYSTEM, parameters=["moon.ssv"], set=degree, stop_time=stop)["satellite.position"]
    off = np.linalg.norm(other - flight()["satellite.position"][: len(other)], axis=1)
    ((*stated,),) = re.findall(r"differs by (\d+) m after one revolution and by (\d+) m after four", section(HEADING))
    for n, distance in zip(revolutions, stated, strict=False):
        assert f"{off[round(n * REVOLUTION / 0.25)]:.0f}" == distance
    r = flight()["satellite.position"]
    normal = np.cross(r, flight()["satellite.velocity"])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    turning = np.sum(np.cross(normal, np.gradient(normal, 0.25, axis=0)) * r, axis=1) / np.linalg.norm(r, axis=1)
    fastest = np.abs(turning[8:-8]).max()
    error = fastest * 2.0 * 0.9 / 0.1 / ARCSEC  # a steady error of the reference's rate through 2 z w0 and w0^2
    text = f"by up to {scientific(fastest)} rad/s, which guidance neglects"
    assert text in section(HEADING)
    assert f"the error is {error:.1f} arcsec" in section(HEADING)
