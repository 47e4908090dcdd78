"""The two problems whose bounds are asked for: a hover transfer, and braking and landing in one."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .point_mass import CentralGravity, PointMassProblem, UniformGravity
from .vehicle import Transfer, Vehicle


def transfer_problem(vehicle: Vehicle, transfer: Transfer) -> PointMassProblem:
    """A hover transfer with the attitude free, at its ends, too."""
    return PointMassProblem(
        start_position=(0.0, 0.0),
        start_velocity=(0.0, 0.0),
        end_position=(transfer.distance, -transfer.descent),
        end_velocity=(0.0, 0.0),
        gravity=UniformGravity(transfer.gravity),
        exhaust_speed=vehicle.exhaust_speed,
        least=vehicle.least,
        most=vehicle.full,
        length=max(transfer.distance, abs(transfer.descent)) / 2.0,
        speed=0.4 * math.sqrt(vehicle.full * max(transfer.distance, abs(transfer.descent))),
    )


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


LANDING = Landing(285e3, 14995.3, 1692.342, 0.0, 4.0, 1.7374e6, 4.9028e12)


def landing_problem(vehicle: Vehicle, landing: Landing) -> PointMassProblem:
    """Braking and landing in the site's frame: along, from the site to where the flight comes from, and up."""
    angle = landing.range / landing.radius
    distance = landing.radius + landing.altitude
    course = angle + landing.climb
    return PointMassProblem(
        start_position=(distance * math.sin(angle), distance * math.cos(angle) - landing.radius),
        start_velocity=(-landing.speed * math.cos(course), landing.speed * math.sin(course)),
        end_position=(0.0, landing.target_altitude),
        end_velocity=(0.0, 0.0),
        gravity=CentralGravity(landing.gravitational_parameter, landing.radius),
        exhaust_speed=vehicle.exhaust_speed,
        least=vehicle.least,
        most=vehicle.full,
        length=1e5,
        speed=1e3,
    )
