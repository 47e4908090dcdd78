"""US Standard Atmosphere 1976. Kernel functions.

Up to 86 km it consists of layers of geopotential height, each with its lapse rate; above, the logarithm of the density
is linear between tabulated points and the speed of sound is constant. Source: U.S. Standard Atmosphere 1976
(NASA-TM-X-74335), equations 23 and 33 and table IV.
"""

import math

from ...kernel.functions import exp, log, pow
from ...kernel.records import Field, Record

EARTH_RADIUS = 6356766.0  # m, used for geopotential heights
GRAVITY = 9.80665  # m/s2
GAS_CONSTANT = 287.053  # J/(kg K), for air
HEAT_RATIO = 1.4
TOP = 86000.0  # m, height of the top of the layers
THIN_SOUND = 274.096  # m/s, speed of sound above TOP


class Air(Record):
    """Density and speed of sound of air at rest."""

    density = Field(unit="kg/m3")
    speed_of_sound = Field(unit="m/s")


def thin_density(h: float) -> float:
    """Return the density (kg/m3) at a height h (m) above 86 km; constant above 130 km."""
    height = [86000.0, 90000.0, 95000.0, 100000.0, 105000.0, 110000.0, 115000.0, 120000.0, 130000.0]
    density = [6.958e-6, 3.416e-6, 1.393e-6, 5.604e-7, 2.325e-7, 9.708e-8, 4.289e-8, 2.222e-8, 8.152e-9]
    if h >= height[8]:
        return density[8]
    k = 0
    while k < 7 and h >= height[k + 1]:
        k = k + 1
    fraction = (h - height[k]) / (height[k + 1] - height[k])
    return density[k] * exp(fraction * log(density[k + 1] / density[k]))


def air_in_layers(geopotential: float) -> Air:
    """Return density and speed of sound at a geopotential height (m), with the highest layer extended to 90 km."""
    base = [0.0, 11000.0, 20000.0, 32000.0, 47000.0, 51000.0, 71000.0, 90000.0]
    lapse = [-0.0065, 0.0, 0.001, 0.0028, 0.0, -0.0028, -0.002]
    temperature = 288.15
    pressure = 101325.0
    for k in range(7):
        top = base[k + 1]
        if geopotential < top:
            top = geopotential
        risen = top - base[k]
        warmer = temperature + lapse[k] * risen
        if lapse[k] == 0.0:
            pressure = pressure * exp(-GRAVITY * risen / (GAS_CONSTANT * temperature))
        else:
            pressure = pressure * pow(temperature / warmer, GRAVITY / (GAS_CONSTANT * lapse[k]))
        temperature = warmer
        if geopotential <= base[k + 1]:
            break
    specific = GAS_CONSTANT * temperature
    return Air(density=pressure / specific, speed_of_sound=math.sqrt(HEAT_RATIO * specific))


def air(h: float) -> Air:
    """Return density and speed of sound at the height h (m) above the sphere."""
    if h >= TOP:
        return Air(density=thin_density(h), speed_of_sound=THIN_SOUND)
    return air_in_layers(EARTH_RADIUS * h / (EARTH_RADIUS + h))
