"""Problem of a bound: a point mass with any thrust direction, in a plane or in space, on a transfer or a landing.

The last of the two or three axes points up.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .solvers import Symbol
from .vehicle import Landing, Transfer, Vehicle


@dataclass(frozen=True)
class UniformGravity:
    """Uniform gravity, ``value`` (m/s2) downwards everywhere."""

    value: float

    def at(self, *position: Symbol) -> tuple[Symbol, ...]:
        """Return gravity (m/s2) by axis at a position (m) by axis: numbers, arrays or CasADi's symbols."""
        *level, up = position
        return (*(0.0 * x for x in level), 0.0 * up - self.value)

    def gradient(self, position: np.ndarray) -> np.ndarray:
        """Return the gradient of gravity (1/s2), a matrix for each row of ``position`` (m)."""
        return np.zeros((*position.shape, position.shape[1]))


@dataclass(frozen=True)
class CentralGravity:
    """Gravity of a Moon whose centre is ``radius`` (m) below the origin.

    ``parameter`` (m3/s2) is its gravitational parameter.
    """

    parameter: float
    radius: float

    def at(self, *position: Symbol) -> tuple[Symbol, ...]:
        """Return gravity (m/s2) by axis at a position (m) by axis: numbers, arrays or CasADi's symbols."""
        *level, height = position
        up = height + self.radius
        pull = self.parameter / sum((x**2 for x in (*level[1:], up)), start=level[0] ** 2) ** 1.5
        return (*(-pull * x for x in level), -pull * up)

    def gradient(self, position: np.ndarray) -> np.ndarray:
        """Return the gradient of gravity (1/s2), mu/r^3 (3 u u' - I), for each row of ``position`` (m)."""
        arm = position.copy()
        arm[:, -1] += self.radius
        distance = np.linalg.norm(arm, axis=1)[:, np.newaxis, np.newaxis]
        up = arm[:, :, np.newaxis] / distance
        return self.parameter / distance**3 * (3.0 * up * up.transpose(0, 2, 1) - np.eye(position.shape[1]))


@dataclass(frozen=True)
class PointMassProblem:
    """Problem to reach one state from another with least propellant and free attitude.

    Positions (m) and velocities (m/s) are along and up, or along three axes of which the last is up. ``exhaust_speed``
    is in m/s; ``least`` and ``most`` are the engine's thrust limits over the initial mass, m/s2. ``length`` (m) and
    ``speed`` (m/s) are the scales of the solution. ``largest_tilt`` (rad) limits the angle between thrust and up;
    ``glide_slope`` (rad) is the least elevation of the path, measured from an apex ``glide_offset`` (m) below the end.
    Either limit is None if it does not apply.
    """

    start_position: tuple[float, ...]
    start_velocity: tuple[float, ...]
    end_position: tuple[float, ...]
    end_velocity: tuple[float, ...]
    gravity: UniformGravity | CentralGravity
    exhaust_speed: float
    least: float
    most: float
    length: float
    speed: float
    largest_tilt: float | None = None
    glide_slope: float | None = None
    glide_offset: float = 0.0

    @property
    def natural_time(self) -> float:
        """Time (s) of the order of the optimal duration: at mean speed, or at full thrust from rest."""
        way = math.dist(self.end_position, self.start_position)
        speeds = math.hypot(*self.start_velocity) + math.hypot(*self.end_velocity)
        return min(2.0 * way / speeds if speeds > 0.0 else np.inf, 2.0 * (2.0 * way / self.most) ** 0.5)


def transfer_problem(vehicle: Vehicle, transfer: Transfer) -> PointMassProblem:
    """Return the problem of a hover transfer with free attitude, including at its ends."""
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
    """Return the problem of braking and landing in the site's frame: axes from site to start, and up."""
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
