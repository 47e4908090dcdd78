"""Magnetic field of the Earth to degree 13: IGRF-14 from 2025 to 2030. Kernel functions.

Source: Alken et al., International Geomagnetic Reference Field: the fourteenth generation, 2025; main field at 2025.0
and its secular variation to degree 8, in Schmidt quasi-normalisation. Outside these years the coefficients are
extrapolated linearly, with unknown accuracy.
"""

from ...kernel.matrices import Matrix, zeros
from ..vectors import Vector3
from .harmonics import SIZE, gradient, schmidt_normalisation, set_pair

RADIUS = 6371200.0  # m, reference radius of the coefficients
DEGREE = 13
VARIATION_DEGREE = 8
DAY = 86400.0  # s
START = 788961600.0  # s TT since J2000.0: 2025-01-01
SPAN = 1826.0  # days from START to 2030-01-01
YEARS = 5.0
NANOTESLA = 1e-9  # T

# g, h (nT) of orders 0 to n at START, for each degree n from 1 on.
FIELD = (
    -29350.0, 0.0, -1410.3, 4545.5,
    -2556.2, 0.0, 2950.9, -3133.6, 1648.7, -814.2,
    1360.9, 0.0, -2404.2, -56.9, 1243.8, 237.6, 453.4, -549.6,
    894.7, 0.0, 799.6, 278.6, 55.8, -134.0, -281.1, 212.0, 12.0, -375.4,
    -232.9, 0.0, 369.0, 45.3, 187.2, 220.0, -138.7, -122.9, -141.9, 42.9, 20.9, 106.2,
    64.3, 0.0, 63.8, -18.4, 76.7, 16.8, -115.7, 48.9, -40.9, -59.8, 14.9, 10.9, -60.8, 72.8,
    79.6, 0.0, -76.9, -48.9, -8.8, -14.4, 59.3, -1.0, 15.8, 23.5, 2.5, -7.4, -11.2, -25.1, 14.3, -2.2,
    23.1, 0.0, 10.9, 7.2, -17.5, -12.6, 2.0, 11.5, -21.8, -9.7, 16.9, 12.7, 14.9, 0.7, -16.8, -5.2, 1.0, 3.9,
    4.7, 0.0, 8.0, -24.8, 3.0, 12.1, -0.2, 8.3, -2.5, -3.4, -13.1, -5.3, 2.4, 7.2, 8.6, -0.6, -8.7, 0.8, -12.8,
    9.8,
    -1.3, 0.0, -6.4, 3.3, 0.2, 0.1, 2.0, 2.5, -1.0, 5.4, -0.5, -9.0, -0.9, 0.4, 1.5, -4.2, 0.9, -3.8, -2.6, 0.9,
    -3.9, -9.0,
    3.0, 0.0, -1.4, 0.0, -2.5, 2.8, 2.4, -0.6, -0.6, 0.1, 0.0, 0.5, -0.6, -0.3, -0.1, -1.2, 1.1, -1.7, -1.0,
    -2.9, -0.1, -1.8, 2.6, -2.3,
    -2.0, 0.0, -0.1, -1.2, 0.4, 0.6, 1.2, 1.0, -1.2, -1.5, 0.6, 0.0, 0.5, 0.6, 0.5, -0.2, -0.1, 0.8, -0.5, 0.1,
    -0.2, -0.9, -1.2, 0.1, -0.7, 0.2,
    0.2, 0.0, -0.9, -0.9, 0.6, 0.7, 0.7, 1.2, -0.2, -0.3, 0.5, -1.3, 0.1, -0.1, 0.7, 0.2, 0.0, -0.2, 0.3, 0.5,
    0.2, 0.6, 0.4, -0.6, -0.5, -0.3, -0.4, -0.5,
)  # fmt: skip

# Rates of g, h (nT a year) of orders 0 to n, for each degree n from 1 to VARIATION_DEGREE.
VARIATION = (
    12.6, 0.0, 10.0, -21.5,
    -11.2, 0.0, -5.3, -27.3, -8.3, -11.1,
    -1.5, 0.0, -4.4, 3.8, 0.4, -0.2, -15.6, -3.9,
    -1.7, 0.0, -2.3, -1.3, -5.8, 4.1, 5.4, 1.6, -6.8, -4.1,
    0.6, 0.0, 1.3, -0.5, 0.0, 2.1, 0.7, 0.5, 2.3, 1.7, 1.0, 1.9,
    -0.2, 0.0, -0.3, 0.3, 0.8, -1.6, 1.2, -0.4, -0.8, 0.8, 0.4, 0.7, 0.9, 0.9,
    -0.1, 0.0, -0.1, 0.6, -0.1, 0.5, 0.5, -0.7, -0.1, 0.0, -0.8, -0.9, -0.8, 0.5, 0.9, -0.3,
    -0.1, 0.0, 0.2, -0.3, 0.0, 0.4, 0.4, -0.3, -0.1, 0.4, 0.3, -0.5, 0.1, -0.6, 0.0, 0.3, 0.3, 0.2,
)  # fmt: skip


def in_validity(t: float) -> bool:
    """Return True if t (s TT since J2000.0) lies between 2025 and 2030."""
    return t >= START and t <= START + SPAN * DAY


def igrf14(t: float) -> Matrix:
    """Return the unnormalised coefficients (nT) at t (s TT since J2000.0) for `magnetic_field`."""
    cs = zeros(SIZE, SIZE)
    years = YEARS * (t - START) / (SPAN * DAY)
    k = 0
    for n in range(1, DEGREE + 1):
        for m in range(n + 1):
            g = FIELD[k]
            h = FIELD[k + 1]
            if n <= VARIATION_DEGREE:
                g = g + years * VARIATION[k]
                h = h + years * VARIATION[k + 1]
            factor = schmidt_normalisation(n, m)
            set_pair(cs, n, m, factor * g, factor * h)
            k = k + 2
    return cs


def magnetic_field(position: Vector3, cs: Matrix, degree: int) -> Vector3:
    """Return the flux density (T, planet-fixed) at a position (m, planet-fixed), to a degree from 1 (dipole) to 13."""
    return -gradient(position, RADIUS * RADIUS * NANOTESLA, RADIUS, cs, degree)
