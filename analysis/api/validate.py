"""Files checked without flying them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Literal

from fmpy.validation import validate_fmu

from ..campaigns.spec.file import SYNTHESIS, read_campaign
from ..campaigns.spec.source import read_source_file
from ..common.errors import InputError
from ..design.laws.law import read_law
from ..design.synthesis.synthesis_file import read_synthesis
from ..design.trajectories.stored_bound import MissingBound, find_bound
from ..reports.figures.declaration.reading import read_figures
from ..runtime.flight.instances.reset_check import reset_verdict
from ..runtime.ssp.archive import DEFAULT_VARIANT, open_system
from ..runtime.ssp.parameter_sets import SetValue, read_parameter_file
from ..runtime.system.fmu import Fmu, load_fmu
from ..runtime.system.options import SystemOptions
from ..runtime.system.prepared import prepare_system
from ..stability.request.channels import channels_of
from ..stability.request.declaration import Declaration
from ..stability.request.reading import read_declaration
from ..stability.request.subject import Subject
from .options import FilePath, path_list, system_options

FILES = (".ssv", ".json", ".toml")  # that are no systems


def validate(
    *paths: FilePath | Sequence[FilePath],
    use: Mapping[str, FilePath] | None = None,
    parameters: Sequence[FilePath] = (),
    set: Mapping[str, SetValue] | None = None,
    step: float | None = None,
    stop_time: float | None = None,
    algorithm: Literal["sequential", "jacobi"] | None = None,
    variant: str | None = None,
    flavour: Literal["native", "python"] | None = None,
    allow_unmatched: bool = False,
    strict: bool = False,
    open_inputs: Literal["refuse", "start"] = "refuse",
    feedthrough: Sequence[str] = (),
    no_feedthrough: Sequence[str] = (),
) -> list[dict[str, Any]]:
    """Check systems, FMUs, parameter sets, campaigns, laws: `perilune validate`.

    They are given one by one or as a list. A row for each: ``path``, ``problems`` (lines, none where it is good) and
    ``notes``. Of a system all variants are checked unless ``variant`` names one; the options are those of `simulate`,
    for systems and FMUs alone.
    """
    options = system_options(
        use, parameters, set, feedthrough, no_feedthrough, step=step, stop_time=stop_time, algorithm=algorithm,
        variant=variant, flavour=flavour, allow_unmatched=allow_unmatched, strict=strict, open_inputs=open_inputs,
    )  # fmt: skip
    return validated(path_list(paths), options)


def validated(paths: Sequence[str], options: SystemOptions) -> list[dict[str, Any]]:
    """Likewise, with the options of a command line."""
    return [_check(path, options) for path in paths]


def _check(path: str, options: SystemOptions) -> dict[str, Any]:
    """Problems and notes of one path."""
    notes: list[str] = []
    problems: list[str] = []
    try:
        if path.endswith(FILES) and replace(options, strict=False) != SystemOptions():
            raise InputError(path, "system options", "it is no system, which they are for", "check it by itself")
        if path.endswith(".fmu"):
            fmu = load_fmu(_read(path), path)
            flaws = [f"{path}: modelDescription.xml: {' '.join(text.split())}" for text in validate_fmu(path)]
            if options.strict:
                problems += [f"{flaw}; mend the FMU's modelDescription.xml" for flaw in flaws]
            else:
                notes += flaws
            notes += prepare_system(path, options, {path: fmu}).remarks
            notes += _reset_note(fmu, path)
        elif path.endswith(".ssv"):
            read_parameter_file(_read(path), path)
        elif path.endswith(".json"):
            read_law(Path(path))
        elif path.endswith(".toml"):
            is_search = SYNTHESIS in read_source_file(Path(path)).table().content
            (read_synthesis if is_search else read_campaign)(Path(path))
        else:
            variants = [None, *(name for name in open_system(path).variants() if name != DEFAULT_VARIANT)]
            for variant in variants if options.variant is None else [options.variant]:
                subject = Subject(path, replace(options, variant=variant))
                prepared = prepare_system(path, subject.options, subject.fmus)
                _check_loops(subject, read_declaration(prepared.network.description))
                read_figures(prepared)
                bound = find_bound(prepared)
                notes += [f"bound: {bound.reason}"] if isinstance(bound, MissingBound) else []
                notes += prepared.network.notes
                notes += [f"{connection}: read one step late" for connection in prepared.schedule.late]
                for component, fmu in prepared.network.fmus.items():
                    notes += _reset_note(fmu, component)
    except InputError as error:
        problems.append(str(error))
    return {"path": path, "problems": problems, "notes": notes}


def _reset_note(fmu: Fmu, name: str) -> list[str]:
    """What there is to say of an FMU's reset: it is tried, unless it is our own."""
    verdict = reset_verdict(fmu)
    return (
        [] if verdict.resets else [f"{name}: instantiated anew for every flight, as its reset fails: {verdict.reason}"]
    )


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
