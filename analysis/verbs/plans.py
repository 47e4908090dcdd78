"""Trajectories of least propellant: `perilune.plan_hover_transfer`, `perilune.plan_landing_bound`, their commands."""

from __future__ import annotations

import math
import os
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Unpack

from ...common.errors import InputError, UnwrittenError
from ..design.trajectories.declared_bound import ANNOTATION, Inputs, landing_of, pieces_of, read_inputs
from ..design.trajectories.landing_study import LandingStudy, landing_study
from ..design.trajectories.stored_bound import write_bound
from ..design.trajectories.vehicle import (
    HOVER_MARGINS,
    HOVER_TRANSFER,
    HOVER_VEHICLE,
    LANDING,
    LANDING_VEHICLE,
    Landing,
    Margins,
    Transfer,
    Vehicle,
    check_hover,
    check_vehicle,
)
from ..design.transfers.hover_study import HoverStudy, hover_study
from ..documents.model import Document
from ..documents.of.design.landing_bound import landing_bound_document
from ..documents.of.design.transfer import transfer_document
from ..options.option import FilePath, options_of
from ..options.verb import verb
from ..runtime.system.options import SystemOptions, system_options
from ..runtime.system.prepared import PreparedSystem, prepare_system
from .common.documented import Documented
from .common.stores import check_stored_system
from .options.design import BOUND, TRANSFER, BoundOptions, TransferOptions, VehicleOptions

OF_VEHICLE = frozenset(options_of(VehicleOptions))
NEEDS = {
    "adjoint": "optimum",
    "distances": "free_fall",
    "turn_begun": "free_fall",
}  # options of a transfer that extend another one


def format_numbers(options: Mapping[str, Any], names: Collection[str]) -> dict[str, float]:
    """Return the options among ``names`` that are set, by name."""
    return {name: options[name] for name in names if options[name] is not None}


def propellant_problems(vehicle: Vehicle, propellant: float, what: str) -> list[str]:
    """Return a line if ``what`` uses more propellant (kg) than is on board."""
    carried = vehicle.mass - vehicle.dry_mass
    if propellant <= carried:
        return []
    return [f"{what} takes {propellant:.2f} kg of propellant; {carried:g} kg are on board"]


@dataclass(frozen=True)
class HoverPlan(Documented, HoverStudy):
    """A planned transfer: its ``programme``, compared with the optimum and the bound, if requested."""

    def document(self) -> Document:
        """Return a document with the plans, their times, the conditions of the optimum, and figures."""
        return transfer_document(self)

    def problems(self) -> list[str]:
        """Return a line if the programme uses more propellant than is on board."""
        return propellant_problems(
            self.vehicle, self.programme.propellant_fraction * self.vehicle.mass, "the programme"
        )


@verb(TRANSFER)
def plan_hover_transfer(
    transfer: Transfer = HOVER_TRANSFER, vehicle: Vehicle = HOVER_VEHICLE, **options: Unpack[TransferOptions]
) -> HoverPlan:
    """Plan a transfer between two hovers: `perilune design transfer`; see docs/planning.md.

    ``transfer`` and ``vehicle`` are by default the published case; keywords replace single numbers of them. ``margins``
    (`Margins`, or True for the published ones) reserve throttle and angular acceleration for feedback;
    ``maximum_throttle``, ``minimum_throttle`` and ``angular_acceleration`` (deg/s2) replace single margins. ``optimum``
    and ``bound`` need the extra `plan`. ``adjoint`` integrates the adjoint system along the optimum;
    ``finite_switches`` computes the best profile with a finite number of switches; ``free_fall`` computes the programme
    that becomes vertical in free fall, after the fraction ``turn_begun`` of its turn, also for ``distances`` (m).
    Raises InputError for a vehicle that cannot hover, and PlanError if no plan exists.
    """
    if options["intervals"] is not None and not (options["optimum"] or options["bound"]):
        problem = "has no effect unless `optimum` or `bound` is given"
        raise InputError("`intervals`", str(options["intervals"]), problem, "also give `optimum` or `bound`")
    for name, base in NEEDS.items():
        if options[name] and not options[base]:  # type: ignore[literal-required]
            problem = f"has no effect unless `{base}` is given"
            raise InputError(f"`{name}`", "", problem, f"also give `{base}`")
    transfer = replace(transfer, **format_numbers(options, ("distance", "descent", "gravity")))
    vehicle = check_vehicle(replace(vehicle, **format_numbers(options, OF_VEHICLE)))
    margins = _margins(options, vehicle)
    check_hover(vehicle if margins is None else margins.of(vehicle), transfer)
    study = hover_study(
        vehicle,
        transfer,
        margins,
        duration=options["duration"],
        optimum=options["optimum"],
        bound=options["bound"],
        curves=options["curves"],
        adjoint=options["adjoint"],
        finite_switches=options["finite_switches"],
        free_fall=options["free_fall"],
        turn_begun=options["turn_begun"],
        distances=options["distances"],
        intervals=options["intervals"],
    )
    return HoverPlan(**vars(study))


