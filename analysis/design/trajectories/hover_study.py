"""A hover transfer planned: its programme, and what it is held against, as far as that is asked for."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, replace
from typing import Self

import numpy as np

from ...common.progress import progress_bar
from .convex_form import least_propellant
from .path import PlanError, PlannedPath
from .point_mass import transfer_problem
from .programme import Programme, find_programme, over_distance, over_duration
from .true_optimum import find_true_optimum
from .vehicle import Margins, Transfer, Vehicle

OPTIMUM_INTERVALS = 320
BOUND_INTERVALS = 240
NAMES = ("t2_s", "t5_s", "w_s", "tp_s", "t7_s")


@dataclass(frozen=True)
class Curve:
    """Propellant fraction over one quantity, nan where there is no programme."""

    at: np.ndarray
    propellant: np.ndarray


@dataclass(frozen=True)
class HoverStudy:
    """``vehicle`` is the lander itself, which the bound is of; programme and optimum keep the ``margins``, if any.

    ``vertical`` is the programme straight down from the same height. ``durations``: the programmes of other t7 (s);
    ``distances``: the best programmes to other places (m).
    """

    vehicle: Vehicle
    margins: Margins | None
    transfer: Transfer
    given: bool
    programme: Programme
    vertical: Programme
    optimum: PlannedPath | None
    bound: PlannedPath | None
    durations: Curve | None
    distances: Curve | None

    def with_curves(self) -> Self:
        """The same with its curves. Raises `PlanError`."""
        if self.durations is not None and self.distances is not None:
            return self
        programme = self.programme
        if self.given:
            programme = find_programme(programme.vehicle, self.transfer) or programme
        return replace(self, durations=Curve(*over_duration(programme)), distances=Curve(*over_distance(programme)))

    @property
    def path(self) -> PlannedPath:
        return self.programme.path(self.vehicle.maximum_thrust)

    def document(self) -> dict[str, object]:
        """All of it for other programs; times in s, angles in deg, propellant over the initial mass and in kg."""
        programme = self.programme
        minimum, largest = (math.degrees(angle) for angle in programme.extremes)
        return {
            "vehicle": vehicle_document(self.vehicle),
            "margins": None if self.margins is None else _degrees(asdict(self.margins)),
            "transfer": asdict(self.transfer),
            "programme": {
                "kind": programme.kind,
                "duration_given": self.given,
                **dict(zip(NAMES, programme.times, strict=True)),
                "k": programme.threshold,
                **self._propellant(programme.propellant_fraction),
                "least_pitch_deg": minimum,
                "largest_pitch_deg": largest,
                "largest_pitch_rate_deg_s": math.degrees(programme.turn_rate),
                "full_thrust_s": [list(burn) for burn in programme.burns],
                "over_vertical": programme.propellant_fraction / self.vertical.propellant_fraction,
            },
            "vertical": {"t7_s": self.vertical.duration, **self._propellant(self.vertical.propellant_fraction)},
            "true_optimum": self._path(self.optimum),
            "bound": self._path(self.bound),
            "over_duration": _curve(self.durations, "t7_s"),
            "over_distance": _curve(self.distances, "distance_m"),
        }

    def _propellant(self, fraction: float) -> dict[str, float]:
        return {"propellant_fraction": fraction, "propellant_kg": fraction * self.vehicle.mass}

    def _path(self, path: PlannedPath | None) -> dict[str, object] | None:
        if path is None:
            return None
        return {
            "duration_s": path.duration,
            **self._propellant(path.propellant_fraction),
            "intervals": path.throttle.size,
            "full_thrust_s": [list(burn) for burn in path.burns()],
        }


def hover_study(
    vehicle: Vehicle,
    transfer: Transfer,
    margins: Margins | None = None,
    *,
    duration: float | None = None,
    optimum: bool = False,
    bound: bool = False,
    curves: bool = False,
    intervals: int | None = None,
) -> HoverStudy:
    """Plan a transfer; ``duration`` (s) is the programme's t7, the best where it is None.

    ``optimum``, ``bound`` and ``curves`` ask for more than the programme, the first two on so many ``intervals``, of
    solvers that need to be installed. Raises `PlanError`, and InputError for a missing solver.
    """
    planned = vehicle if margins is None else margins.of(vehicle)
    programme = find_programme(planned, transfer, duration)
    vertical = find_programme(planned, replace(transfer, distance=0.0))
    if programme is None or vertical is None:
        when = "" if duration is None else f" that takes {duration:g} s"
        raise PlanError(
            f"no simplified programme{when} goes {transfer.distance:g} m along in {transfer.descent:g} m of descent: "
            "its turns find no room; go less far or take another time"
        )
    best = programme if duration is None or not (optimum or curves) else find_programme(planned, transfer)
    assert best is not None  # a programme of a given duration is found from it
    maximum = vehicle.maximum_thrust
    with progress_bar(total=optimum + bound + 2 * curves, unit="part") as progress:
        optimal_path = find_true_optimum(best, intervals or OPTIMUM_INTERVALS, maximum) if optimum else None
        progress.update(optimum)
        bounded = _bound(vehicle, transfer, intervals or BOUND_INTERVALS) if bound else None
        progress.update(bound)
        durations = Curve(*over_duration(best)) if curves else None
        progress.update(curves)
        distances = Curve(*over_distance(best)) if curves else None
        progress.update(curves)
    return HoverStudy(
        vehicle=vehicle,
        margins=margins,
        transfer=transfer,
        given=duration is not None,
        programme=programme,
        vertical=vertical,
        optimum=optimal_path,
        bound=bounded,
        durations=durations,
        distances=distances,
    )


def vehicle_document(vehicle: Vehicle) -> dict[str, float]:
    """A vehicle for other programs: kg, s, N, deg/s2."""
    return _degrees(asdict(vehicle))


def _bound(vehicle: Vehicle, transfer: Transfer, intervals: int) -> PlannedPath:
    problem = transfer_problem(vehicle, transfer)
    return least_propellant(problem, intervals).make_path(problem)


def _degrees(values: dict[str, float]) -> dict[str, float]:
    """The angular acceleration in deg/s2, under a name that says so; none for a vehicle that has no such limit."""
    turn = math.degrees(values.pop("angular_acceleration"))
    return values | ({"angular_acceleration_deg_s2": turn} if math.isfinite(turn) else {})


def _curve(curve: Curve | None, name: str) -> dict[str, list[float] | list[float | None]] | None:
    if curve is None:
        return None
    values = [None if math.isnan(value) else float(value) for value in curve.propellant]
    return {name: [float(value) for value in curve.at], "propellant_fraction": values}
