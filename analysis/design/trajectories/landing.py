"""The landing that a bound is made for: braking and landing in one."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Landing:
    """Braking and landing in one: from orbit to rest over the site, around a Moon that does not turn.

    The start, in the plane of flight: ``range`` (m) from the site along the ground, ``altitude`` (m), ``speed`` (m/s)
    at an angle ``climb`` (rad) above the local horizontal, towards the site. The end: ``target_altitude`` (m) above it.
    ``radius`` (m) and ``gravitational_parameter`` (m3/s2) are the Moon's.
    """

    range: float
    altitude: float
    speed: float
    climb: float
    target_altitude: float
    radius: float
    gravitational_parameter: float


LANDING = Landing(285e3, 14995.3, 1692.342, 0.0, 4.0, 1.7374e6, 4.9028e12)  # the published case
