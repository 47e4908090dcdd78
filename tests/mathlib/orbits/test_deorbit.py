"""`perilune.fmus_src.mathlib.orbits.deorbit` and `landing_site`: ignition, braking duration, moved sites.

Truth: the motion integrated by scipy (the orbit after the burn descends to the pericentre), rotations by scipy,
spherical geometry, and properties: a moved site is on the sphere, a re-designation never exceeds its reach.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from perilune.fmus_src.mathlib.lunar.landing_site import above_site, redesignate, site_below, within_reach
from perilune.fmus_src.mathlib.orbits.deorbit import (
    against_horizontal,
    apocentre_speed,
    central_angle,
    deorbit_burn,
    ground_range,
    lowest_altitude,
)
from perilune.fmus_src.mathlib.vectors import vector

RADIUS = 1.7374e6
MU = 4.9028e12
CENTRE = np.array([0.0, 0.0, -RADIUS])
angles = st.floats(0.0, 6.28)
metres = st.floats(-5e3, 5e3).map(lambda length: round(length, 6))


def on_orbit(angle, altitude=1e5, speed=1.0):
    """Return position and velocity at a central angle, flying towards smaller ones."""
    place = (RADIUS + altitude) * np.array([math.sin(angle), 0.0, math.cos(angle)]) + CENTRE
    return place, speed * np.array([-math.cos(angle), 0.0, math.sin(angle)])


@given(angles)
def test_the_central_angle_is_that_of_the_plane(angle):
    place, _ = on_orbit(angle)
    assert central_angle(vector(*place), RADIUS) == pytest.approx(angle, abs=1e-9)


@given(st.floats(0.0, 3.1), st.floats(-3.14, 3.14), st.floats(-1e4, 1e5))
def test_the_ground_range_is_the_angle_from_the_site(angle, azimuth, altitude):
    up = Rotation.from_euler("zy", [azimuth, angle]).inv().apply([0.0, 0.0, 1.0])
    actual = ground_range(vector(*((RADIUS + altitude) * up + CENTRE)), RADIUS)
    assert actual == pytest.approx(RADIUS * angle, abs=1e-3)


def test_against_the_horizontal_velocity_turns_with_the_vertical():
    """Along a circle, by finite differences of the closed form; vertical velocity plays no part."""
    rate = 8.9e-4
    turning = against_horizontal(*(vector(*each) for each in on_orbit(2.0, speed=rate * (RADIUS + 1e5))), RADIUS)
    place, backwards = on_orbit(2.0, speed=-1.0)
    assert turning.direction == pytest.approx(backwards, abs=1e-12)
    _, later = on_orbit(2.0 - rate, speed=-1.0)
    _, earlier = on_orbit(2.0 + rate, speed=-1.0)
    assert turning.rate == pytest.approx((later - earlier) / 2.0, abs=1e-9)
    up = (place - CENTRE) / np.linalg.norm(place - CENTRE)
    climbing = against_horizontal(vector(*place), vector(*(-1600.0 * backwards + 50.0 * up)), RADIUS)
    assert climbing.direction == pytest.approx(backwards, abs=1e-12)


def test_without_horizontal_velocity_there_is_no_direction():
    turning = against_horizontal(vector(0.0, 0.0, 1e3), vector(0.0, 0.0, -5.0), RADIUS)
    assert (turning.direction, turning.rate) == ((0.0,) * 3, (0.0,) * 3)


def test_the_published_orbit_needs_19_46_metres_per_second():
    circular = math.sqrt(MU / (RADIUS + 1e5))
    assert circular == pytest.approx(1633.50, abs=0.005)
    assert circular - apocentre_speed(RADIUS + 1e5, RADIUS + 15e3, MU) == pytest.approx(19.46, abs=0.005)
    assert apocentre_speed(RADIUS + 15e3, RADIUS + 1e5, MU) == pytest.approx(1692.34, abs=0.01)


def test_a_burn_of_that_length_comes_down_to_the_pericentre():
    """0.54 m/s2 for 36 s from the circle: the finite burn's pericentre, integrated, within 100 m of 15 km."""
    place, speed = on_orbit(math.pi, speed=math.sqrt(MU / (RADIUS + 1e5)))
    burn = deorbit_burn(vector(*place), vector(*speed), RADIUS + 15e3, RADIUS, MU, 0.54)
    assert burn == pytest.approx(36.04, abs=0.02)

    def slope(t, y):
        centred = y[:3] - CENTRE
        up = centred / np.linalg.norm(centred)
        horizontal = y[3:] - y[3:] @ up * up
        push = -0.54 * horizontal / np.linalg.norm(horizontal) if t < burn else 0.0
        return np.concatenate([y[3:], -MU * centred / np.linalg.norm(centred) ** 3 + push])

    method = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-9}
    braked = solve_ivp(slope, (0.0, burn - 1e-9), [*place, *speed], **method).y[:, -1]
    coast = solve_ivp(slope, (burn, 5000.0), braked, dense_output=True, **method)
    lowest = min(np.linalg.norm(coast.sol(t)[:3] - CENTRE) for t in np.arange(3000.0, 4000.0, 1.0))
    assert lowest - RADIUS == pytest.approx(15e3, abs=100.0)


