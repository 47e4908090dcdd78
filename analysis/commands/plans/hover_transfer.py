"""perilune plan hover-transfer: from one hover to another on least propellant."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from pathlib import Path

from ...api.plans import HOVER_MARGINS, HOVER_TRANSFER, HOVER_VEHICLE, check_hover, check_vehicle
from ...errors import InputError
from ...planning.hover_study import HoverStudy, hover_study
from ...planning.path import PlannedPath
from ...planning.vehicle import Margins, Transfer, Vehicle
from ...reports.plan.hover_page import write_hover_page
from ...targets import Results, check_file
from ..common.options import add_json, check_json, write_json
from .vehicle import add_vehicle, burns_text, enough, given, number, whole

HELP = "plan a transfer between two hovers: simplified programme, true optimum, point-mass bound"


def add(parser: argparse.ArgumentParser) -> None:
    way = parser.add_argument_group("transfer")
    way.add_argument("--distance", type=number(0.0, above=False), default=HOVER_TRANSFER.distance, metavar="X",
                     help=f"m, along; default: {HOVER_TRANSFER.distance:g}")  # fmt: skip
    way.add_argument("--descent", type=number(0.0), default=HOVER_TRANSFER.descent, metavar="X",
                     help=f"m, down; default: {HOVER_TRANSFER.descent:g}")  # fmt: skip
    way.add_argument("--gravity", type=number(0.0), default=HOVER_TRANSFER.gravity, metavar="X",
                     help=f"m/s2, uniform; default: {HOVER_TRANSFER.gravity:g}")  # fmt: skip
    way.add_argument("--t7", type=number(0.0), metavar="T", help="s, the end; default: the one of least propellant")
    add_vehicle(parser, HOVER_VEHICLE)
    limits = parser.add_argument_group("control margins")
    limits.add_argument(
        "--margins",
        action="store_true",
        help="leave feedback its part: "
        f"throttle {HOVER_MARGINS.minimum_throttle:g} to {HOVER_MARGINS.maximum_throttle:g}, "
        f"{math.degrees(HOVER_MARGINS.angular_acceleration):g} deg/s2; without: all that the vehicle has",
    )
    limits.add_argument("--maximum-throttle", type=number(0.0, 1.0), metavar="X", help="of the largest thrust")
    limits.add_argument("--minimum-throttle", type=number(0.0, 1.0, above=False), metavar="X", help="of the same")
    limits.add_argument("--angular-acceleration", type=number(0.0), metavar="X", help="deg/s2; the vehicle's is 1")
    more = parser.add_argument_group("more than the programme")
    more.add_argument("--optimum", action="store_true", help="the true optimum, too, by direct multiple shooting")
    more.add_argument("--bound", action="store_true", help="the bound of a point mass, too, by the convex form")
    more.add_argument("--curves", action="store_true", help="propellant over t7 and over distance, too")
    more.add_argument("--intervals", type=whole, metavar="N", help="of both; default: 320 and 240")
    parser.add_argument("--report", type=Path, metavar="F.html", help="write a page with figures, curves included")
    add_json(parser)


def run(options: argparse.Namespace) -> int:
    check_file("--report", options.report)
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
    return 2 if files.failed else enough(vehicle, study.programme.propellant_fraction * vehicle.mass, "the programme")


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
