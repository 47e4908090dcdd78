"""The lander that a plan is made for, and the control margins that a plan leaves it."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ...fmus_src.mathlib.gravity import STANDARD_GRAVITY


@dataclass(frozen=True)
class Vehicle:
    """``mass`` at the start and ``dry_mass`` (kg), ``specific_impulse`` (s), thrust limits (N) and the largest
    ``angular_acceleration`` (rad/s2).
    """

    mass: float
    dry_mass: float
    specific_impulse: float
    maximum_thrust: float
    minimum_thrust: float
    angular_acceleration: float

    @property
    def exhaust_speed(self) -> float:
        """In m/s."""
        return self.specific_impulse * STANDARD_GRAVITY

    @property
    def full(self) -> float:
        """Largest thrust over the mass at the start, m/s2."""
        return self.maximum_thrust / self.mass

    @property
    def least(self) -> float:
        """Least thrust over the mass at the start, m/s2."""
        return self.minimum_thrust / self.mass


@dataclass(frozen=True)
class Margins:
    """What a plan uses of a vehicle: least and largest throttle as shares of its maximum thrust, and the angular
    acceleration (rad/s2); the rest is left to feedback.
    """

    maximum_throttle: float
    minimum_throttle: float
    angular_acceleration: float

    def of(self, vehicle: Vehicle) -> Vehicle:
        """The vehicle as the plan may use it."""
        return replace(
            vehicle,
            maximum_thrust=self.maximum_throttle * vehicle.maximum_thrust,
            minimum_thrust=self.minimum_throttle * vehicle.maximum_thrust,
            angular_acceleration=self.angular_acceleration,
        )


@dataclass(frozen=True)
class Transfer:
    """From hover to hover: ``distance`` along and ``descent`` down (m) in uniform ``gravity`` (m/s2)."""

    distance: float
    descent: float
    gravity: float
