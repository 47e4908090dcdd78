"""Eclipses, plates, sphere and gravity gradient. Truth: areas by quadrature, another program, and closed forms."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from perilune.fmus_src.kernel.matrices import Matrix, matrix
from perilune.fmus_src.mathlib.space import surfaces
from perilune.fmus_src.mathlib.space.eclipse import illumination
from perilune.fmus_src.mathlib.space.ephemerides import ASTRONOMICAL_UNIT, SUN_RADIUS
from perilune.fmus_src.mathlib.space.gravity_gradient import gravity_gradient_torque
from perilune.fmus_src.mathlib.vectors import vector

RADIUS = 6378137.0  # m
SUN = (1.496e11, 0.0, 0.0)  # m
# Height (km) of the ray above the axis of the shadow: visible fraction of the disk, areas by quadrature.
SHADOW = {6368: 0.0, 6370: 0.05047885696709, 6372.5: 0.17779207855760, 6375: 0.33511305660085,
          6377.5: 0.50461069130581, 6380: 0.67305858384099, 6382.5: 0.82749573055528, 6385: 0.95104816218728,
          6387: 1.0, 6389: 1.0}  # fmt: skip

PLATES = Matrix([
    [0.48, 1.0, 0.0, 0.0, 0.3, 0.01, 0.02, 2.2, 0.3, 0.2],
    [0.48, 0.0, 1.0, 0.0, 0.0, 0.31, 0.0, 2.2, 0.3, 0.2],
    [0.36, 0.0, 0.0, -1.0, 0.01, 0.0, -0.4, 2.2, 0.1, 0.4],
    [0.9, 0.6, 0.0, 0.8, 0.0, -0.9, 0.1, 2.4, 0.1, 0.1],
    [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.2, 0.3, 0.2],
])  # fmt: skip
VELOCITY = vector(7000.0, 2000.0, -500.0)  # m/s
TO_SUN = vector(0.6, 0.48, 0.64)


@pytest.mark.parametrize("kilometres", SHADOW)
def test_half_shadow(kilometres):
    light = illumination(vector(-2e6, 1000.0 * kilometres, 1e5), vector(*SUN), RADIUS)
    assert light == pytest.approx(SHADOW[kilometres], abs=1e-9)


@given(st.floats(0.0, 1.0))
def test_half_shadow_by_quadrature(fraction):
    """Both disks as circles in a plane: the visible area of the Sun's, strip by strip."""
    y = 6.3675e6 + 2.0e4 * fraction
    position = np.array([-2e6, y, 0.0])
    away = np.array(SUN) - position
    a, b = np.arcsin(SUN_RADIUS / np.linalg.norm(away)), np.arcsin(RADIUS / np.linalg.norm(position))
    c = np.arctan2(np.linalg.norm(np.cross(position, away)), -position @ away)

    def visible(x):
        half, other = np.sqrt(max(a * a - x * x, 0.0)), np.sqrt(max(b * b - (x - c) ** 2, 0.0))
        return 2.0 * max(half - other, 0.0)

    corners = np.clip([c - b, (c * c + a * a - b * b) / (2.0 * c)], -a, a)
    area = quad(visible, -a, a, points=corners, epsabs=1e-16, limit=400)[0]
    light = illumination(vector(*position), vector(*SUN), RADIUS)
    assert light == pytest.approx(area / (np.pi * a * a), abs=1e-6)


def test_shadow_far_away():
    """Beyond the end of the shadow a ring of the Sun is left: 1 - b^2/a^2; before it nothing, by day all."""
    far = 1.6e9
    a = np.arcsin(SUN_RADIUS / (1.496e11 + far))
    b = np.arcsin(RADIUS / far)
    assert illumination(vector(-far, 0.0, 0.0), vector(*SUN), RADIUS) == pytest.approx(1.0 - (b / a) ** 2, rel=1e-12)
    assert illumination(vector(-7e6, 0.0, 0.0), vector(*SUN), RADIUS) == 0.0
    assert illumination(vector(7e6, 0.0, 0.0), vector(*SUN), RADIUS) == 1.0


def test_plates():
    drag = surfaces.plate_drag(PLATES, 5e-13, VELOCITY)
    assert drag.force.elements() == pytest.approx((-3.1689e-05, -9.054e-06, 2.2635e-06), rel=1e-12)
    assert drag.torque.elements() == pytest.approx((-4.272e-07, -1.695615e-06, -1.2763260e-05), rel=1e-12)
    solar = surfaces.plate_pressure(PLATES, surfaces.pressure_at(ASTRONOMICAL_UNIT, 1.0), TO_SUN)
    force = (-4.072722321093214e-06, -2.7706044666407187e-06, -3.793641405935569e-06)
    torque = (2.4769507263534964e-06, -9.208612025590054e-08, -2.1790024009636694e-06)
    assert solar.force.elements() == pytest.approx(force, rel=1e-12)
    assert solar.torque.elements() == pytest.approx(torque, rel=1e-12)


def test_a_mirror_and_a_black_plate():
    """Facing the Sun, a mirror takes twice the momentum of a black plate, a diffuse one 5/3 of it."""
    for specular, diffuse, factor in [(1.0, 0.0, 2.0), (0.0, 0.0, 1.0), (0.0, 1.0, 5.0 / 3.0)]:
        plate = Matrix([[2.0, 0.0, 0.0, 1.0, 0.1, 0.0, 0.0, 2.2, specular, diffuse]])
        force = surfaces.plate_pressure(plate, 4.5e-6, vector(0.0, 0.0, 1.0)).force
        assert force.elements() == pytest.approx((0.0, 0.0, -factor * 9e-6), rel=1e-15)


def test_the_pressure_falls_with_the_square_of_the_distance():
    assert surfaces.pressure_at(2.0 * ASTRONOMICAL_UNIT, 0.5) == pytest.approx(1361.0 / 299792458.0 / 8.0, rel=1e-15)


def test_sphere():
    force = surfaces.sphere_drag(1.5, 2.2, 4e-13, vector(0.0, 7500.0, 0.0))
    assert force.elements() == pytest.approx((0.0, -0.5 * 4e-13 * 2.2 * 1.5 * 7500.0**2, 0.0), rel=1e-15)
    assert surfaces.sphere_pressure(1.5, 1.3, 4.5e-6, vector(1.0, 0.0, 0.0)).x == pytest.approx(-1.5 * 1.3 * 4.5e-6)


def test_gravity_gradient():
    inertia = matrix([4.2, -0.05, 0.02], [-0.05, 4.0, 0.03], [0.02, 0.03, 3.0])
    torque = gravity_gradient_torque(vector(4e6, 3e6, 4.7e6), inertia, 3.986004415e14)
    expected = (-1.0461728601568117e-06, 1.6987470222748036e-06, -1.9394672897812067e-07)
    assert torque.elements() == pytest.approx(expected, rel=1e-13)
