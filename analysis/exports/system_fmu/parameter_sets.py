"""Conversion of a system's other parameter sets to parameter sets of its FMU."""

from __future__ import annotations

import posixpath
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

from ....common.errors import InputError
from ....fmus_src.evidence.parameter_set import write_parameter_set
from ...runtime.ssp.parameter_values import ParameterValue
from ...runtime.ssp.system_description import Element, SystemElement
from .choices import Preparation
from .fmu_variables import FmuVariable, Variables
from .model import SystemModel

RESOURCES = "resources/"


@dataclass(frozen=True)
class ConvertedSets:
    """Converted parameter sets, ``files`` by name in the FMU.

    ``unfit`` states why other sets cannot be converted, one line each.
    """

    files: Mapping[str, bytes]
    unfit: Sequence[str]


def other_parameter_sets(
    preparation: Preparation, system: SystemElement, declared: Sequence[FmuVariable]
) -> ConvertedSets:
    """Return the system's other parameter sets, each reduced to its changes of ``declared`` variables."""
    files, unfit = {}, []
    starts = {each.name: each.start for each in declared if each.causality in ("parameter", "input")}
    for file in _others(preparation, system):
        changed, problems = _changes(preparation, file, starts)
        unfit += problems
        if changed:
            about = "parameters and inputs of the system's FMU that this set changes"
            stem = PurePosixPath(file).stem
            files[f"{RESOURCES}{file.removeprefix(RESOURCES)}"] = write_parameter_set(stem, changed, about)
    return ConvertedSets(files, unfit)


def _others(preparation: Preparation, system: SystemElement) -> list[str]:
    """Return the parameter sets of a system that are neither chosen nor bound by its description."""
    files = preparation.archive.files
    used = _bound(system)
    for name in preparation.options.parameters:
        used |= {f"{RESOURCES}{name}", name, f"{RESOURCES}{name}.ssv"}
    return sorted(file for file in files if file.endswith(".ssv") and file not in used)


def _bound(element: Element) -> set[str]:
    """Return the parameter files bound to an element or to elements inside it."""
    inner = element.elements.values() if isinstance(element, SystemElement) else ()
    files = {posixpath.normpath(binding.source) for binding in element.bindings if binding.source is not None}
    return files.union(*map(_bound, inner))


def _changes(
    preparation: Preparation, name: str, starts: Mapping[str, ParameterValue | None]
) -> tuple[dict[str, float | int | bool], list[str]]:
    choices, problems = [], []
    for use in preparation.combinations():
        try:
            choices.append(preparation.choice(use, name))
        except InputError as error:
            slots = ", ".join(f"{slot}={candidate}" for slot, candidate in use.items())
            problems.append(f"{PurePosixPath(name).stem}{f' with {slots}' if slots else ''}: {error.problem}")
    if not choices:
        return {}, problems
    changed: dict[str, float | int | bool] = {}
    for variable, number in Variables(SystemModel(choices, (), ()), {}, {}).effective.items():
        if variable in starts and number != starts[variable]:
            assert isinstance(number, float | int)
            changed[variable] = number
    return changed, problems
