"""Sunlight in the umbra and penumbra of a spherical planet. Kernel functions."""

import math

from ...kernel.functions import asin, atan2
from ..vectors import Vector3, cross, dot, norm
from .ephemerides import SUN_RADIUS


def illumination(position: Vector3, sun: Vector3, radius: float) -> float:
    """Return the visible fraction of the Sun's disk, 0 to 1, at a position (m) near a sphere with a radius (m).

    The positions of the point and of the Sun are relative to the sphere's centre, in the same frame. Refraction and
    limb darkening are neglected. At or below the surface of the sphere there is full light if the Sun is above the
    horizon. Source: Montenbruck and Gill 2000, section 3.4.2.
    """
    away = sun - position
    a = disk_angle(SUN_RADIUS, norm(away))
    b = disk_angle(radius, norm(position))
    c = atan2(norm(cross(position, away)), -dot(position, away))  # between the centres of both disks
    if c >= a + b:
        return 1.0
    if c <= b - a:
        return 0.0
    if c <= a - b:
        return 1.0 - b * b / (a * a)
    x = ((c - b) * (c + b) + a * a) / (2.0 * c)
    square = (a - x) * (a + x)
    y = 0.0
    if square > 0.0:
        y = math.sqrt(square)
    covered = a * a * atan2(y, x) + b * b * atan2(y, c - x) - c * y
    return 1.0 - covered / (math.pi * a * a)


def disk_angle(radius: float, distance: float) -> float:
    """Return the apparent angular radius (rad) of a sphere from a distance (m) to its centre; pi/2 inside it."""
    if radius >= distance:
        return 0.5 * math.pi
    return asin(radius / distance)
