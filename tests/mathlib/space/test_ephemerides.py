"""Positions of Sun and Moon. Truth: the same series in another program, and JPL's DE421 within the stated accuracy."""

import numpy as np
import pytest

from perilune.fmus_src.mathlib.space.ephemerides import moon_position, sun_position, third_body_acceleration
from perilune.fmus_src.mathlib.vectors import vector

T1, T2, T3 = 644155200.0, 827301600.0, 1032976800.0  # s TT since J2000.0: 2020, 2026, 2032
# Time: series, DE421 (m, GCRS).
SUN = {
    T1: (
        (52527504500.65292, 130546858329.23642, 56598989959.73522),
        (52528110383.39, 130552742711.21, 56594668221.29),
    ),
    T2: (
        (148985269736.32874, -529495793.0454241, -229564521.56603414),
        (148991497432.34, -546369016.82, -237435246.12),
    ),
    T3: (
        (-149905698149.28564, -5469241209.581221, -2371206264.7097197),
        (-149906873571.72, -5453574417.97, -2363146036.92),
    ),
}
MOON = {
    T1: (
        (-363541956.709677, 39574371.87641143, 53679099.033400945),
        (-363518176.39, 39611211.15, 53692089.04),
    ),
    T2: (
        (340517897.0930472, 117608917.98089932, 76298572.17629912),
        (340808525.64, 117546398.81, 76258565.93),
    ),
    T3: (
        (73637238.62595679, 358910853.070476, 126617246.58165197),
        (73757168.23, 359195536.01, 126687872.05),
    ),
}
ARCSECOND = np.pi / 648000.0


def angle(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b)), np.dot(a, b))


@pytest.mark.parametrize("t", SUN)
def test_sun(t):
    position = np.array(sun_position(t).elements())
    series, truth = SUN[t]
    assert np.linalg.norm(position - series) < 1e-11 * np.linalg.norm(series)
    assert angle(position, truth) < 31.6 * ARCSECOND
    assert abs(np.linalg.norm(position) - np.linalg.norm(truth)) < 1.2e7


@pytest.mark.parametrize("t", MOON)
def test_moon(t):
    position = np.array(moon_position(t).elements())
    series, truth = MOON[t]
    assert np.linalg.norm(position - series) < 1e-11 * np.linalg.norm(series)
    assert angle(position, truth) < 293.0 * ARCSECOND
    assert abs(np.linalg.norm(position) - np.linalg.norm(truth)) < 497e3


def test_a_third_body_far_away_pulls_by_its_tide():
    """mu/D^3 (3 u u' - 1) r to first order in r/D."""
    r, body, mu = np.array([7e6, -1e6, 2e6]), np.array([1e11, 2e10, -4e10]), 1.3e20
    distance = np.linalg.norm(body)
    u = body / distance
    tide = mu / distance**3 * (3.0 * (u @ r) * u - r)
    tide_difference = third_body_acceleration(vector(*r), vector(*body), mu).elements()
    assert np.linalg.norm(tide_difference - tide) < 3.0 * np.linalg.norm(r) / distance * np.linalg.norm(tide)
    assert third_body_acceleration(vector(0.0, 0.0, 0.0), vector(*body), mu).elements() == (0.0, 0.0, 0.0)
