"""Plans of least propellant from Python, and what no plan can beat; by default of the published cases."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ..common.errors import InputError
from ..design.trajectories.bounds import LANDING, Landing
from ..design.trajectories.hover_study import HoverStudy, hover_study
from ..design.trajectories.landing_study import LandingStudy, landing_study
from ..design.trajectories.vehicle import (
    HOVER_TRANSFER,
    HOVER_VEHICLE,
    LANDING_VEHICLE,
    Margins,
    Transfer,
    Vehicle,
    check_hover,
    check_vehicle,
)
from ..reports.plan.pages import write_hover_page, write_landing_page
from .options import FilePath


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
