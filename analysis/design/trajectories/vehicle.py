"""Lander of a plan, and the share of its capability that the plan may use."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, replace

from ....common.errors import InputError
from ....fmus_src.mathlib.lunar.gravity import STANDARD_GRAVITY


@dataclass(frozen=True)
class Vehicle:
    """Lander: initial ``mass`` and ``dry_mass`` (kg), ``specific_impulse`` (s), thrust limits (N).

    ``angular_acceleration`` (rad/s2) is the largest angular acceleration.
    """

    mass: float
    dry_mass: float
    specific_impulse: float
    maximum_thrust: float
    minimum_thrust: float
    angular_acceleration: float

    @property
    def exhaust_speed(self) -> float:
        """Exhaust speed, m/s."""
        return self.specific_impulse * STANDARD_GRAVITY

    @property
    def full(self) -> float:
        """Largest thrust over the initial mass, m/s2."""
        return self.maximum_thrust / self.mass

    @property
    def least(self) -> float:
        """Least thrust over the initial mass, m/s2."""
        return self.minimum_thrust / self.mass


@dataclass(frozen=True)
class Margins:
    """Shares of a vehicle's capability that a plan uses; the rest is left to feedback.

    They are the least and largest throttle, as fractions of maximum thrust, and the largest angular acceleration
    (rad/s2).
    """

    maximum_throttle: float
    minimum_throttle: float
    angular_acceleration: float

    def of(self, vehicle: Vehicle) -> Vehicle:
        """Return the vehicle with the capability that the plan may use."""
        return replace(
            vehicle,
            maximum_thrust=self.maximum_throttle * vehicle.maximum_thrust,
            minimum_thrust=self.minimum_throttle * vehicle.maximum_thrust,
            angular_acceleration=self.angular_acceleration,
        )


def limits_document(limits: Vehicle | Margins) -> dict[str, float]:
    """Return a vehicle or margins as JSON, in kg, s, N and deg/s2; an unlimited angular acceleration is omitted."""
    values = asdict(limits)
    turn = math.degrees(values.pop("angular_acceleration"))
    return values | ({"angular_acceleration_deg_s2": turn} if math.isfinite(turn) else {})


@dataclass(frozen=True)
class Transfer:
    """Transfer from hover to hover: ``distance`` along and ``descent`` down (m) in uniform ``gravity`` (m/s2)."""

    distance: float
    descent: float
    gravity: float


# The published cases: Huang (2017), and the lander of the whole landing.
HOVER_VEHICLE = Vehicle(600.0, 0.0, 300.0, 4707.192, 4707.192 / 15.0, math.radians(1.0))
HOVER_MARGINS = Margins(0.90, 0.10, math.radians(0.70))
HOVER_TRANSFER = Transfer(1600.0, 2300.0, 1.622)
LANDING_VEHICLE = Vehicle(940.13, 440.0, 319.0, 5099.0, 0.0, math.inf)


def check_vehicle(vehicle: Vehicle) -> Vehicle:
    if not vehicle.minimum_thrust < vehicle.maximum_thrust:
        problem = f"not below the largest thrust, {vehicle.maximum_thrust:g} N"
        raise InputError("`minimum_thrust`", f"{vehicle.minimum_thrust:g}", problem, "give a smaller minimum thrust")
    if not vehicle.dry_mass < vehicle.mass:
        problem = f"not below the mass, {vehicle.mass:g} kg"
        raise InputError("`dry_mass`", f"{vehicle.dry_mass:g}", problem, "give a smaller dry mass")
    return vehicle


def check_hover(planned: Vehicle, transfer: Transfer) -> None:
    """Reject a vehicle that cannot hover, or cannot descend, with the capability that the plan uses."""
    check_vehicle(planned)
    full, minimum = f"{planned.maximum_thrust:g} N", f"{planned.minimum_thrust:g} N"
    if not planned.full > transfer.gravity:
        problem = (
            f"the acceleration at full thrust, {planned.full:.4g} m/s2, does not exceed gravity, "
            f"{transfer.gravity:g} m/s2"
        )
        raise InputError("`maximum_thrust`", full, problem, "give more thrust, or less mass")
    if not planned.least > 0.0:
        raise InputError(
            "`minimum_thrust`", minimum, "the programme never shuts the engine down", "give the engine's minimum thrust"
        )
    if not planned.least < transfer.gravity:
        problem = (
            f"the acceleration at this thrust, {planned.least:.4g} m/s2, exceeds gravity, "
            f"{transfer.gravity:g} m/s2: the vehicle cannot descend"
        )
        raise InputError("`minimum_thrust`", minimum, problem, "give less thrust, or more mass")


@dataclass(frozen=True)
class Landing:
    """Single-burn braking and landing: from orbit to rest over the site, around a Moon that does not rotate.

    The start is in the plane of flight at a ``range`` (m) from the site along the ground and an ``altitude`` (m), with
    a ``speed`` (m/s) towards the site at an angle ``climb`` (rad) above the local horizontal. The end is
    ``target_altitude`` (m) above the site. ``radius`` (m) and ``gravitational_parameter`` (m3/s2) are the Moon's.
    """

    range: float
    altitude: float
    speed: float
    climb: float
    target_altitude: float
    radius: float
    gravitational_parameter: float


LANDING = Landing(285e3, 14995.3, 1692.342, 0.0, 4.0, 1.7374e6, 4.9028e12)  # the published case
