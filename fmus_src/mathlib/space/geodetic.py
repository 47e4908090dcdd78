"""Height above the ellipsoid of the Earth. Kernel functions."""

import math

EQUATORIAL_RADIUS = 6378137.0  # m
FLATTENING = 1.0 / 298.257223563
POLAR_RADIUS = EQUATORIAL_RADIUS * (1.0 - FLATTENING)
ECCENTRICITY_SQUARED = FLATTENING * (2.0 - FLATTENING)
SECOND_SQUARED = ECCENTRICITY_SQUARED / (1.0 - ECCENTRICITY_SQUARED)  # square of the second eccentricity


def geodetic_height(equatorial: float, z: float) -> float:
    """Return the height (m) above the ellipsoid, at a distance (m) from the axis and z (m) from the equator plane.

    One iteration of Bowring's formula is accurate to 2.4e-9 m from 100 to 1500 km of height. The point must not be the
    Earth's centre. Source: Bowring 1976.
    """
    a = EQUATORIAL_RADIUS
    b = POLAR_RADIUS
    length = math.sqrt(z * a * (z * a) + equatorial * b * (equatorial * b))
    sine = z * a / length  # of the reduced latitude
    cosine = equatorial * b / length
    up = z + SECOND_SQUARED * b * sine * sine * sine
    out = equatorial - ECCENTRICITY_SQUARED * a * cosine * cosine * cosine
    length = math.sqrt(up * up + out * out)
    sine = up / length  # of the geodetic latitude
    cosine = out / length
    return equatorial * cosine + z * sine - a * math.sqrt(1.0 - ECCENTRICITY_SQUARED * sine * sine)
