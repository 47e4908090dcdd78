"""perilune plan landing-bound: what braking and landing in one takes at least."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace

from ....fmus_src.paths import IS_CHECKOUT, PACKAGE
from ...common.errors import InputError
from ...common.targets import PAGES, Results, check_file
from ...design.trajectories.bounds import LANDING
from ...design.trajectories.declared_bound import ANNOTATION, Inputs, landing_of, pieces_of, read_inputs
from ...design.trajectories.landing_study import LandingStudy, landing_study
from ...design.trajectories.stored_bound import PLACE, write_bound
from ...design.trajectories.vehicle import LANDING_VEHICLE, check_vehicle
from ...reports.plan.pages import write_landing_page
from ...runtime.system.options import SystemOptions
from ...runtime.system.prepared import PreparedSystem, prepare_system
from ..asked.plans.landing_bound import PLACES
from ..common.exit_status import exit_status
from ..common.options import check_json, system_options, write_json
from ..common.vehicle import burns_text, enough, given


def run(options: argparse.Namespace) -> int:
    check_file("--report", options.report, PAGES)
    check_json(options)
    if options.system is None and system_options(options) != SystemOptions():
        raise InputError("landing-bound", "system options", "there is no system that they are for", "name a system")
    prepared = None if options.system is None else prepare_system(options.system, system_options(options))
    inputs = None if prepared is None else _inputs(prepared)
    single, places = given(options), given(options, PLACES)
    _check_store(options, prepared, [*single, *places])
    base = (LANDING_VEHICLE, LANDING)
    if prepared is not None and inputs is not None:
        base = landing_of(inputs, prepared.archive.label)
    if "climb" in places:
        places["climb"] = math.radians(places["climb"])
    study = landing_study(
        check_vehicle(replace(base[0], **single)),
        replace(base[1], **places),
        direct=options.direct,
        intervals=options.intervals,
        pieces=pieces_of(inputs, prepared.archive.label) if prepared and inputs and not (single or places) else None,
    )
    files = Results()
    if not write_json(study.document(), options.json, files):
        print("\n".join(_lines(study)))
    files.write(options.report, lambda path: write_landing_page(study, path))
    if options.store and prepared is not None and inputs is not None:
        content, folder = study.stored(inputs), prepared.archive.path
        files.write(folder / PLACE, lambda _: write_bound(content, folder))
    if options.json != "-":
        files.say()
    return exit_status(files, enough(study.vehicle, study.propellant, "the bound"))


def _inputs(prepared: PreparedSystem) -> Inputs:
    found = read_inputs(prepared)
    if found is None:
        problem = f"no annotation {ANNOTATION}: it does not say what its landing's bound is made of"
        raise InputError(prepared.network.file, "Annotations", problem, 'add one: "Planning" in the documentation')
    return found


def _check_store(options: argparse.Namespace, prepared: PreparedSystem | None, single: list[str]) -> None:
    """A stored bound is that of the system as its files say, in a folder that can hold it."""
    if not options.store:
        return
    if prepared is None:
        raise InputError("--store", "", "no system to store it with", "name a system")
    if not prepared.archive.path.is_dir():
        raise InputError("--store", str(prepared.archive.path), "not a folder", "unpack the .ssp and name its folder")
    if not IS_CHECKOUT and prepared.archive.path.is_relative_to(PACKAGE):
        problem = "a system of the installed package, which is not written to"
        raise InputError("--store", str(prepared.archive.path), problem, "copy this folder and name the copy")
    if single:
        option = f"--{single[0].replace('_', '-')}"
        raise InputError("--store", option, "a stored bound is that of the system's own values", "leave one out")


def _lines(study: LandingStudy) -> list[str]:
    bound = study.bound
    lines = [
        f"bound {study.propellant:.3f} kg of {study.vehicle.mass:g} kg in {bound.duration:.2f} s "
        f"({bound.throttle.size} intervals); {burns_text(bound.burns())}",
        f"  thrust is that of the convex form to {study.looseness:.1g} m/s2",
    ]
    lines += [f"  {name} by itself {propellant:.3f} kg" for name, propellant in study.pieces.items()]
    if study.direct is not None:
        propellant = study.direct.propellant_fraction * study.vehicle.mass
        off = propellant - study.propellant
        lines.append(
            f"direct method {propellant:.3f} kg in {study.direct.duration:.2f} s, {off:+.1e} kg from the bound"
        )
    return lines
