"""Atmosphere, eclipses and forces on flat plates.

Sources: Montenbruck and Gill 2000, sections 3.4 and 3.5, table 3.8; the ellipsoid of WGS 84.
"""

import numpy as np
from scipy.optimize import brentq

from tests.support.checks.space.celestial import EARTH_RATE, UNIT
from tests.support.checks.space.harmonics import HERE

HEIGHT, LOWEST, HIGHEST = np.loadtxt(HERE / "harris_priester.csv", delimiter=",", skiprows=1).T
EQUATOR, FLATTENING = 6378137.0, 1.0 / 298.257223563  # m
SUN_RADIUS, SHADOW_RADIUS = 6.957e8, 6378137.0  # m
PRESSURE = 1361.0 / 299792458.0  # N/m2 at one astronomical unit


def height(position):
    """Return the height (m) above the ellipsoid: the distance to its foot, whose normal passes through the position."""
    out, z = np.hypot(position[0], position[1]), position[2]
    ratio = (1.0 - FLATTENING) ** 2

    def miss(latitude):
        """Return how far (m) the normal at a latitude (rad) passes by."""
        n = EQUATOR / np.sqrt(np.cos(latitude) ** 2 + ratio * np.sin(latitude) ** 2)
        return (out - n * np.cos(latitude)) * np.sin(latitude) - (z - ratio * n * np.sin(latitude)) * np.cos(latitude)

    guess = np.arctan2(z, out)
    latitude = brentq(miss, guess - 0.01, guess + 0.01, xtol=1e-15, rtol=1e-15)
    n = EQUATOR / np.sqrt(np.cos(latitude) ** 2 + ratio * np.sin(latitude) ** 2)
    across = (out - n * np.cos(latitude)) * np.cos(latitude) + (z - ratio * n * np.sin(latitude)) * np.sin(latitude)
    return float(across)


def density(position, sun, exponent, h):
    """Return Harris and Priester's density (kg/m3) at a height h (m), at least 100 km; position and Sun inertial."""
    logarithm = [np.interp(h / 1000.0, HEIGHT, np.log(column)) for column in (LOWEST, HIGHEST)]
    lowest, highest = 1e-12 * np.exp(logarithm)
    east = np.exp(1j * np.radians(30.0)) * complex(*sun[:2])
    half = 0.5 * np.arccos(
        np.array([east.real, east.imag, sun[2]]) @ position / np.linalg.norm(position) / np.linalg.norm(sun)
    )
    return lowest + (highest - lowest) * np.cos(half) ** exponent


def segment(radius, distance):
    """Return the area of a disk beyond a chord at a distance, negative beyond its centre."""
    half = np.arctan2(np.sqrt((radius - distance) * (radius + distance)), distance)
    return 0.5 * radius**2 * (2.0 * half - np.sin(2.0 * half))


def light(position, sun):
    """Return how much is visible of the Sun's disk: two segments of disks in the sky cover it."""
    away = sun - position
    a = np.arcsin(SUN_RADIUS / np.linalg.norm(away))
    b = np.arcsin(SHADOW_RADIUS / np.linalg.norm(position))
    c = np.arctan2(np.linalg.norm(np.cross(away, position)), -away @ position)
    if c >= a + b:
        return 1.0
    if c <= b - a:
        return 0.0
    chord = (c - b) / 2.0 + ((c - b) * b + a**2) / (2.0 * c)  # from the Sun's centre: (c^2 + a^2 - b^2)/(2c)
    return 1.0 - (segment(a, chord) + segment(b, c - chord)) / (np.pi * a**2)


def air_velocity(position, pole):
    """Return the velocity (m/s) of air that turns with the Earth, inertial."""
    return EARTH_RATE * np.cross(pole, position)


def loads(plates, force_of_plate):
    """Return force (N) and torque (N m) on plates, of which a function gives the force by normal and coefficients."""
    forces = np.array([row[0] * force_of_plate(row[1:4] / np.linalg.norm(row[1:4]), *row[7:]) for row in plates])
    return forces.sum(axis=0), np.cross(plates[:, 4:7], forces).sum(axis=0)


def drag(plates, rho, velocity):
    """Return the load on plates that move through air, velocity (m/s) in body axes."""
    speed = np.linalg.norm(velocity)
    return loads(plates, lambda n, c_d, s, d: -0.5 * rho * c_d * max(n @ velocity / speed, 0.0) * speed * velocity)


def sunlight(plates, visible, distance, e):
    """Return the load of light from a unit vector e in body axes: absorbed, reflected and scattered photons."""
    p = PRESSURE * (UNIT / distance) ** 2 * visible

    def force(n, c_d, specular, diffuse):
        c = max(n @ e, 0.0)
        absorbed = -(1.0 - specular - diffuse) * e
        mirrored = -2.0 * specular * c * n
        scattered = -diffuse * (e + 2.0 / 3.0 * n)
        return p * c * (absorbed + mirrored + scattered)

    return loads(plates, force)
