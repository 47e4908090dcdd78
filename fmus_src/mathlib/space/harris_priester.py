"""Density of the upper atmosphere with a diurnal bulge behind the Sun: Harris and Priester. Kernel functions.

The model applies to mean solar activity: at 500 km the ratio of its mean density to the mean density of NRLMSIS 2.0 is
0.96 for F10.7 = 150, 10.1 for F10.7 = 70 and 0.28 for F10.7 = 230. Density factors from 0.1 to 4 cover the variation
over a solar cycle.

Source: Montenbruck and Gill 2000, section 3.5.2 and table 3.8.
"""

import math

from ...kernel.functions import exp, log, pow
from ..vectors import Vector3, dot, norm, vector

ROWS = 50
COSINE = math.sqrt(0.75)  # cosine of the bulge's lag of 30 degrees in right ascension
SINE = 0.5

HEIGHT = (  # km
    100.0, 120.0, 130.0, 140.0, 150.0, 160.0, 170.0, 180.0, 190.0, 200.0, 210.0, 220.0, 230.0, 240.0, 250.0,
    260.0, 270.0, 280.0, 290.0, 300.0, 320.0, 340.0, 360.0, 380.0, 400.0, 420.0, 440.0, 460.0, 480.0, 500.0,
    520.0, 540.0, 560.0, 580.0, 600.0, 620.0, 640.0, 660.0, 680.0, 700.0, 720.0, 740.0, 760.0, 780.0, 800.0,
    840.0, 880.0, 920.0, 960.0, 1000.0,
)  # fmt: skip
LOWEST = (  # 1e-12 kg/m3, opposite to the bulge
    497400.0, 24900.0, 8377.0, 3899.0, 2122.0, 1263.0, 800.8, 528.3, 361.7, 255.7, 183.9, 134.1, 99.49, 74.88,
    57.09, 44.03, 34.3, 26.97, 21.39, 17.08, 10.99, 7.214, 4.824, 3.274, 2.249, 1.558, 1.091, 0.7701, 0.5474,
    0.3916, 0.2819, 0.2042, 0.1488, 0.1092, 0.0807, 0.06012, 0.04519, 0.0343, 0.02632, 0.02043, 0.01607,
    0.01281, 0.01036, 0.008496, 0.007069, 0.00468, 0.0032, 0.00221, 0.00156, 0.00115,
)  # fmt: skip
HIGHEST = (  # 1e-12 kg/m3, at the apex of the bulge
    497400.0, 24900.0, 8710.0, 4059.0, 2215.0, 1344.0, 875.8, 601.0, 429.7, 316.2, 239.6, 185.3, 145.5, 115.7,
    93.08, 75.55, 61.82, 50.95, 42.26, 35.26, 25.11, 18.19, 13.37, 9.955, 7.492, 5.684, 4.355, 3.362, 2.612,
    2.042, 1.605, 1.267, 1.005, 0.7997, 0.639, 0.5123, 0.4121, 0.3325, 0.2691, 0.2185, 0.1779, 0.1452, 0.119,
    0.09776, 0.08059, 0.05741, 0.0421, 0.0313, 0.0236, 0.0181,
)  # fmt: skip


def bulge_fraction(position: Vector3, sun: Vector3, exponent: float) -> float:
    """Return the bulge fraction cos^n of half the angle from the apex: 1 at the apex, 0 opposite to it.

    ``sun`` is the unit vector to the Sun; both vectors are inertial and relative to the Earth's centre. The exponent n
    is 2 for orbits of low inclination and 6 for polar orbits.
    """
    apex = vector(COSINE * sun.x - SINE * sun.y, SINE * sun.x + COSINE * sun.y, sun.z)
    square = 0.5 + 0.5 * dot(position, apex) / norm(position)
    if not square > 0.0:
        return 0.0
    return pow(square, 0.5 * exponent)


def harris_priester_density(h: float, bulge: float) -> float:
    """Return the density (kg/m3) at a height h (m) for a fraction of the bulge; 0 above 1000 km."""
    kilometres = 1e-3 * h
    if kilometres < HEIGHT[0]:
        kilometres = HEIGHT[0]
    if kilometres >= HEIGHT[ROWS - 1]:
        return 0.0
    k = 0
    while kilometres >= HEIGHT[k + 1]:
        k = k + 1
    fraction = (kilometres - HEIGHT[k]) / (HEIGHT[k + 1] - HEIGHT[k])
    lowest = LOWEST[k] * exp(fraction * log(LOWEST[k + 1] / LOWEST[k]))
    highest = HIGHEST[k] * exp(fraction * log(HIGHEST[k + 1] / HIGHEST[k]))
    return 1e-12 * (lowest + (highest - lowest) * bulge)
