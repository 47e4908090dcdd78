"""The parameter sets of a system that are not applied, as sets of its FMU's parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

from ....fmus_src.evidence.parameter_set import write_parameter_set
from ...common.errors import InputError
from ...runtime.ssp.given_values import ParameterValue
from .choices import Preparation
from .model import SystemModel
from .variables import FmuVariable, Variables


@dataclass(frozen=True)
class OtherSets:
    """``files`` by name in the FMU; ``unfit`` says of sets, or of candidates with one, why they do not fit."""

    files: Mapping[str, bytes]
    unfit: Sequence[str]


def other_parameter_sets(preparation: Preparation, declared: Sequence[FmuVariable]) -> OtherSets:
    """What each further set of the system changes of the ``declared`` parameters."""
    archive, files, unfit = preparation.archive, {}, []
    starts = {each.name: each.start for each in declared if each.causality == "parameter"}
    applied = {PurePosixPath(name).stem for name in preparation.options.parameters}
    for stem in sorted(PurePosixPath(file).stem for file in archive.files if file.endswith(".ssv")):
        if stem in applied:
            continue
        changed, problems = _changes(preparation, stem, starts)
        unfit += problems
        if changed:
            about = "parameters of the system's FMU that this set changes"
            files[f"resources/{stem}.ssv"] = write_parameter_set(stem, changed, about)
    return OtherSets(files, unfit)


def _changes(
    preparation: Preparation, name: str, starts: Mapping[str, ParameterValue | None]
) -> tuple[dict[str, float | int | bool], list[str]]:
    choices, problems = [], []
    for use in preparation.combinations():
        try:
            choices.append(preparation.choice(use, name))
        except InputError as error:
            slots = ", ".join(f"{slot}={candidate}" for slot, candidate in use.items())
            problems.append(f"{name}{f' with {slots}' if slots else ''}: {error.problem}")
    if not choices:
        return {}, problems
    changed: dict[str, float | int | bool] = {}
    for each in Variables(SystemModel(choices, (), ()), {}, {}).declared:
        if each.causality == "parameter" and each.name in starts and each.start != starts[each.name]:
            assert isinstance(each.start, float | int)
            changed[each.name] = each.start
    return changed, problems