def _margins(options: TransferOptions, vehicle: Vehicle) -> Margins | None:
    """Return the margins with single numbers replaced; None if no margins are requested."""
    margins = options["margins"]
    numbers = format_numbers(options, ("maximum_throttle", "minimum_throttle", "angular_acceleration"))
    if not numbers and not margins:
        return None
    if not isinstance(margins, Margins):
        unlimited = Margins(1.0, vehicle.minimum_thrust / vehicle.maximum_thrust, vehicle.angular_acceleration)
        margins = HOVER_MARGINS if margins else unlimited
    if "angular_acceleration" in numbers:
        numbers["angular_acceleration"] = math.radians(numbers["angular_acceleration"])
    return replace(margins, **numbers)


OF_LANDING = tuple(Landing.__dataclass_fields__)


@dataclass(frozen=True)
class LandingBound(Documented, LandingStudy):
    """Lower bound on the propellant of a landing: ``propellant`` (kg) and the ``bound`` trajectory that attains it.

    ``file`` is the file in the system's folder that stores the bound, if requested.
    """

    file: Path | None = None

    def document(self) -> Document:
        """Return a document with the bound, its checks and its trajectory."""
        return landing_bound_document(self, self.file)

    def problems(self) -> list[str]:
        """Return a line if the bound exceeds the propellant on board."""
        return propellant_problems(self.vehicle, self.propellant, "the bound")


@verb(BOUND)
def plan_landing_bound(
    landing: Landing | None = None,
    vehicle: Vehicle | None = None,
    system: FilePath | None = None,
    **options: Unpack[BoundOptions],
) -> LandingBound:
    """Compute a lower bound on the propellant of a single-burn braking and landing: `perilune design bound`.

    Needs the extra `plan`. ``landing`` and ``vehicle`` default to the bound that the ``system`` declares, if any, else
    to the published case; keywords replace single numbers of them (``climb`` in deg). ``direct`` verifies the bound by
    a direct method. ``store`` writes the bound to the system's folder for the pages of its simulations. Raises
    InputError and PlanError.
    """
    chosen = system_options(options)
    if system is None and chosen != SystemOptions():
        raise InputError("design bound", "system options", "there is no system to which they apply", "name a system")
    prepared = None if system is None else prepare_system(os.fspath(system), chosen)
    inputs = None if prepared is None else _read_inputs(prepared)
    of_vehicle, of_landing = format_numbers(options, OF_VEHICLE), format_numbers(options, OF_LANDING)
    is_changed = bool(of_vehicle or of_landing or landing or vehicle)
    if options["store"]:
        _check_store(
            prepared, [*of_vehicle, *of_landing, *(["landing"] if landing else (vehicle and ["vehicle"]) or [])]
        )
    base = (LANDING_VEHICLE, LANDING)
    if prepared is not None and inputs is not None:
        base = landing_of(inputs, prepared.archive.label)
    if "climb" in of_landing:
        of_landing["climb"] = math.radians(of_landing["climb"])
    study = landing_study(
        check_vehicle(replace(vehicle or base[0], **of_vehicle)),
        replace(landing or base[1], **of_landing),
        direct=options["direct"],
        intervals=options["intervals"],
        pieces=pieces_of(inputs, prepared.archive.label) if prepared and inputs and not is_changed else None,
    )
    bound = LandingBound(**vars(study))
    if not options["store"] or prepared is None or inputs is None:
        return bound
    try:
        return replace(bound, file=write_bound(bound.to_stored_bound(inputs), prepared.archive.path))
    except OSError as error:
        raise UnwrittenError(error, bound) from error


def _read_inputs(prepared: PreparedSystem) -> Inputs:
    inputs = read_inputs(prepared)
    if inputs is None:
        problem = f"the system does not declare the inputs of its landing's bound: it has no annotation {ANNOTATION}"
        raise InputError(
            prepared.network.file, "Annotations", problem, 'add this annotation; see "Planning" in the documentation'
        )
    return inputs


def _check_store(prepared: PreparedSystem | None, changed: Sequence[str]) -> None:
    """Reject storing a bound for changed values, or in a folder that cannot store it. Raises InputError."""
    if prepared is None:
        raise InputError("`store`", "", "there is no system in which to store the bound", "name a system")
    check_stored_system(prepared.archive)
    if changed:
        problem = "a stored bound uses the system's own values"
        raise InputError("`store`", f"`{changed[0]}`", problem, f"leave out `store` or `{changed[0]}`")
