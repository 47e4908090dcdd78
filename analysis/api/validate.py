"""Files checked without flying them."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from fmpy.validation import validate_fmu

from ..campaign.file import SYNTHESIS, read_campaign
from ..campaign.toml_table import read_toml
from ..errors import InputError
from ..laws.law import read_law
from ..planning.stored_bound import MissingBound, find_bound
from ..reports.own.asked.reading import read_figures
from ..stability.ask.channels import channels_of
from ..stability.ask.declaration import Declaration
from ..stability.ask.reading import read_declaration
from ..stability.ask.subject import Subject
from ..synthesis.synthesis_file import read_synthesis
from ..system.archive import DEFAULT_VARIANT, open_system
from ..system.fmu import load_fmu
from ..system.options import SystemOptions
from ..system.parameter_sets import read_parameter_file
from ..system.prepared import prepare_system
from .options import FilePath


def validate(*paths: FilePath) -> list[dict[str, Any]]:
    """Check systems, FMUs, parameter sets, campaigns, laws: `perilune validate`.

    A row for each: ``path``, ``problems`` (lines, none where it is good) and ``notes``.
    """
    return [_check(os.fspath(path)) for path in paths]


def _check(path: str) -> dict[str, Any]:
    """Problems and notes of one path."""
    notes: list[str] = []
    problems: list[str] = []
    try:
        if path.endswith(".fmu"):
            load_fmu(_read(path), path)
            remedy = "mend the FMU's modelDescription.xml"
            problems += [
                f"{path}: modelDescription.xml: {' '.join(text.split())}; {remedy}" for text in validate_fmu(path)
            ]
        elif path.endswith(".ssv"):
            read_parameter_file(_read(path), path)
        elif path.endswith(".json"):
            read_law(Path(path))
        elif path.endswith(".toml"):
            is_search = SYNTHESIS in read_toml(Path(path)).content
            (read_synthesis if is_search else read_campaign)(Path(path))
        else:
            variants = [None, *(name for name in open_system(path).variants() if name != DEFAULT_VARIANT)]
            for variant in variants:
                subject = Subject(path, SystemOptions(variant=variant))
                prepared = prepare_system(path, subject.options, subject.fmus)
                _check_loops(subject, read_declaration(prepared.network.description))
                read_figures(prepared)
                bound = find_bound(prepared)
                notes += [f"bound: {bound.reason}"] if isinstance(bound, MissingBound) else []
                notes += prepared.network.notes
                notes += [f"{connection}: read one step late" for connection in prepared.schedule.late]
    except InputError as error:
        problems.append(str(error))
    return {"path": path, "problems": problems, "notes": notes}


def _check_loops(subject: Subject, declared: Declaration) -> None:
    """Refuse an operating point that cannot be set, and a loop that is cut where no signal is."""
    points = {point.name: subject.at(point) for point in declared.points}
    for loop in declared.loops:
        for name in loop.points:
            channels_of(loop, points[name].network, points[name].step)


def _read(path: str) -> bytes:
    if not Path(path).is_file():
        raise InputError(path, "file", "not found", "give the path of a file")
    return Path(path).read_bytes()
