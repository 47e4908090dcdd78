"""The plan of a study that chooses a campaign's draws itself, from the keywords of its function."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ...campaign.plan import BatchPlan, read_plan
from ...ssp.parameter_sets import SetValue
from ...system.faults import Fault, faults_of
from ...system.in_flight.series import Given, read_series
from ...system.in_flight.watch import Watch
from ..options import FilePath, check_list, system_options


def sample_plan(
    system: FilePath,
    campaign: FilePath,
    *,
    compare: Mapping[str, str] | None,
    seed: int | None,
    use: Mapping[str, FilePath] | None,
    parameters: Sequence[FilePath],
    set: Mapping[str, SetValue] | None,
    faults: Sequence[Fault | str],
    input: Given | None,
    log: str | None,
    timeout: float | None,
    feedthrough: Sequence[str],
    no_feedthrough: Sequence[str],
    **options: Any,
) -> BatchPlan:
    """The plan of a call; ``options`` are the rest of `SystemOptions` by name. Raises InputError."""
    check_list("faults", faults)
    return read_plan(
        Path(system),
        str(campaign),
        system_options(use, parameters, set, feedthrough, no_feedthrough, **options),
        seed=seed,
        compare=None if compare is None else {slot: [fmu] for slot, fmu in compare.items()},
        faults=faults_of(faults),
        series=None if input is None else read_series(input),
        watch=Watch(timeout, log),
    )
