"""Planar lander, compared with the published equations, an adaptive integrator and conservation laws.

Truth: V, th, h, central angle and mass of Diveev, Pupkov and Sofronova (2013), with and without rotation of the
vertical, by scipy's DOP853 at 1e-13 relative (agreement 1e-9 relative, and the fourth order measured); energy and
angular momentum of free motion; the rocket equation; and a vertical throw through V = 0, where the published equations
are singular.
"""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from perilune.fmus_src.plants.planar_moon_lander import PlanarMoonLander
from tests.support.lengths import either

G0, RADIUS, ISP, STANDARD = 1.623, 1.7384e6, 319.0, 9.80665
MU = G0 * RADIUS**2
THRUST = 4500.0


def lander(**settings_):
    plant = PlanarMoonLander(**settings_)
    plant.initialize()
    return plant


def state(plant):
    return np.array([plant.speed, plant.path_angle, plant.altitude, plant.central_angle, plant.mass])


def fly(plant, duration, thrust=0.0, angle=0.0, step=0.1, start=0.0):
    plant.thrust, plant.thrust_angle = thrust, angle
    for k in range(round(duration / step)):
        plant.step(start + k * step, step)
    return plant


def published(y0, duration, thrust, angle, curvature):
    """Integrate the published equations; ``curvature`` adds V sin(th)/R to th' and is zero in print."""

    def slope(_, y):
        v, th, h, _, m = y
        w, g, r = thrust / m, G0 * (RADIUS / (RADIUS + h)) ** 2, RADIUS + h
        turn = -v * math.sin(th) / r if curvature else 0.0
        return [
            w * math.cos(angle - th) - g * math.cos(th),
            (w * math.sin(angle - th) + g * math.sin(th)) / v + turn,
            v * math.cos(th),
            v * math.sin(th) / r,
            -thrust / (STANDARD * ISP),
        ]

    return solve_ivp(slope, (0.0, duration), y0, method="DOP853", rtol=1e-13, atol=1e-12).y[:, -1]


def assert_agree(actual, expected, tolerance=1e-9):
    scale = np.array([1.0, 1e-3, 1e4, 1e-3, 1.0])
    assert np.all(np.abs(actual - expected) <= tolerance * (np.abs(expected) + scale))


@pytest.mark.parametrize("curvature", [False, True])
@pytest.mark.parametrize(("thrust", "angle"), [(0.0, 0.0), (THRUST, 1.4), (THRUST, 0.3), (5100.0, 3.0)])
def test_motion_is_that_of_the_published_equations(curvature, thrust, angle):
    plant = fly(lander(curvature=curvature), 60.0, thrust, angle)
    expected = published([1689.0, -1.6, 18148.0, 0.0, 940.0], 60.0, thrust, angle, curvature)
    assert_agree(state(plant), expected)


@pytest.mark.parametrize("curvature", [False, True])
def test_a_flight_of_changing_commands_is_that_of_the_published_equations(curvature):
    generator = np.random.default_rng(1)
    plant = lander(curvature=curvature)
    expected = state(plant)
    for _ in range(20):
        thrust, angle = generator.uniform(3500.0, 5100.0), generator.uniform(0.8, 2.0)
        expected = published(expected, 5.0, thrust, angle, curvature)
        fly(plant, 5.0, thrust, angle)
        assert_agree(state(plant), expected)


def test_start_is_given_in_the_published_terms():
    plant = lander(initial_speed=1500.0, initial_path_angle=-1.7, initial_altitude=2e4, initial_central_angle=0.3)
    assert state(plant) == pytest.approx([1500.0, -1.7, 2e4, 0.3, 940.0], rel=1e-15)
    assert not plant.ground_contact


@given(speed=st.floats(10.0, 2500.0), angle=st.floats(-3.1, 3.1), altitude=st.floats(5e4, 5e5))
@settings(max_examples=either(40, 13), deadline=None)
def test_energy_and_angular_momentum_are_conserved_without_thrust(speed, angle, altitude):
    """With the vertical turning; 100 s keep every one of these flights above the ground."""

    def constants(p):
        radius = RADIUS + p.altitude
        return p.speed**2 / 2.0 - MU / radius, radius * p.speed * math.sin(p.path_angle)

    plant = lander(initial_speed=speed, initial_path_angle=angle, initial_altitude=altitude, curvature=True)
    energy, momentum = constants(plant)
    fly(plant, 15.0)
    assert not plant.ground_contact
    # Near the speed of escape the energy is a small difference of its two parts, which carry the rounding.
    assert constants(plant)[0] == pytest.approx(energy, rel=0.0, abs=1e-12 * (speed**2 / 2.0 + MU / RADIUS))
    assert constants(plant)[1] == pytest.approx(momentum, rel=1e-12, abs=1e-12 * RADIUS * speed)


def test_circular_orbit_stays_circular():
    altitude = 1e5
    speed = math.sqrt(MU / (RADIUS + altitude))
    period = math.tau * (RADIUS + altitude) / speed
    plant = lander(
        initial_speed=speed,
        initial_path_angle=math.pi / 2,
        initial_altitude=altitude,
        curvature=True,
        internal_step=1.0,
    )
    fly(plant, period, step=period / 2000)
    assert plant.central_angle == pytest.approx(math.tau, rel=1e-9)
    assert plant.altitude == pytest.approx(altitude, abs=1e-3)


