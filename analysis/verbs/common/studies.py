"""What the verbs of studies share: the folder of results, conditions in notebooks, requirements on their numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeVar

from ...campaigns.tables import assumption_lines
from ...common.errors import UnwrittenError
from ...common.targets import check_folder
from ...reports.studies.conditions import StudyResult, conditions_of

Study = TypeVar("Study")


def results_folder(options: Mapping[str, Any]) -> Path | None:
    """The folder of ``output``, checked before anything is simulated. Raises InputError."""
    output = options["output"]
    folder = None if output is None else Path(output).absolute()  # an FMU may change the working folder
    check_folder("`output`", folder, overwrite=options["overwrite"], otherwise="`overwrite`")
    return folder


def conditions(options: Mapping[str, Any]) -> dict[str, Any]:
    """What a study keeps constant, and its workers."""
    return {
        "hold": dict(options["hold"]),
        "noise_trial": options["noise_trial"],
        "workers": options["workers"],
    }


def write_results(result: Any, folder: Path | None) -> None:
    """Write a study's results to its folder. Raises UnwrittenError, which has the result."""
    if folder is None:
        return
    try:
        result.write(folder)
    except OSError as error:
        raise UnwrittenError(error, result) from error


def extend_result(kind: type[Study], result: Any, **more: Any) -> Study:
    """A study's result with what users have of it: of its subclass ``kind``, whose fields ``more`` are."""
    return kind(**{field.name: getattr(result, field.name) for field in fields(result)}, **more)


def condition_lines(result: StudyResult) -> list[str]:
    """What a study's numbers are conditional on, for a notebook."""
    stated = conditions_of(result)
    return [
        f"campaign {stated.campaign}",
        stated.noise.rstrip("."),
        stated.given.removeprefix(", "),
        *assumption_lines(result.facts),
    ]
