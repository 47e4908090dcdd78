"""The plan of a study that chooses a campaign's draws itself, from the keywords of its function."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any, TypeVar

from ...campaign.plan import BatchPlan, read_plan
from ...ssp.parameter_sets import SetValue
from ...system.faults import Fault, faults_of
from ...system.in_flight.series import Given, read_series
from ...system.in_flight.watch import Watch
from ..options import Compared, FilePath, check_list, compared, system_options

Study = TypeVar("Study")


def sample_plan(
    system: FilePath,
    campaign: FilePath,
    *,
    compare: Compared | None,
    seed: int | None,
    use: Mapping[str, FilePath] | None,
    parameters: Sequence[FilePath],
    set: Mapping[str, SetValue] | None,
    faults: Sequence[Fault | str],
    input: Given | None,
    log: str | None,
    timeout: float | None,
    no_feedthrough: Sequence[str],
    **options: Any,
) -> BatchPlan:
    """The plan of a call; ``options`` are the rest of `SystemOptions` by name. Raises InputError."""
    check_list("faults", faults)
    return read_plan(
        Path(system),
        str(campaign),
        system_options(use, parameters, set, no_feedthrough, **options),
        seed=seed,
        compare=compared(compare),
        faults=faults_of(faults),
        series=None if input is None else read_series(input),
        watch=Watch(timeout, log),
    )


def as_class(kind: type[Study], result: Any, **more: Any) -> Study:
    """A study's result with what Python users have of it: of its subclass ``kind``, whose fields ``more`` are."""
    return kind(**{field.name: getattr(result, field.name) for field in fields(result)}, **more)


def condition_words(result: Any) -> list[str]:
    """What a study's numbers are conditional on, for a notebook."""
    held = [f"{name} = {value:g}" for name, value in result.space.held.items()]
    return [result.noise, f"held: {', '.join(held)}" if held else ""]
