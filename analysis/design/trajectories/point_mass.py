"""What a bound is asked of: a point mass that has any thrust direction in a plane, on a transfer or a landing."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .solvers import Symbol
from .vehicle import Landing, Transfer, Vehicle


@dataclass(frozen=True)
class UniformGravity:
    """``value`` (m/s2) downwards everywhere."""

    value: float

    def at(self, x: Symbol, y: Symbol) -> tuple[Symbol, Symbol]:
        """Gravity (m/s2) along and up at places (m): numbers, arrays or CasADi's symbols."""
        return 0.0 * x, 0.0 * y - self.value

    def gradient(self, position: np.ndarray) -> np.ndarray:
        """Its derivative by position (1/s2) as matrices, one for each row of ``position`` (m)."""
        return np.zeros((position.shape[0], 2, 2))


@dataclass(frozen=True)
class CentralGravity:
    """Of a Moon whose centre lies ``radius`` (m) below the origin; ``parameter`` is its gravitational one (m3/s2)."""

    parameter: float
    radius: float

    def at(self, x: Symbol, y: Symbol) -> tuple[Symbol, Symbol]:
        """Gravity (m/s2) along and up at places (m): numbers, arrays or CasADi's symbols."""
        up = y + self.radius
        pull = self.parameter / (x**2 + up**2) ** 1.5
        return -pull * x, -pull * up

    def gradient(self, position: np.ndarray) -> np.ndarray:
        """Its derivative by position (1/s2) as matrices, one for each row of ``position`` (m): mu/r^3 (3 u u' - 1)."""
        arm = np.add(position, (0.0, self.radius))
        distance = np.linalg.norm(arm, axis=1)[:, np.newaxis, np.newaxis]
        up = arm[:, :, np.newaxis] / distance
        return self.parameter / distance**3 * (3.0 * up * up.transpose(0, 2, 1) - np.eye(2))


@dataclass(frozen=True)
class PointMassProblem:
    """From one state to another on least propellant, attitude free. Positions (m) and velocities (m/s) along and up.

    ``exhaust_speed`` in m/s; ``least`` and ``most`` are the engine's thrust limits over the initial mass, m/s2.
    ``length`` (m) and ``speed`` (m/s) are the scales in which it is solved.
    """

    start_position: tuple[float, float]
    start_velocity: tuple[float, float]
    end_position: tuple[float, float]
    end_velocity: tuple[float, float]
    gravity: UniformGravity | CentralGravity
    exhaust_speed: float
    least: float
    most: float
    length: float
    speed: float

    @property
    def natural_time(self) -> float:
        """A time (s) of the order of the one that costs least: at mean speed, or at full thrust from rest."""
        way = float(np.hypot(*np.subtract(self.end_position, self.start_position)))
        speeds = float(np.hypot(*self.start_velocity) + np.hypot(*self.end_velocity))
        return min(2.0 * way / speeds if speeds > 0.0 else np.inf, 2.0 * (2.0 * way / self.most) ** 0.5)


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
