"""`perilune.validate` and `perilune validate`: check of files without a simulation."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import ClassVar, Unpack, overload

from ...common.bounds import bound_of
from ...common.errors import ExitStatus, InputError
from ...common.paths import names_fmu
from ...common.regular import read_input
from ...fmus_src.export.ssp_package import DESCRIPTION, SYSTEM_FILE
from ..campaigns.definition.campaign_source import read_source
from ..campaigns.definition.checks import check_plan
from ..campaigns.definition.file import SYNTHESIS, read_campaign
from ..campaigns.definition.home import find_system
from ..campaigns.definition.plan import read_plan
from ..compose.files import report_changed_source
from ..compose.likeness import find_difference
from ..design.laws.law import read_law
from ..design.synthesis.synthesis_file import read_synthesis
from ..design.trajectories.stored_bound import MissingBound, find_bound
from ..documents.figures.figure_reader import read_figures
from ..documents.model import Document
from ..documents.of.validation import validation_document
from ..options.declared.library import VALIDATE, ValidateOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.fmi.rules import broken_rules
from ..runtime.process.resets import find_verdict, renewal_note
from ..runtime.ssp.archive import DEFAULT_VARIANT, open_system
from ..runtime.ssp.parameter_sets import read_parameter_file
from ..runtime.system.fmu import Fmu, load_fmu
from ..runtime.system.inputs import missing_outputs
from ..runtime.system.options import SystemOptions as System
from ..runtime.system.options import system_options
from ..runtime.system.prepared import prepare_system
from ..runtime.system.times import MissingStopTimeError
from ..stability.request.loop_declaration import read_declaration
from ..stability.request.request import Subject, check_loops
from .common.arguments import path_list
from .common.documented import Documented
from .compose import compose_file

FILES = (".ssv", ".json", ".toml")  # not systems


@dataclass(frozen=True)
class FileCheck:
    """Check of one path: ``problems`` (a line each, none if it is valid) and ``notes``."""

    path: str
    problems: tuple[str, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True)
class Validation(Documented, Sequence[FileCheck]):
    """The checks in the order of the paths."""

    checks: tuple[FileCheck, ...]
    problem_status: ClassVar[ExitStatus] = ExitStatus.REFUSED

    @overload
    def __getitem__(self, index: int) -> FileCheck: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[FileCheck, ...]: ...
    def __getitem__(self, index: int | slice) -> FileCheck | tuple[FileCheck, ...]:
        return self.checks[index]

    def __len__(self) -> int:
        return len(self.checks)

    def document(self) -> Document:
        """Return a document with notes and valid paths."""
        return validation_document([asdict(check) for check in self.checks])

    def problems(self) -> list[str]:
        """Return the problems of all paths."""
        return [problem for check in self.checks for problem in check.problems]


@verb(VALIDATE)
def validate(*paths: FilePath | Sequence[FilePath], **options: Unpack[ValidateOptions]) -> Validation:
    """Check systems, FMUs, parameter sets, campaigns and laws: `perilune validate`.

    ``paths`` are arguments or a list; the result contains a `FileCheck` for each. A system is checked in the variant
    that `simulate` would use, or in ``all_variants``. Other options are as in `simulate` and apply to systems and FMUs
    only. Raises InputError for incompatible options.
    """
    system, all_variants = system_options(options), options["all_variants"]
    if all_variants and system.chosen["variant"] is not None:
        raise InputError(
            "`all_variants`", str(system.chosen["variant"]), "`variant` is also given", "give one of the two"
        )
    names = path_list(paths)
    systems = [name for name in names if not name.endswith(FILES)]
    return Validation(tuple(_check(path, system, all_variants, systems) for path in names))


def _check(path: str, options: System, all_variants: bool, systems: Sequence[str]) -> FileCheck:
    notes: list[str] = []
    problems: list[str] = []
    try:
        if path.endswith(FILES) and options.replace(strict=False) != System():
            raise InputError(
                path,
                "system options",
                "apply only to systems",
                "validate this file alone",
            )
        if names_fmu(path):
            fmu = load_fmu(_read(path), path)
            violations = [
                f"{path}: modelDescription.xml: {rule}" for rule in fmu.flaws or broken_rules(fmu.description)
            ]
            if options.chosen["strict"]:
                problems += [f"{violation}; fix the FMU's modelDescription.xml" for violation in violations]
            else:
                notes += violations
            prepared = prepare_system(path, options, {path: fmu})
            notes += [*prepared.remarks, *missing_outputs(prepared.network)]
            notes += _reset_notes(fmu, path, options)
        elif path.endswith(".ssv"):
            read_parameter_file(_read(path), path, remarks=notes)
        elif path.endswith(".json"):
            read_law(Path(path))
        elif Path(path).name == SYSTEM_FILE:
            notes += _check_short_file(Path(path))
        elif path.endswith(".toml"):
            notes += _check_campaign(path, systems)
        else:
            notes += _check_system(path, options, all_variants)
    except InputError as error:
        problems.append(error.text)
    return FileCheck(path, tuple(problems), tuple(notes))


def _check_campaign(path: str, systems: Sequence[str]) -> list[str]:
    """Check a search, or a campaign as `batch` does if its system is known; return notes. Raises InputError."""
    raw = _read(path)
    system = find_system(raw, Path(path), systems)
    table = read_source(raw, path, None if system is None else open_system(system)).table()
    if SYNTHESIS in table.content:
        read_synthesis(Path(path))
    elif system is None:
        other = read_campaign(Path(path)).system
        return [
            f"checked without its system {other}, which Perilune does not contain: name the system in the same command"
        ]
    else:
        check_plan(read_plan(system, path if os.path.dirname(path) else os.path.join(os.curdir, path), System()))
    return []


def _check_short_file(path: Path) -> list[str]:
    """Compose a system without writing it; return a note if the SSD next to its file differs. Raises InputError."""
    _, document = compose_file(path)
    ssd = path.with_name(DESCRIPTION)
    if not ssd.exists() or find_difference(document, read_input(ssd, "move it away", bound_of(ssd.name))) is None:
        return []
    return [f"{ssd} does not match {path}: perilune compose {path} writes it again"]


def _check_system(path: str, options: System, all_variants: bool) -> list[str]:
    """Check one variant of a system, or all; return notes. Raises InputError."""
    notes = report_changed_source(path)
    others = [name for name in open_system(path).variants() if name != DEFAULT_VARIANT] if all_variants else []
    for variant in (options.chosen["variant"], *others):
        subject = Subject(path, options.replace(variant=variant))
        try:
            prepared = prepare_system(path, subject.options, subject.fmus)
        except MissingStopTimeError as error:
            subject = Subject(path, subject.options.replace(stop_time=error.earliest))
            prepared = prepare_system(path, subject.options, subject.fmus)
            notes.append(f"{error.file}: {error.element} is missing, so `run` needs `stop_time`")
        check_loops(subject, read_declaration(prepared.network.description))
        read_figures(prepared)
        bound = find_bound(prepared)
        notes += [f"bound: {bound.reason}"] if isinstance(bound, MissingBound) else []
        notes += [*prepared.retired, *prepared.network.notes, *missing_outputs(prepared.network)]
        notes += [f"{connection}: read one step late" for connection in prepared.schedule.late]
        for component, fmu in prepared.network.fmus.items():
            notes += _reset_notes(fmu, component, options)
    return notes


def _reset_notes(fmu: Fmu, name: str, options: System) -> list[str]:
    """Return a note if the reset of an FMU fails; foreign FMUs are tested."""
    note = renewal_note(name, find_verdict(fmu, options))
    return [] if note is None else [note]


def _read(path: str) -> bytes:
    return read_input(path, "give the path of a file", bound_of(path))
