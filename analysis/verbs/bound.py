"""`perilune.plan_landing_bound` and `perilune design bound`: least propellant of a single-burn landing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Unpack

from ...fmus_src.paths import IS_CHECKOUT, PACKAGE
from ..common.errors import InputError, UnwrittenError
from ..design.trajectories.declared_bound import ANNOTATION, Inputs, landing_of, pieces_of, read_inputs
from ..design.trajectories.landing_study import LandingStudy, landing_study
from ..design.trajectories.stored_bound import write_bound
from ..design.trajectories.vehicle import LANDING, LANDING_VEHICLE, Landing, Vehicle, check_vehicle
from ..reports.plan.pages import write_landing_page
from ..runtime.system.options import SystemOptions, system_options
from ..runtime.system.prepared import PreparedSystem, prepare_system
from .common.plan_text import OF_VEHICLE, burns_text, format_numbers, propellant_problems
from .options.design import BOUND, BoundOptions
from .options.option import FilePath
from .options.verb import verb

OF_LANDING = tuple(Landing.__dataclass_fields__)


@dataclass(frozen=True)
class LandingBound(LandingStudy):
    """The bound of a landing: ``propellant`` (kg) and the ``bound`` path that takes it.

    ``file`` is where the bound is stored, in the system's folder, if it was requested.
    """

    file: Path | None = None

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune design bound --report`."""
        write_landing_page(self, Path(path))

    def lines(self) -> list[str]:
        """What `perilune design bound` prints."""
        bound = self.bound
        lines = [
            f"bound {self.propellant:.3f} kg of {self.vehicle.mass:g} kg in {bound.duration:.2f} s "
            f"({bound.throttle.size} intervals)",
            f"  {burns_text(bound.burns())}",
            f"  largest thrust residual of the convex form: {self.looseness:.1g} m/s2",
        ]
        lines += [f"  {name} alone: {propellant:.3f} kg" for name, propellant in self.pieces.items()]
        if self.direct is not None:
            propellant = self.direct.propellant_fraction * self.vehicle.mass
            difference = f"{propellant - self.propellant:+.1e} kg compared with the bound"
            lines.append(f"direct method {propellant:.3f} kg in {self.direct.duration:.2f} s, {difference}")
        return lines + ([] if self.file is None else [f"stored: {self.file}"])

    def to_json(self) -> dict[str, Any]:
        """All of it for other programs; SI, but angular acceleration."""
        return self.document()

    def problems(self) -> list[str]:
        """Whether the bound is more propellant than is on board."""
        return propellant_problems(self.vehicle, self.propellant, "the bound")


@verb(BOUND)
def plan_landing_bound(
    landing: Landing | None = None,
    vehicle: Vehicle | None = None,
    system: FilePath | None = None,
    **options: Unpack[BoundOptions],
) -> LandingBound:
    """Bound the propellant of a single-burn braking and landing: `perilune design bound`; needs the extra `plan`.

    ``landing`` and ``vehicle`` are those of a ``system`` that declares a bound, else the published case, with numbers
    replaced by keywords of their names; ``climb`` is in deg. ``direct`` checks the bound by a direct method. ``store``
    writes it to the system's folder, for the pages of its simulations. Raises InputError and PlanError.
    """
    chosen = system_options(options)
    if system is None and chosen != SystemOptions():
        raise InputError("design bound", "system options", "there is no system that they are for", "name a system")
    prepared = None if system is None else prepare_system(Path(system), chosen)
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
        problem = f"no annotation {ANNOTATION}: it does not say what its landing's bound is made of"
        raise InputError(prepared.network.file, "Annotations", problem, 'add one: "Planning" in the documentation')
    return inputs


def _check_store(prepared: PreparedSystem | None, changed: Sequence[str]) -> None:
    """Refuse to store a bound that is not that of the system as its files say, or in a folder that cannot hold it."""
    if prepared is None:
        raise InputError("`store`", "", "no system to store it with", "name a system")
    if not prepared.archive.path.is_dir():
        raise InputError("`store`", str(prepared.archive.path), "not a folder", "unpack the .ssp and name its folder")
    if not IS_CHECKOUT and prepared.archive.path.is_relative_to(PACKAGE):
        problem = "a system of the installed package, which is not written to"
        raise InputError("`store`", str(prepared.archive.path), problem, "copy this folder and name the copy")
    if changed:
        problem = "a stored bound is that of the system's own values"
        raise InputError("`store`", f"`{changed[0]}`", problem, "leave one out")