def test_who_is_slow_already_has_nothing_to_burn():
    place, speed = on_orbit(3.0, speed=1600.0)
    assert deorbit_burn(vector(*place), vector(*speed), RADIUS + 15e3, RADIUS, MU, 0.5) < 0.0


@given(metres, metres, metres, metres, st.floats(0.0, 3e3))
def test_a_moved_site_lies_on_the_sphere_where_it_was_asked_for(x, y, first_x, first_y, altitude):
    first = redesignate(vector(0.0, 0.0, 0.0), vector(first_x, first_y), RADIUS)
    site = np.array(redesignate(first, vector(x, y), RADIUS))
    assert np.linalg.norm(site - CENTRE) == pytest.approx(RADIUS, abs=1e-6)
    # the sphere falls off by 7 m at 5 km, and putting back on it moves by the cube of the way over its radius squared
    assert site[:2] == pytest.approx([first[0] + x, first[1] + y], abs=0.5)
    high = np.array(above_site(vector(*site), altitude, RADIUS))
    assert np.linalg.norm(high - CENTRE) == pytest.approx(RADIUS + altitude, abs=1e-6)
    assert np.cross(high - CENTRE, site - CENTRE) / RADIUS**2 == pytest.approx(np.zeros(3), abs=1e-12)
    assert site_below(vector(*high), RADIUS) == pytest.approx(site, abs=1e-6)


@given(metres, metres, metres.map(abs))
def test_a_move_never_exceeds_its_reach(x, y, reach):
    reached, allowed = within_reach(vector(x, y), reach)
    length = math.hypot(x, y)
    assert math.hypot(*allowed) <= reach * (1.0 + 1e-12)
    assert reached == (length <= reach)
    if reached:
        assert allowed == (x, y)
    else:
        assert math.hypot(*allowed) == pytest.approx(reach, rel=1e-12)
        assert abs(allowed[0] * y - allowed[1] * x) <= 1e-9 * length * max(reach, 1.0)


@settings(max_examples=40)
@given(st.floats(5e3, 1.2e5), st.floats(-200.0, 200.0), st.floats(1200.0, 2000.0), st.floats(0.01, 3.0))
def test_the_lowest_altitude_of_a_coast_is_that_of_the_motion(altitude, climbing, speed, angle):
    """Free flight integrated by scipy until it has gone round by the angle."""
    place, ahead = on_orbit(2.0, altitude)
    up = (place - CENTRE) / np.linalg.norm(place - CENTRE)
    momentum = (RADIUS + altitude) * speed

    def slope(t, y):
        return [y[1], momentum**2 / y[0] ** 3 - MU / y[0] ** 2, momentum / y[0] ** 2]

    def arrived(t, y):
        return y[2] - angle

    arrived.terminal = True
    begin = [RADIUS + altitude, climbing, 0.0]
    coast = solve_ivp(slope, (0.0, 2e4), begin, "DOP853", events=arrived, rtol=1e-11, atol=1e-8, dense_output=True)
    truth = coast.sol(np.linspace(0.0, coast.t[-1], 4001))[0].min() - RADIUS
    velocity = speed * ahead + climbing * up
    assert lowest_altitude(vector(*place), vector(*velocity), angle, RADIUS, MU) == pytest.approx(truth, abs=5.0)


def test_straight_down_leads_to_the_centre():
    assert lowest_altitude(vector(0.0, 0.0, 5e3), vector(0.0, 0.0, -20.0), 0.3, RADIUS, MU) == -RADIUS