def test_as_published_the_vertical_does_not_turn():
    """Horizontal velocity is then constant without thrust."""
    plant = fly(lander(), 60.0)
    assert plant.speed * math.sin(plant.path_angle) == pytest.approx(1689.0 * math.sin(-1.6), rel=1e-13)


@pytest.mark.parametrize("factor", [1.0, 0.9, 1.1])
def test_rocket_equation(factor):
    """Without gravity, thrust along the path: V grows by c ln(m0/m), the path angle stays."""
    plant = lander(surface_gravity=0.0, initial_path_angle=1.1, thrust_factor=factor)
    fly(plant, 100.0, THRUST, 1.1)
    mass = 940.0 - 100.0 * factor * THRUST / (STANDARD * ISP)
    assert plant.mass == pytest.approx(mass, rel=1e-12)
    assert plant.speed == pytest.approx(1689.0 + STANDARD * ISP * math.log(940.0 / mass), rel=1e-11)
    assert plant.path_angle == pytest.approx(1.1, abs=1e-13)
    assert plant.load_factor == pytest.approx(factor * THRUST / STANDARD / mass, rel=1e-12)


def test_throw_through_standstill():
    """Straight up in a nearly constant field: V = 0 on the way, then straight down, th = pi from 0."""
    plant = fly(lander(initial_speed=16.0, initial_path_angle=0.0, initial_altitude=100.0), 9.0)
    assert plant.path_angle == 0.0
    plant = fly(plant, 11.0)
    assert abs(plant.path_angle) == pytest.approx(math.pi, abs=1e-12)
    assert plant.speed == pytest.approx(20.0 * G0 - 16.0, rel=1e-3)
    assert plant.altitude == pytest.approx(100.0 + 20.0 * 16.0 - 200.0 * G0, abs=0.1)


def test_path_angle_is_continuous_over_whole_turns():
    """Without gravity, thrust across the path: V stays, th grows by (c/V) ln(m0/m), here by two turns."""
    plant = lander(surface_gravity=0.0, initial_speed=10.0, initial_path_angle=0.0)
    angles = [plant.path_angle]
    for k in range(4000):
        plant.thrust, plant.thrust_angle = 3000.0, plant.path_angle + math.pi / 2
        plant.step(0.01 * k, 0.01)
        angles.append(plant.path_angle)
    assert 0.0 < np.diff(angles).min() <= np.diff(angles).max() < 0.01
    assert plant.path_angle > 2.0 * math.tau
    assert plant.path_angle == pytest.approx(STANDARD * ISP / 10.0 * math.log(940.0 / plant.mass), rel=2e-2)


def test_start_beyond_a_turn_stays_there():
    assert lander(initial_path_angle=-1.6 - math.tau).path_angle == pytest.approx(-1.6 - math.tau, rel=1e-15)


def test_standstill_keeps_the_path_angle():
    plant = lander(initial_speed=0.0, initial_path_angle=-2.0)
    assert (plant.speed, plant.path_angle) == (0.0, -2.0)


def test_ground_contact_is_kept():
    plant = fly(lander(initial_altitude=50.0, initial_path_angle=math.pi, initial_speed=10.0), 10.0)
    assert plant.ground_contact
    assert -2.0 < plant.altitude <= 0.0
    assert plant.speed == pytest.approx(math.sqrt(100.0 + 2.0 * G0 * 50.0), rel=0.02)
    retained = state(plant)
    fly(plant, 1.0, THRUST, 0.0)
    assert state(plant).tolist() == retained.tolist()
    assert plant.ground_contact


def test_thrust_ends_with_the_mass():
    plant = fly(lander(initial_mass=20.0, initial_altitude=1e6), 20.0, THRUST, 0.0)
    assert 0.0 < plant.mass <= 0.1 * THRUST / (STANDARD * ISP)
    mass = plant.mass
    vertical = plant.speed * math.cos(plant.path_angle)
    fly(plant, 1.0, THRUST, 0.0)
    assert plant.mass == mass
    assert plant.speed * math.cos(plant.path_angle) < vertical


def test_integrator_is_of_fourth_order():
    exact = published([1689.0, -1.6, 18148.0, 0.0, 940.0], 64.0, 5100.0, 1.2, True)
    errors = []
    for internal in (8.0, 4.0, 2.0):
        plant = lander(curvature=True, internal_step=internal)
        fly(plant, 64.0, 5100.0, 1.2, step=64.0)
        errors.append(np.abs(state(plant) - exact)[[0, 2]])
    orders = np.log2(np.array(errors)[:-1] / np.array(errors)[1:])
    assert orders[-1] == pytest.approx([4.0, 4.0], abs=0.3)


@given(st.lists(st.integers(1, 400), min_size=1, max_size=12))
@settings(max_examples=either(30, 10), deadline=None)
def test_results_do_not_depend_on_how_communication_cuts_them(cuts):
    whole = fly(lander(), 10.0, THRUST, 1.2, step=10.0)
    points = sorted({0.0, 10.0, *(10.0 * value / 401.0 for value in np.cumsum(cuts) % 401)})
    cut = lander()
    cut.thrust, cut.thrust_angle = THRUST, 1.2
    for first, second in itertools.pairwise(points):
        cut.step(first, second - first)
    assert_agree(state(cut), state(whole), 1e-11)


def test_declared_starts_are_the_published_nominal_start():
    plant = PlanarMoonLander()
    plant.initialize()
    assert state(plant) == pytest.approx([1689.0, -1.6, 18148.0, 0.0, 940.0], rel=1e-15)
