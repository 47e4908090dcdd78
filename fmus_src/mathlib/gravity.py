"""The Moon as a sphere, seen from the landing site. Kernel functions.

Frame: landing site, origin on the sphere of ``radius`` (m), z up, not rotating: the Moon's centre
is at (0, 0, -radius).
"""

import math

STANDARD_GRAVITY = 9.80665  # m/s2, which specific impulse refers to


def altitude_of(position: list, radius: float) -> float:
    """Altitude (m) above the sphere of ``radius`` (m)."""
    z = position[2] + radius
    return math.sqrt(position[0] * position[0] + position[1] * position[1] + z * z) - radius


def central_gravity(position: list, radius: float, gravitational_parameter: float, gravity: list) -> None:
    """gravity (m/s2) = that of a central field at ``position`` (m); not at the centre itself."""
    z = position[2] + radius
    square = position[0] * position[0] + position[1] * position[1] + z * z
    scale = gravitational_parameter / (square * math.sqrt(square))
    gravity[0] = -scale * position[0]
    gravity[1] = -scale * position[1]
    gravity[2] = -scale * z
