"""Landing sites on a sphere, and positions above them. Kernel functions.

Frame: landing site, z up; the Moon's centre is ``radius`` (m) below the origin.
"""

import math

from ..vectors import Vector2, Vector3, vector
from .gravity import vertical_at


def above_site(site: Vector3, altitude: float, radius: float) -> Vector3:
    """Return the position (m) at an altitude (m) on the local vertical of ``site``."""
    up = vertical_at(site, radius)
    high = (radius + altitude) * up
    return vector(high.x, high.y, high.z - radius)


def site_below(position: Vector3, radius: float) -> Vector3:
    """Return the point (m) of the sphere on the vertical of ``position`` (m)."""
    return above_site(position, 0.0, radius)


def redesignate(site: Vector3, move: Vector2, radius: float) -> Vector3:
    """Return the site moved by x and y (m) and projected on the sphere along its vertical."""
    return site_below(vector(site.x + move.x, site.y + move.y, site.z), radius)


def within_reach(move: Vector2, reach: float) -> tuple[bool, Vector2]:
    """Return (True, move) if the move is at most ``reach`` (m) long, otherwise (False, move shortened to it)."""
    length = math.sqrt(move.x * move.x + move.y * move.y)
    if length <= reach:
        return True, move
    return False, reach / length * move
