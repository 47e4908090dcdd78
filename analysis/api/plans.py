"""Plans of least propellant from Python, and what no plan can beat; by default of the published cases."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

from ..errors import InputError
from ..planning.bounds import Landing
from ..planning.hover_study import HoverStudy, hover_study
from ..planning.landing_study import LandingStudy, landing_study
from ..planning.vehicle import Margins, Transfer, Vehicle
from ..reports.plan.hover_page import write_hover_page
from ..reports.plan.landing_page import write_landing_page
from .options import FilePath

HOVER_VEHICLE = Vehicle(600.0, 0.0, 300.0, 4707.192, 4707.192 / 15.0, math.radians(1.0))
HOVER_MARGINS = Margins(0.90, 0.10, math.radians(0.70))
HOVER_TRANSFER = Transfer(1600.0, 2300.0, 1.622)
LANDING_VEHICLE = Vehicle(940.13, 440.0, 319.0, 5099.0, 0.0, math.inf)
LANDING = Landing(285e3, 14995.3, 1692.342, 0.0, 4.0, 1.7374e6, 4.9028e12)


@dataclass(frozen=True)
class HoverPlan(HoverStudy):
    """A transfer planned: its ``programme``, and what it is held against."""

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune plan hover-transfer --report`; it takes a plan with ``curves``."""
        if self.durations is None:
            raise InputError(
                "report", str(path), "a page shows curves, which this plan has not", "plan with curves=True"
            )
        write_hover_page(self, Path(path))


@dataclass(frozen=True)
class LandingBound(LandingStudy):
    """The bound of a landing: ``propellant`` (kg) and the ``bound`` path that takes it."""

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune plan landing-bound --report`."""
        write_landing_page(self, Path(path))


def plan_hover_transfer(
    transfer: Transfer = HOVER_TRANSFER,
    vehicle: Vehicle = HOVER_VEHICLE,
    margins: Margins | None = None,
    *,
    duration: float | None = None,
    optimum: bool = False,
    bound: bool = False,
    curves: bool = False,
    intervals: int | None = None,
) -> HoverPlan:
    """Plan a transfer between two hovers: `perilune plan hover-transfer`; see docs/planning.md.

    ``margins`` leave feedback its part of throttle and angular acceleration; ``duration`` (s) is the programme's end,
    by default that of least propellant; ``optimum`` and ``bound`` need the extra `plan`. Raises InputError for a
    vehicle that cannot hover, and PlanError where there is no such plan.
    """
    check_hover(vehicle if margins is None else margins.of(vehicle), transfer)
    study = hover_study(
        vehicle, transfer, margins, duration=duration, optimum=optimum, bound=bound, curves=curves, intervals=intervals
    )
    return HoverPlan(**vars(study))


def plan_landing_bound(
    landing: Landing = LANDING,
    vehicle: Vehicle = LANDING_VEHICLE,
    *,
    direct: bool = False,
    intervals: int | None = None,
) -> LandingBound:
    """Bound the propellant of braking and landing in one: `perilune plan landing-bound`; needs the extra `plan`.

    ``direct`` checks it by a direct method. Raises InputError and PlanError.
    """
    return LandingBound(**vars(landing_study(check_vehicle(vehicle), landing, direct=direct, intervals=intervals)))


def check_vehicle(vehicle: Vehicle) -> Vehicle:
    """Refuse what is no vehicle."""
    if not vehicle.minimum_thrust < vehicle.maximum_thrust:
        problem = f"not below the largest thrust, {vehicle.maximum_thrust:g} N"
        raise InputError("--minimum-thrust", f"{vehicle.minimum_thrust:g}", problem, "give less")
    if not vehicle.dry_mass < vehicle.mass:
        problem = f"not below the mass, {vehicle.mass:g} kg"
        raise InputError("--dry-mass", f"{vehicle.dry_mass:g}", problem, "give less")
    return vehicle


def check_hover(planned: Vehicle, transfer: Transfer) -> None:
    """Refuse a vehicle that cannot hover, or cannot sink, as the plan uses it."""
    check_vehicle(planned)
    full, least = f"{planned.maximum_thrust:g} N", f"{planned.minimum_thrust:g} N"
    if not planned.full > transfer.gravity:
        problem = f"{planned.full:.4g} m/s2 do not carry the mass against {transfer.gravity:g} m/s2"
        raise InputError("--maximum-thrust", full, problem, "give more thrust, or less mass")
    if not planned.least > 0.0:
        raise InputError("--minimum-thrust", least, "the programme's engine never stops", "give the least that it has")
    if not planned.least < transfer.gravity:
        problem = f"{planned.least:.4g} m/s2 carry the mass, against {transfer.gravity:g} m/s2: it does not sink"
        raise InputError("--minimum-thrust", least, problem, "give less thrust, or more mass")
