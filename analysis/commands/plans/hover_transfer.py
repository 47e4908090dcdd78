"""perilune plan hover-transfer: from one hover to another on least propellant."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace

from ...common.errors import InputError
from ...common.targets import PAGES, Results, check_file
from ...design.trajectories.hover_study import HoverStudy, hover_study
from ...design.trajectories.path import PlannedPath
from ...design.trajectories.vehicle import (
    HOVER_MARGINS,
    HOVER_VEHICLE,
    Margins,
    Transfer,
    Vehicle,
    check_hover,
    check_vehicle,
)
from ...reports.plan.pages import write_hover_page
from ..common.exit_status import exit_status
from ..common.options import check_json, write_json
from ..common.vehicle import burns_text, enough, given


def run(options: argparse.Namespace) -> int:
    check_file("--report", options.report, PAGES)
    check_json(options)
    if options.intervals is not None and not (options.optimum or options.bound):
        problem = "nothing here has intervals"
        raise InputError("--intervals", str(options.intervals), problem, "ask for --optimum or --bound with it")
    vehicle = check_vehicle(replace(HOVER_VEHICLE, **given(options)))
    transfer = Transfer(options.distance, options.descent, options.gravity)
    margins = _margins(options, vehicle)
    check_hover(vehicle if margins is None else margins.of(vehicle), transfer)
    study = hover_study(
        vehicle,
        transfer,
        margins,
        duration=options.t7,
        optimum=options.optimum,
        bound=options.bound,
        curves=options.curves or options.report is not None,
        intervals=options.intervals,
    )
    files = Results()
    if not write_json(study.document(), options.json, files):
        print("\n".join(_lines(study)))
    files.write(options.report, lambda path: write_hover_page(study, path))
    if options.json != "-":
        files.say()
    return exit_status(files, enough(vehicle, study.programme.propellant_fraction * vehicle.mass, "the programme"))


def _margins(options: argparse.Namespace, vehicle: Vehicle) -> Margins | None:
    """Those of --margins or all of the vehicle, with what is given singly on top; None where nothing is asked for."""
    single = given(options, ("maximum_throttle", "minimum_throttle", "angular_acceleration"))
    if not single and not options.margins:
        return None
    base = Margins(1.0, vehicle.minimum_thrust / vehicle.maximum_thrust, vehicle.angular_acceleration)
    if "angular_acceleration" in single:
        single["angular_acceleration"] = math.radians(single["angular_acceleration"])
    return replace(HOVER_MARGINS if options.margins else base, **single)


def _lines(study: HoverStudy) -> list[str]:
    programme, mass = study.programme, study.vehicle.mass
    fraction, vertical = programme.propellant_fraction, study.vertical.propellant_fraction
    t2, t5, w, tp, t7 = programme.times
    threshold = "" if programme.threshold is None else f" (k {programme.threshold:.4f})"
    low, high = (math.degrees(angle) for angle in programme.extremes)
    lines = [
        f"programme {programme.kind}: t2 {t2:.3f}, t5 {t5:.3f}, w {w:.3f}{threshold}, tp {tp:.3f}, t7 {t7:.3f} s",
        f"  propellant {fraction:.6f} of the mass, {fraction * mass:.3f} kg; {burns_text(programme.burns)}",
        f"  pitch {low:.1f} to {high:.1f} deg, {math.degrees(programme.turn_rate):.3f} deg/s",
        f"  {fraction / vertical:.4f} times straight down, {vertical:.6f} in {study.vertical.duration:.2f} s",
    ]
    named = (("true optimum", study.optimum), ("point-mass bound", study.bound))
    return lines + [_path_line(name, path, mass) for name, path in named if path is not None]


def _path_line(name: str, path: PlannedPath, mass: float) -> str:
    return (
        f"{name}: {path.propellant_fraction:.6f} of the mass, {path.propellant_fraction * mass:.3f} kg "
        f"in {path.duration:.2f} s ({path.throttle.size} intervals); {burns_text(path.burns())}"
    )
