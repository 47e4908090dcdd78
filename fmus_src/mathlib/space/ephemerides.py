"""Positions of Sun and Moon relative to the Earth's centre, and third-body gravity. Kernel functions.

Frame: axes of the GCRS, geometric positions (no light time, no aberration). t is TT in seconds since J2000.0. Between
2020 and 2040 the largest differences from DE421 are 31.6 arcseconds (rms 16.2) and 1.2e4 km for the Sun, 293 arcseconds
(rms 76) and 497 km for the Moon.
"""

import math

from ...kernel.functions import cos, sin
from ..vectors import Vector3, dot, norm, vector

CENTURY = 36525.0 * 86400.0  # s
ASTRONOMICAL_UNIT = 149597870700.0  # m
SUN_PARAMETER = 1.32712440018e20  # m3/s2, gravitational parameter, as the next two
MOON_PARAMETER = 4.902800066e12
EARTH_PARAMETER = 3.986004415e14
SUN_RADIUS = 6.957e8  # m
MOON_SHADOW_RADIUS = 1737400.0  # m
DEGREE = math.pi / 180.0
ARCSECOND = DEGREE / 3600.0
TURN = 2.0 * math.pi
OBLIQUITY = 23.43929111 * DEGREE  # at J2000.0


def from_ecliptic(longitude: float, latitude: float, distance: float) -> Vector3:
    """Return a position (m, GCRS axes) from ecliptic longitude and latitude (rad, J2000.0) and a distance (m)."""
    x = distance * cos(latitude) * cos(longitude)
    y = distance * cos(latitude) * sin(longitude)
    z = distance * sin(latitude)
    c = cos(OBLIQUITY)
    s = sin(OBLIQUITY)
    return vector(x, c * y - s * z, s * y + c * z)


def sun_position(t: float) -> Vector3:
    """Return the position of the Sun (m, GCRS axes) at t (s).

    Source: Meeus 1998, chapter 25 (anomaly, equation of the centre, eccentricity); Simon et al. 1994 (perihelion in the
    fixed ecliptic). The largest term of the Earth's motion about the Earth-Moon barycentre is included.
    """
    T = t / CENTURY  # noqa: N806 - as in the source
    m = (357.52911 + 35999.05029 * T) * DEGREE
    perihelion = (282.93735 + 0.32256 * T) * DEGREE
    elongation = (297.85 + 445267.1115 * T) * DEGREE
    centre = (1.914602 - 0.004817 * T) * sin(m) + 0.019993 * sin(2.0 * m) + 0.000289 * sin(3.0 * m)
    longitude = perihelion + m + centre * DEGREE + 6.45 * ARCSECOND * sin(elongation)
    e = 0.016708634 - 0.000042037 * T
    r = 1.000001018 * ASTRONOMICAL_UNIT * (1.0 - e * e) / (1.0 + e * cos(longitude - perihelion))
    return from_ecliptic(longitude, 0.0, r)


def moon_position(t: float) -> Vector3:
    """Return the position of the Moon (m, GCRS axes) at t (s). Source: Montenbruck and Gill 2000, section 3.3.2."""
    T = t / CENTURY  # noqa: N806 - as in the source
    mean = (0.606433 + 1336.851344 * T) * TURN
    l = (0.374897 + 1325.552410 * T) * TURN  # noqa: E741 - the Moon's mean anomaly
    sun = (0.993133 + 99.997361 * T) * TURN  # mean anomaly of the Sun
    d = (0.827361 + 1236.853086 * T) * TURN  # elongation
    f = (0.259086 + 1342.227825 * T) * TURN  # argument of latitude
    d2 = 2.0 * d
    f2 = 2.0 * f
    dl = 22640.0 * sin(l) - 4586.0 * sin(l - d2) + 2370.0 * sin(d2) + 769.0 * sin(2.0 * l)
    dl = dl - 668.0 * sin(sun) - 412.0 * sin(f2) - 212.0 * sin(2.0 * l - d2) - 206.0 * sin(l + sun - d2)
    dl = dl + 192.0 * sin(l + d2) - 165.0 * sin(sun - d2) - 125.0 * sin(d) - 110.0 * sin(l + sun)
    dl = dl + 148.0 * sin(l - sun) - 55.0 * sin(f2 - d2)
    s = f + (dl + 412.0 * sin(f2) + 541.0 * sin(sun)) * ARCSECOND
    n = -526.0 * sin(f - d2) + 44.0 * sin(l + f - d2) - 31.0 * sin(f - l - d2) - 23.0 * sin(sun + f - d2)
    n = n + 11.0 * sin(f - sun - d2) - 25.0 * sin(f - 2.0 * l) + 21.0 * sin(f - l)
    r = 385000.0 - 20905.0 * cos(l) - 3699.0 * cos(d2 - l) - 2956.0 * cos(d2) - 570.0 * cos(2.0 * l)
    r = r + 246.0 * cos(2.0 * l - d2) - 205.0 * cos(sun - d2) - 171.0 * cos(l + d2) - 152.0 * cos(l + sun - d2)
    return from_ecliptic(mean + dl * ARCSECOND, (18520.0 * sin(s) + n) * ARCSECOND, 1000.0 * r)


def third_body_acceleration(position: Vector3, body: Vector3, mu: float) -> Vector3:
    """Return the gravity of a body at ``body`` (m) on a point at ``position`` (m) minus that on the origin (m/s2).

    ``mu`` is the gravitational parameter (m3/s2) of the body. Source: Montenbruck and Gill 2000, section 3.3.
    """
    d = body - position
    return mu * (d / (dot(d, d) * norm(d)) - body / (dot(body, body) * norm(body)))
