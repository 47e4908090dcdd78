"""Code shared by verbs of studies: results with documents and folders, requirements on their numbers, options."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, TypedDict, TypeVar

from ....common.errors import UnwrittenError
from ....common.targets import check_folder
from ...campaigns.definition.expressions import Expression
from ...documents.of.unmet import requirement_problems
from ...documents.render.words import lead_text
from ...options.declared.studies import ConditionOptions
from ...studies.flown import StudyResult
from .documented import Documented

if TYPE_CHECKING:  # imported where needed: matplotlib is slow to import
    from matplotlib.figure import Figure as Plot


class _RequiredOutcome(Protocol):
    @property
    def requirements(self) -> Sequence[Expression]: ...
    def values(self) -> Mapping[str, float]: ...


class _Writable(Protocol):
    def write(self, folder: Path) -> None: ...


Study = TypeVar("Study", bound=_Writable)


@dataclass(frozen=True, eq=False, repr=False)
class StoredResult(Documented):
    """Result of a study; ``folder`` is the folder in which it is stored, if any."""

    folder: Path | None = None

    def __repr__(self) -> str:
        document = self.document()
        return f"{type(self).__name__}({document.title.partition(': ')[0]}, {lead_text(document)})"

    def plot(self) -> Plot:
        """Plot the figures of the study, as a notebook shows them."""
        from ...documents.render.notebook import figures_of, plot_figures

        return plot_figures(figures_of(self.document()))


@dataclass(frozen=True, eq=False, repr=False)
class RequirementResult(StoredResult):
    """Result of a study with ``requirements``, the expressions of the option `require`."""

    requirements: Sequence[Expression] = ()

    def problems(self: _RequiredOutcome) -> list[str]:
        """Return a line for each requirement that is not met."""
        return requirement_problems(self.requirements, self.values())


class Conditions(TypedDict):
    """Fixed conditions of a study, and its number of workers."""

    hold: dict[str, float]
    noise_trial: int | None
    workers: int | None


def results_folder(options: ConditionOptions) -> Path | None:
    """Return the folder of ``output``, checked before any simulation. Raises InputError."""
    output = options["output"]
    folder = None if output is None else Path(output).absolute()  # an FMU may change the working folder
    check_folder("`output`", folder, overwrite=options["overwrite"], otherwise="`overwrite`")
    return folder


def conditions(options: ConditionOptions) -> Conditions:
    """Return the fixed conditions of a study, and its number of workers."""
    return {"hold": dict(options["hold"]), "noise_trial": options["noise_trial"], "workers": options["workers"]}


def store_result(kind: Callable[..., Study], result: StudyResult, folder: Path | None, **more: object) -> Study:
    """Convert a study's result to its public subclass ``kind`` with the fields ``more``, and write its folder."""
    complete = kind(**{field.name: getattr(result, field.name) for field in fields(result)}, folder=folder, **more)
    if folder is not None:
        try:
            complete.write(folder)
        except OSError as error:
            raise UnwrittenError(error, complete) from error
    return complete
