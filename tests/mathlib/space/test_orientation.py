"""Axes of Earth and Moon. Truth: ERFA, NAIF's published value, and the same series in another program."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perilune.fmus_src.mathlib.space.orientation import earth_axes, fixed_axes, from_fixed, moon_axes, to_fixed
from perilune.fmus_src.mathlib.vectors import vector

T2 = 827301600.0  # s TT since J2000.0
TT_MINUS_UT1 = 69.184
ARCSECOND = np.pi / 648000.0

EARTH = [
    [0.040905482940223545, 0.9991630104715675, -0.00014131815672553883],
    [-0.9991597420856682, 0.040905710631199646, 0.0025559016134512015],
    [0.0025595430701909885, 3.664902317999346e-05, 0.9999967236926933],
]
ERFA = [  # IAU 2006/2000A, no polar motion
    [0.04090543999274699, 0.9991630122310491, -0.00014130950454096],
    [-0.9991597445867674, 0.040905667651094775, 0.0025556117317930486],
    [0.0025592530756600443, 3.6652346125209956e-05, 0.9999967244347855],
]
MOON = [
    [-0.9042251927448975, -0.3991086508598022, -0.15195093160070255],
    [0.4269454559344638, -0.8367382411417231, -0.3429091621231029],
    [0.009714857814998638, -0.37494186298668253, 0.9269974222821281],
]
# Published with NAIF's CSPICE, of pck00010: inertial from Moon-fixed at d = 14610 days.
CSPICE = [
    [0.5720547105837333, 0.8198082524397307, -0.025842548842481546],
    [-0.761073769862349, 0.5187960000245592, -0.38938082539594815],
    [-0.30581060303147345, 0.2424152214491336, 0.9207142528946177],
]


def matrix(axes, t):
    return np.array([to_fixed(fixed_axes(axes, t), vector(*e)).elements() for e in np.eye(3)]).T


def test_earth():
    r = matrix(earth_axes(T2, TT_MINUS_UT1), T2)
    assert np.abs(r - EARTH).max() < 1e-11
    turn = r @ np.transpose(ERFA)
    assert np.linalg.norm([turn[2, 1], turn[0, 2]]) < 0.24 * ARCSECOND
    assert abs(turn[1, 0]) < 0.05 * ARCSECOND


def test_moon():
    assert np.abs(matrix(moon_axes(T2), T2) - MOON).max() < 1e-11
    day = 14610 * 86400.0
    assert np.abs(matrix(moon_axes(day), day).T - CSPICE).max() < 1e-12


@pytest.mark.parametrize("axes", [lambda t: earth_axes(t, TT_MINUS_UT1), moon_axes])
@given(t=st.floats(6e8, 1.2e9), later=st.floats(-10.0, 10.0))
def test_axes_of_seconds_ago(axes, t, later):
    """The angle continues; the pole, and the Moon's librations, move by less than 1e-7 rad in ten seconds."""
    fixed_pole = matrix(axes(t), t + later)
    assert np.abs(fixed_pole - matrix(axes(t + later), t + later)).max() < 1e-7
    assert np.abs(fixed_pole @ fixed_pole.T - np.eye(3)).max() < 1e-14
    v = vector(1.0, -2.0, 3.0)
    fixed = fixed_axes(axes(t), t + later)
    back = from_fixed(fixed, to_fixed(fixed, v)).elements()
    assert np.abs(np.subtract(back, v.elements())).max() < 1e-14


def test_the_earth_turns_at_its_rate():
    assert earth_axes(T2, TT_MINUS_UT1).rate == pytest.approx(7.292115146706979e-5, rel=1e-15)
