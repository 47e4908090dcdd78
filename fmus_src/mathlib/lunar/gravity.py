"""Gravity and vertical of a spherical Moon, relative to the landing site. Kernel functions.

Frame: landing site, origin on the sphere of ``radius`` (m), z up, not rotating: the Moon's centre is at (0, 0,
-radius).
"""

import math

from ..vectors import Vector3, dot, norm, vector

STANDARD_GRAVITY = 9.80665  # m/s2, reference of specific impulse


def from_centre(position: Vector3, radius: float) -> Vector3:
    """Return the position (m) relative to the Moon's centre."""
    return vector(position.x, position.y, position.z + radius)


def altitude_of(position: Vector3, radius: float) -> float:
    """Return the altitude (m) above the sphere of ``radius`` (m)."""
    return norm(from_centre(position, radius)) - radius


def vertical_at(position: Vector3, radius: float) -> Vector3:
    """Return the upward unit vector at ``position`` (m); the z axis if it is the Moon's centre."""
    centred = from_centre(position, radius)
    distance = norm(centred)
    if distance > 0.0:
        return centred / distance
    return vector(0.0, 0.0, 1.0)


def central_gravity(position: Vector3, radius: float, gravitational_parameter: float) -> Vector3:
    """Return the central gravity (m/s2) at ``position`` (m), which must not be the centre."""
    centred = from_centre(position, radius)
    square = dot(centred, centred)
    return -(gravitational_parameter / (square * math.sqrt(square))) * centred


def gravity_difference(displacement: Vector3, up: Vector3, gradient: float) -> Vector3:
    """Return the change of gravity (m/s2) over a small displacement (m), gradient (3 up up' - 1) displacement.

    ``up`` is the unit vector away from the centre, and ``gradient`` (1/s2) is the gravitational parameter divided by
    the cube of the distance from the centre. Source: Battin 1999, section 8.1.
    """
    return gradient * (3.0 * dot(up, displacement) * up - displacement)
