"""Potential fields in spherical coordinates, with scipy's associated Legendre functions.

Tables: GGM03S to degree 8 (Tapley et al. 2007, fully normalised) and IGRF-14 at 2025.0 (Alken et al. 2025, Schmidt).
"""

from functools import cache
from pathlib import Path

import numpy as np
from scipy.special import factorial, lpmv

HERE = Path(__file__).parent
EARTH_PARAMETER, EARTH_RADIUS = 3.986004415e14, 6378136.3  # m3/s2, m
FIELD_RADIUS = 6371200.0  # m
FIELD_START, FIELD_END = 788961600.0, 788961600.0 + 1826.0 * 86400.0  # s TT: 2025 and 2030 begin


@cache
def read(name):
    """Return the columns of a table: degree, order, then coefficients."""
    return np.loadtxt(HERE / f"{name}.csv", delimiter=",", skiprows=1).T


def schmidt(n, m):
    """Return the factor from Schmidt's coefficients to those of the functions without normalisation."""
    return np.sqrt(np.where(m == 0, 1.0, 2.0) * factorial(n - m) / factorial(n + m))


def gradient(position, mu, radius, n, m, c, s):
    """Return mu grad(sum (R/r)^n/r P_nm (c cos m L + s sin m L)), planet-fixed, at a position off the axis.

    Source: Hofmann-Wellenhof and Moritz 2006, section 2.5: the derivatives along r, latitude and longitude.
    """
    r = np.linalg.norm(position)
    u = position / r
    cosine, longitude = np.hypot(u[0], u[1]), np.arctan2(u[1], u[0])
    phase = (-1.0) ** m  # of Condon and Shortley, which geodesy leaves out
    p, lower = phase * lpmv(m, n, u[2]), phase * lpmv(m, n - 1, u[2])
    slope = ((n + m) * lower - n * u[2] * p) / cosine  # dP/d latitude
    wave = c * np.cos(m * longitude) + s * np.sin(m * longitude)
    wave_slope = m * (s * np.cos(m * longitude) - c * np.sin(m * longitude))
    size = mu / r**2 * (radius / r) ** n
    up = -(size * (n + 1.0) * p * wave).sum()
    north = (size * slope * wave).sum()
    east = (size * p * wave_slope).sum() / cosine
    eastward = np.array([-u[1], u[0], 0.0]) / cosine
    return up * u + north * np.cross(u, eastward) + east * eastward


def earth_gravity(position, degree):
    """Return the acceleration (m/s2) at a position (m), both planet-fixed."""
    n, m, c, s = read("earth_ggm03s")
    n, m, c, s = (column[n <= degree] for column in (n, m, c, s))
    factor = np.sqrt(2.0 * n + 1.0) * schmidt(n, m)
    central = -EARTH_PARAMETER / np.linalg.norm(position) ** 3 * position
    return central + gradient(position, EARTH_PARAMETER, EARTH_RADIUS, n, m, factor * c, factor * s)


def magnetic_field(position, time, degree):
    """Return the flux density (T) at a position (m), both planet-fixed, by the coefficients of a time (TT, s)."""
    n, m, g, h, g_rate, h_rate = (column[read("igrf14")[0] <= degree] for column in read("igrf14"))
    years = 5.0 * (time - FIELD_START) / (FIELD_END - FIELD_START)
    factor = -1e-9 * FIELD_RADIUS**2 * schmidt(n, m)
    return gradient(position, 1.0, FIELD_RADIUS, n, m, factor * (g + years * g_rate), factor * (h + years * h_rate))
