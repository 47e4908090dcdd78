"""Planned hover transfer: its programme, and the requested comparisons with it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self, TypeVar

import numpy as np

from ....common.errors import InputError
from ....common.progress import progress_bar
from ....fmus_src.mathlib.hover.solution import PlanKind
from ..trajectories.least_time import BOUND_INTERVALS, least_propellant
from ..trajectories.path import PlanError, PlannedPath
from ..trajectories.point_mass import transfer_problem
from ..trajectories.vehicle import Margins, Transfer, Vehicle
from .adjoint import AdjointSolution, integrate_adjoint
from .finite_switches import FiniteProfile, find_finite_switches
from .free_fall import FreeFallProgramme, find_free_fall
from .programme import Programme, find_programme, sweep_distance, sweep_duration
from .true_optimum import find_true_optimum

OPTIMUM_INTERVALS = 320
Plan = TypeVar("Plan")
VERTICAL = PlanKind.meanings[PlanKind.VERTICAL]


@dataclass(frozen=True)
class PropellantCurve:
    """Propellant fraction as a function of one quantity, nan where there is no programme."""

    at: np.ndarray
    propellant: np.ndarray


@dataclass(frozen=True)
class ProgrammeComparison:
    """Least propellant fractions of both programmes for one ``distance`` (m); nan if there is no programme."""

    distance: float
    programme: float
    free_fall: float


@dataclass(frozen=True)
class HoverStudy:
    """Planned hover transfer.

    ``vehicle`` is the lander without margins, which the bound assumes; programme and optimum respect the ``margins``,
    if any. ``vertical`` is the programme straight down from the same height. ``durations`` are the programmes for other
    t7 (s), ``distances`` the best programmes for other distances (m). ``adjoint`` is integrated along the optimum;
    ``finite`` is the profile with a finite number of switches; ``free_fall`` is the programme that turns to the
    vertical in free fall, and ``comparisons`` compares it with the simplified programme for several distances.
    """

    vehicle: Vehicle
    margins: Margins | None
    transfer: Transfer
    is_duration_set: bool
    programme: Programme
    vertical: Programme
    optimum: PlannedPath | None
    bound: PlannedPath | None
    durations: PropellantCurve | None
    distances: PropellantCurve | None
    adjoint: AdjointSolution | None = None
    finite: FiniteProfile | None = None
    free_fall: FreeFallProgramme | None = None
    comparisons: tuple[ProgrammeComparison, ...] = ()

    def with_curves(self) -> Self:
        """Return the study with its curves. Raises `PlanError`."""
        if self.durations is not None and self.distances is not None:
            return self
        programme = self.programme
        if self.is_duration_set:
            programme = find_programme(programme.vehicle, self.transfer) or programme
        return replace(
            self,
            durations=PropellantCurve(*sweep_duration(programme)),
            distances=PropellantCurve(*sweep_distance(programme)),
        )

    @property
    def path(self) -> PlannedPath:
        return self.programme.path(self.vehicle.maximum_thrust)


def hover_study(
    vehicle: Vehicle,
    transfer: Transfer,
    margins: Margins | None = None,
    *,
    duration: float | None = None,
    optimum: bool = False,
    bound: bool = False,
    curves: bool = False,
    adjoint: bool = False,
    finite_switches: bool = False,
    free_fall: bool = False,
    turn_begun: float = 0.0,
    distances: Sequence[float] = (),
    intervals: int | None = None,
) -> HoverStudy:
    """Plan a transfer; ``duration`` (s) is t7 of the programme, by default the one of least propellant.

    ``optimum``, ``bound``, ``curves``, ``adjoint``, ``finite_switches`` and ``free_fall`` request further results.
    Optimum and bound are computed on a number of ``intervals`` with solvers that must be installed; ``adjoint``
    requires the optimum. ``turn_begun`` (a fraction of the turn) and ``distances`` (m) apply to ``free_fall``. Raises
    `PlanError`, and InputError for a missing solver.
    """
    planned = vehicle if margins is None else margins.of(vehicle)
    programme = find_programme(planned, transfer, duration)
    vertical = find_programme(planned, replace(transfer, distance=0.0))
    if programme is None or vertical is None:
        when = "" if duration is None else f" that takes {duration:g} s"
        raise PlanError(
            f"no simplified programme{when} covers {transfer.distance:g} m in {transfer.descent:g} m of descent: "
            "there is no room for its turns; give a shorter distance or another duration"
        )
    of_turns = {"adjoint": adjoint, "finite_switches": finite_switches, "free_fall": free_fall}
    for name in [name for name, is_requested in of_turns.items() if is_requested and programme.kind == VERTICAL]:
        problem = f"a vertical descent, over {transfer.distance:g} m, has no turn"
        raise InputError(f"`{name}`", "", problem, "give `distance` 1 m or more")
    others = optimum or curves or finite_switches or free_fall
    best = programme if duration is None or not others else find_programme(planned, transfer)
    assert best is not None  # a programme of prescribed duration is found from it
    maximum = vehicle.maximum_thrust
    with progress_bar(total=optimum + bound + 2 * curves, unit="part") as progress:
        optimal_path = find_true_optimum(best, intervals or OPTIMUM_INTERVALS, maximum) if optimum else None
        progress.update(optimum)
        bounded = _bound(vehicle, transfer, intervals or BOUND_INTERVALS) if bound else None
        progress.update(bound)
        durations = PropellantCurve(*sweep_duration(best)) if curves else None
        progress.update(curves)
        farther = PropellantCurve(*sweep_distance(best)) if curves else None
        progress.update(curves)
    return HoverStudy(
        vehicle=vehicle,
        margins=margins,
        transfer=transfer,
        is_duration_set=duration is not None,
        programme=programme,
        vertical=vertical,
        optimum=optimal_path,
        bound=bounded,
        durations=durations,
        distances=farther,
        adjoint=integrate_adjoint(optimal_path, planned, transfer, maximum) if optimal_path and adjoint else None,
        finite=_require(find_finite_switches(best), "profile with a finite number of switches", transfer)
        if finite_switches
        else None,
        free_fall=_require(find_free_fall(best, turn_begun), "programme with a turn in free fall", transfer)
        if free_fall
        else None,
        comparisons=tuple(_compare(planned, replace(transfer, distance=each), turn_begun) for each in distances),
    )


def _require(plan: Plan | None, what: str, transfer: Transfer) -> Plan:
    if plan is None:
        way = f"{transfer.distance:g} m in {transfer.descent:g} m of descent"
        raise PlanError(f"no {what} covers {way}; give another distance")
    return plan


def _compare(planned: Vehicle, transfer: Transfer, turn_begun: float) -> ProgrammeComparison:
    """Return the comparison of both programmes over one distance."""
    programme = find_programme(planned, transfer)
    free_fall = None if programme is None else find_free_fall(programme, turn_begun)
    fractions = (math.nan if plan is None else plan.propellant_fraction for plan in (programme, free_fall))
    return ProgrammeComparison(transfer.distance, *fractions)


def _bound(vehicle: Vehicle, transfer: Transfer, intervals: int) -> PlannedPath:
    problem = transfer_problem(vehicle, transfer)
    return least_propellant(problem, intervals).make_path(problem)
