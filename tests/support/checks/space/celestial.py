"""Positions of Sun and Moon from the Earth's centre, and the Earth's axes, as tables of terms.

Frame: axes of the GCRS. Times are TT in seconds since J2000.0. Sources: Meeus 1998, chapter 25; Simon et al. 1994;
Montenbruck and Gill 2000, section 3.3.2; Capitaine, Wallace and Chapront 2003; Wallace and Capitaine 2008.
"""

import numpy as np

UNIT = 149597870700.0  # m
SUN_PARAMETER, MOON_PARAMETER = 1.32712440018e20, 4.902800066e12  # m3/s2
EARTH_RATE = 2.0 * np.pi * 1.00273781191135448 / 86400.0  # rad/s
ARCSECOND = np.pi / 648000.0

# Terms of the Moon: amplitude, then multiples of l, l', D, F. Longitude (arcseconds), the small ones of latitude
# (arcseconds), distance (km).
LONGITUDE = np.array([
    [22640, 1, 0, 0, 0], [-4586, 1, 0, -2, 0], [2370, 0, 0, 2, 0], [769, 2, 0, 0, 0], [-668, 0, 1, 0, 0],
    [-412, 0, 0, 0, 2], [-212, 2, 0, -2, 0], [-206, 1, 1, -2, 0], [192, 1, 0, 2, 0], [-165, 0, 1, -2, 0],
    [-125, 0, 0, 1, 0], [-110, 1, 1, 0, 0], [148, 1, -1, 0, 0], [-55, 0, 0, -2, 2],
])  # fmt: skip
LATITUDE = np.array([
    [-526, 0, 0, -2, 1], [44, 1, 0, -2, 1], [-31, -1, 0, -2, 1], [-23, 0, 1, -2, 1], [11, 0, -1, -2, 1],
    [-25, -2, 0, 0, 1], [21, -1, 0, 0, 1],
])  # fmt: skip
DISTANCE = np.array([
    [385000, 0, 0, 0, 0], [-20905, 1, 0, 0, 0], [-3699, -1, 0, 2, 0], [-2956, 0, 0, 2, 0], [-570, 2, 0, 0, 0],
    [246, 2, 0, -2, 0], [-205, 0, 1, -2, 0], [-171, 1, 0, 2, 0], [-152, 1, 1, -2, 0],
])  # fmt: skip


def equatorial(longitude, latitude, distance):
    """Return a position (m) from the angles (rad) of the ecliptic of J2000.0."""
    across = np.exp(1j * longitude) * np.cos(latitude)
    tilted = complex(across.imag, np.sin(latitude)) * np.exp(1j * np.radians(23.43929111))
    return distance * np.array([across.real, tilted.real, tilted.imag])


def sun(time):
    """Return the position of the Sun (m)."""
    t = time / 3155760000.0
    anomaly, perihelion = np.radians(357.52911 + 35999.05029 * t), np.radians(282.93735 + 0.32256 * t)
    centre = np.radians([1.914602 - 0.004817 * t, 0.019993, 0.000289]) @ np.sin(np.arange(1, 4) * anomaly)
    wobble = 6.45 * ARCSECOND * np.sin(np.radians(297.85 + 445267.1115 * t))
    e = 0.016708634 - 0.000042037 * t
    true_anomaly = anomaly + centre + wobble
    distance = 1.000001018 * UNIT * (1.0 - e**2) / (1.0 + e * np.cos(true_anomaly))
    return equatorial(perihelion + true_anomaly, 0.0, distance)


def moon(time):
    """Return the position of the Moon (m)."""
    t = time / 3155760000.0
    start = np.array([0.374897, 0.993133, 0.827361, 0.259086])
    rate = np.array([1325.552410, 99.997361, 1236.853086, 1342.227825])
    arguments = 2.0 * np.pi * np.modf(start + rate * t)[0]
    add = lambda terms, wave: terms[:, 0] @ wave(terms[:, 1:] @ arguments)  # noqa: E731 - a sum of a table
    longitude = ARCSECOND * add(LONGITUDE, np.sin)
    argument = (
        arguments[3] + longitude + ARCSECOND * (412.0 * np.sin(2.0 * arguments[3]) + 541.0 * np.sin(arguments[1]))
    )
    latitude = ARCSECOND * (18520.0 * np.sin(argument) + add(LATITUDE, np.sin))
    mean = 2.0 * np.pi * np.modf(0.606433 + 1336.851344 * t)[0]
    return equatorial(mean + longitude, latitude, 1000.0 * add(DISTANCE, np.cos))


def earth_pole(time):
    """Return the rotation Q from inertial axes to those of the pole; its last row is the pole."""
    d, t = time / 86400.0, time / 3155760000.0
    node, sun, moon, anomaly = np.array([2.182439196616, 4.894961, 3.810344, 6.240060]) + t * np.array(
        [-33.757045934, 628.3319662, 8399.7091135, 628.301955]
    )
    waves = np.array([node, 2.0 * sun, 2.0 * moon, 2.0 * node])
    x = 2.6603e-7 * d + 1e-6 * (np.array([-33.2, -2.54, -0.44, 0.40]) @ np.sin(waves) + 0.28 * np.sin(anomaly))
    y = -8.14e-14 * d**2 + 1e-6 * (np.array([44.6, 2.78, 0.47, -0.43]) @ np.cos(waves))
    pole = np.array([x, y, np.sqrt(1.0 - x**2 - y**2)])
    q = np.eye(3) - np.outer(pole, pole) / (1.0 + pole[2])  # by the shortest turn from z
    q[2] = pole
    q[:2, 2] = -pole[:2]
    return q


def earth_angle(time, tt_minus_ut1):
    """Return the Earth rotation angle (rad), 0 to 2 pi."""
    days = (time - tt_minus_ut1) / 86400.0
    return 2.0 * np.pi * ((np.modf(days)[0] + 0.7790572732640 + 0.00273781191135448 * days) % 1.0)


def earth_fixed(time, pole, tt_minus_ut1):
    """Return the rotation from inertial to planet-fixed axes, with that to the axes of a pole."""
    c, s = np.cos(earth_angle(time, tt_minus_ut1)), np.sin(earth_angle(time, tt_minus_ut1))
    return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) @ pole


def tide(position, body, mu):
    """Return by how much more (m/s2) a body pulls at a position than at the origin (m)."""
    away = body - position
    return mu * (away / np.linalg.norm(away) ** 3 - body / np.linalg.norm(body) ** 3)
