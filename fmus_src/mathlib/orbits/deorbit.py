"""Deorbit from a circular orbit towards a landing site: position on the orbit and burn time. Kernel functions.

Frame: landing site, z up, not rotating; the Moon's centre is ``radius`` (m) below the origin.
"""

import math

from ...kernel.functions import atan2, cos, sin
from ..attitude.rotation import TurningDirection
from ..lunar.gravity import from_centre, vertical_at
from ..vectors import Vector3, across, dot, norm, vector


def central_angle(position: Vector3, radius: float) -> float:
    """Return the angle (rad, 0 to 2 pi) at the Moon's centre from the site's vertical towards +x, in the xz plane."""
    angle = atan2(position.x, position.z + radius)
    if angle < 0.0:
        angle = angle + 2.0 * math.pi
    return angle


def ground_range(position: Vector3, radius: float) -> float:
    """Return the arc length (m) on the sphere of ``radius`` (m) between the point below ``position`` and the origin."""
    centred = from_centre(position, radius)
    return radius * atan2(math.sqrt(centred.x * centred.x + centred.y * centred.y), centred.z)


def against_horizontal(position: Vector3, velocity: Vector3, radius: float) -> TurningDirection:
    """Return the direction opposite to the horizontal velocity, with its rate due to the rotation of the vertical.

    Both are 0 without horizontal velocity.
    """
    up = vertical_at(position, radius)
    horizontal = across(velocity, up)
    speed = norm(horizontal)
    distance = norm(from_centre(position, radius))
    if not speed > 0.0 or not distance > 0.0:
        return TurningDirection(direction=vector(0.0, 0.0, 0.0), rate=vector(0.0, 0.0, 0.0))
    return TurningDirection(direction=-horizontal / speed, rate=speed / distance * up)


def apocentre_speed(apocentre: float, pericentre: float, mu: float) -> float:
    """Return the speed (m/s) at the apocentre of an ellipse, from its apocentre and pericentre distances (m).

    Source: vis-viva equation, for example Battin 1999, section 3.4.
    """
    return math.sqrt(2.0 * mu * pericentre / (apocentre * (apocentre + pericentre)))


def deorbit_burn(
    position: Vector3, velocity: Vector3, pericentre: float, radius: float, mu: float, acceleration: float
) -> float:
    """Return the burn time (s) with ``acceleration`` (m/s2) that makes ``position`` the apocentre of an ellipse.

    ``pericentre`` is the distance (m) of the ellipse's pericentre from the Moon's centre. The time is negative if the
    horizontal speed is already too small; the vertical speed is ignored. ``position`` must not be the centre.
    """
    up = vertical_at(position, radius)
    sinking = dot(velocity, up)
    speed = norm(velocity - sinking * up)
    distance = norm(from_centre(position, radius))
    return (speed - apocentre_speed(distance, pericentre, mu)) / acceleration


def lowest_altitude(position: Vector3, velocity: Vector3, angle: float, radius: float, mu: float) -> float:
    """Return the least altitude (m) in free flight over the next ``angle`` (rad) about the Moon's centre.

    With the radial speed w and the angular momentum h, the distance r obeys 1/r(a) = A + B cos a - C sin a, where A =
    mu/h^2, B = 1/r(0) - A, C = w/h. The distance is least at the pericentre if it lies within the angle, otherwise at
    one of the two ends. Without horizontal velocity the vehicle falls to the centre. ``position`` must not be the
    centre. Source: conic section in polar coordinates, for example Battin 1999, section 3.3.
    """
    centred = from_centre(position, radius)
    distance = norm(centred)
    up = centred / distance
    momentum = norm(across(velocity, up)) * distance
    if not momentum > 0.0:
        return -radius
    a = mu / (momentum * momentum)
    b = 1.0 / distance - a
    c = dot(velocity, up) / momentum
    inverse = 1.0 / distance
    end = a + b * cos(angle) - c * sin(angle)
    if end > inverse:
        inverse = end
    pericentre = atan2(-c, b)
    if pericentre < 0.0:
        pericentre = pericentre + 2.0 * math.pi
    if pericentre < angle:
        inverse = a + math.sqrt(b * b + c * c)
    return 1.0 / inverse - radius
