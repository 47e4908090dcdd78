"""What the results of the three studies have in common for Python users."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, TypeVar

from ...campaigns.tables import assumption_lines
from ...reports.studies.conditions import StudyResult, conditions_of

Study = TypeVar("Study")


def as_class(kind: type[Study], result: Any, **more: Any) -> Study:
    """A study's result with what Python users have of it: of its subclass ``kind``, whose fields ``more`` are."""
    return kind(**{field.name: getattr(result, field.name) for field in fields(result)}, **more)


def condition_words(result: StudyResult) -> list[str]:
    """What a study's numbers are conditional on, for a notebook."""
    conditions = conditions_of(result)
    return [
        f"campaign {conditions.campaign}",
        conditions.noise.rstrip("."),
        conditions.given.removeprefix(", "),
        *assumption_lines(result.facts),
    ]
