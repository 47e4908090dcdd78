"""`perilune.plan_hover_transfer` and `perilune design transfer`: from one hover to another on least propellant."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Unpack

from ..common.errors import InputError
from ..design.trajectories.hover_study import HoverStudy, hover_study
from ..design.trajectories.path import PlannedPath
from ..design.trajectories.vehicle import (
    HOVER_MARGINS,
    HOVER_TRANSFER,
    HOVER_VEHICLE,
    Margins,
    Transfer,
    Vehicle,
    check_hover,
    check_vehicle,
)
from ..reports.plan.pages import write_hover_page
from .common.plan_text import OF_VEHICLE, burns_text, format_numbers, propellant_problems
from .options.design import TRANSFER, TransferOptions
from .options.option import FilePath
from .options.verb import verb


@dataclass(frozen=True)
class HoverPlan(HoverStudy):
    """A transfer planned: its ``programme``, compared with optimum and bound as far as they were requested."""

    def report(self, path: FilePath) -> None:
        """Write the page of `perilune design transfer --report`, curves included."""
        write_hover_page(self.with_curves(), Path(path))

    def lines(self) -> list[str]:
        """What `perilune design transfer` prints."""
        programme, mass = self.programme, self.vehicle.mass
        fraction, vertical = programme.propellant_fraction, self.vertical.propellant_fraction
        t2, t5, w, tp, t7 = programme.times
        threshold = "" if programme.threshold is None else f" (k {programme.threshold:.4f})"
        low, high = (math.degrees(angle) for angle in programme.extremes)
        lines = [
            f"programme {programme.kind}: t2 {t2:.3f}, t5 {t5:.3f}, w {w:.3f}{threshold}, tp {tp:.3f}, t7 {t7:.3f} s",
            f"  propellant fraction {fraction:.6f}, {fraction * mass:.3f} kg; {burns_text(programme.burns)}",
            f"  pitch {low:.1f} to {high:.1f} deg, {math.degrees(programme.turn_rate):.3f} deg/s",
            f"  {fraction / vertical:.4f} x vertical descent, {vertical:.6f} in {self.vertical.duration:.2f} s",
        ]
        named = (("true optimum", self.optimum), ("point-mass bound", self.bound))
        return lines + [line for name, path in named if path is not None for line in _path_lines(name, path, mass)]

    def to_json(self) -> dict[str, Any]:
        """All of it for other programs; times in s, angles in deg."""
        return self.document()

    def problems(self) -> list[str]:
        """Whether the programme takes more propellant than is on board."""
        return propellant_problems(
            self.vehicle, self.programme.propellant_fraction * self.vehicle.mass, "the programme"
        )


@verb(TRANSFER)
def plan_hover_transfer(
    transfer: Transfer = HOVER_TRANSFER, vehicle: Vehicle = HOVER_VEHICLE, **options: Unpack[TransferOptions]
) -> HoverPlan:
    """Plan a transfer between two hovers: `perilune design transfer`; see docs/planning.md.

    ``transfer`` and ``vehicle`` are the published case, with numbers of it replaced by keywords of their names.
    ``margins`` leave feedback its part of throttle and angular acceleration: `Margins`, or True for the published ones;
    ``maximum_throttle``, ``minimum_throttle`` and ``angular_acceleration`` (deg/s2) replace their numbers.
    ``duration`` (s) is the programme's end, by default that of least propellant; ``optimum`` and ``bound`` need the
    extra `plan`. Raises InputError for a vehicle that cannot hover, and PlanError where there is no such plan.
    """
    if options["intervals"] is not None and not (options["optimum"] or options["bound"]):
        problem = "without effect unless `optimum` or `bound` is given"
        raise InputError("`intervals`", str(options["intervals"]), problem, "give one of them with it")
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
        intervals=options["intervals"],
    )
    return HoverPlan(**vars(study))


def _margins(options: TransferOptions, vehicle: Vehicle) -> Margins | None:
    """The margins with the numbers that replace theirs; None where none are requested."""
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


def _path_lines(name: str, path: PlannedPath, mass: float) -> list[str]:
    return [
        f"{name}: propellant fraction {path.propellant_fraction:.6f}, {path.propellant_fraction * mass:.3f} kg "
        f"in {path.duration:.2f} s ({path.throttle.size} intervals)",
        f"  {burns_text(path.burns())}",
    ]
