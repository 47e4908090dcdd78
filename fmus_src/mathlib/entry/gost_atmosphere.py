"""Standard atmosphere of GOST 4401-81. Kernel functions.

Up to 85 km of geopotential height the layers are the same as in the US Standard Atmosphere 1976; from there to 94 km of
height the temperature is constant at 186.65 K. Above 94 km, where the molar mass decreases, the logarithm of the
density is linear between selected rows of the standard's table, within 0.8 % of the omitted rows; the speed of sound,
for which the standard has no values there, is constant. Source: GOST 4401-81, "Standard atmosphere. Parameters" (in
Russian).
"""

import math

from ...kernel.functions import exp, log
from .standard_atmosphere import EARTH_RADIUS, GAS_CONSTANT, GRAVITY, HEAT_RATIO, Air, air_in_layers

COLD = 186.65  # K, temperature from COLD_FROM to TABLE_FROM
COLD_FROM = 85000.0  # m, geopotential height
TABLE_FROM = 94000.0  # m, height
ROWS = 14


def tabulated_density(h: float) -> float:
    """Return the density (kg/m3) at a height h (m) above 94 km; constant above 130 km."""
    height = [94.0, 95.0, 96.0, 98.0, 100.0, 104.0, 106.0, 108.0, 110.0, 113.0, 116.0, 120.0, 125.0, 130.0]  # km
    density = [
        1.67840e-6, 1.40510e-6, 1.16617e-6, 7.99924e-7, 5.54951e-7, 2.75614e-7, 1.86514e-7,
        1.30060e-7, 9.34035e-8, 5.94575e-8, 3.96418e-8, 2.44041e-8, 1.52430e-8, 9.68064e-9,
    ]  # fmt: skip
    kilometres = 1e-3 * h
    if kilometres >= height[ROWS - 1]:
        return density[ROWS - 1]
    k = 0
    while k < ROWS - 2 and kilometres >= height[k + 1]:
        k = k + 1
    fraction = (kilometres - height[k]) / (height[k + 1] - height[k])
    return density[k] * exp(fraction * log(density[k + 1] / density[k]))


def gost_air(h: float) -> Air:
    """Return density and speed of sound at the height h (m) above the sphere."""
    geopotential = EARTH_RADIUS * h / (EARTH_RADIUS + h)
    if geopotential <= COLD_FROM:
        return air_in_layers(geopotential)
    sound = math.sqrt(HEAT_RATIO * GAS_CONSTANT * COLD)
    if h >= TABLE_FROM:
        return Air(density=tabulated_density(h), speed_of_sound=sound)
    base = air_in_layers(COLD_FROM)
    risen = GRAVITY * (geopotential - COLD_FROM) / (GAS_CONSTANT * COLD)
    return Air(density=base.density * exp(-risen), speed_of_sound=sound)
