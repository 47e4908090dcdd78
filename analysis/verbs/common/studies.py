"""What the verbs of studies share: the folder of results, conditions in notebooks, requirements on their numbers."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, Protocol, TypedDict, TypeVar

from ....common.errors import UnwrittenError
from ....common.targets import check_folder
from ...campaigns.definition.expressions import Expression
from ...campaigns.plain_text import assumption_lines
from ...options.declared.studies import ConditionOptions
from ...reports.studies.conditions import StudyResult, conditions_of
from .arguments import requirement_problems


class _Outcome(Protocol):
    """What a study's result can do, of which `Stored` and `Required` make what the command line needs."""

    @property
    def folder(self) -> Path | None: ...
    def document(self, folder: Path | None) -> dict[str, Any]: ...
    def text(self, folder: Path | None) -> str: ...


class _RequiredOutcome(Protocol):
    @property
    def requirements(self) -> Sequence[Expression]: ...
    def values(self) -> Mapping[str, float]: ...


class _Writable(Protocol):
    def write(self, folder: Path) -> None: ...


Study = TypeVar("Study", bound=_Writable)


@dataclass(frozen=True, eq=False, repr=False)
class Stored:
    """``folder`` is where a study's result is stored, if it is."""

    folder: Path | None = None

    def to_json(self: _Outcome) -> dict[str, object]:
        """The result for other programs."""
        return self.document(self.folder)

    def lines(self: _Outcome) -> list[str]:
        """What the verb prints."""
        return [self.text(self.folder)]

    def problems(self) -> list[str]:
        """None."""
        return []


@dataclass(frozen=True, eq=False, repr=False)
class Required(Stored):
    """A stored result with ``requirements``, those of the option `require`."""

    requirements: Sequence[Expression] = ()

    def problems(self: _RequiredOutcome) -> list[str]:
        """Requirements that are not met."""
        return requirement_problems(self.requirements, self.values())


class Conditions(TypedDict):
    """What a study keeps constant, and its workers."""

    hold: dict[str, float]
    noise_trial: int | None
    workers: int | None


def results_folder(options: ConditionOptions) -> Path | None:
    """The folder of ``output``, checked before anything is simulated. Raises InputError."""
    output = options["output"]
    folder = None if output is None else Path(output).absolute()  # an FMU may change the working folder
    check_folder("`output`", folder, overwrite=options["overwrite"], otherwise="`overwrite`")
    return folder


def conditions(options: ConditionOptions) -> Conditions:
    """What a study keeps constant, and its workers."""
    return {"hold": dict(options["hold"]), "noise_trial": options["noise_trial"], "workers": options["workers"]}


def store_result(kind: Callable[..., Study], result: StudyResult, folder: Path | None, **more: object) -> Study:
    """A study's result as users have it, of its subclass ``kind``, whose fields ``more`` are, written to its folder.

    Raises UnwrittenError, which has the result.
    """
    complete = kind(**{field.name: getattr(result, field.name) for field in fields(result)}, folder=folder, **more)
    if folder is not None:
        try:
            complete.write(folder)
        except OSError as error:
            raise UnwrittenError(error, complete) from error
    return complete


def condition_lines(result: StudyResult) -> list[str]:
    """What a study's numbers are conditional on, for a notebook."""
    stated = conditions_of(result)
    return [
        f"campaign {stated.campaign}",
        stated.noise.rstrip("."),
        stated.given.removeprefix(", "),
        *assumption_lines(result.facts.get("assumptions", ())),
    ]
