"""The two problems whose bounds are asked for: a hover transfer, and a single-burn braking and landing."""

from __future__ import annotations

import math

from .point_mass import CentralGravity, PointMassProblem, UniformGravity
from .vehicle import Landing, Transfer, Vehicle


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
