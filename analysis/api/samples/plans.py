"""The plan of a study that chooses a campaign's draws itself, from the keywords of its function."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ...campaigns.draws.given import ALL, GivenDraws
from ...campaigns.spec.plan import BatchPlan, read_plan
from ...reports.campaign.replays import replay_command
from ...runtime.ssp.parameter_sets import SetValue
from ...runtime.system.fault import Fault, faults_of
from ...runtime.system.in_flight.series import Given, read_series
from ...runtime.system.in_flight.watch import Watch
from ...studies.evaluation.commands import Commands
from ..options import Compared, FilePath, check_list, compared, system_options


def commands_of(plan: BatchPlan) -> Commands:
    """What writes command lines for the flights of a study's plan."""
    (variant,) = plan.campaign.variants()

    def replay(draws: Path, trial: int) -> str:
        given = GivenDraws({}, {ALL: np.zeros(trial + 1, dtype=np.int64)}, str(draws))
        return replay_command(plan.of_samples(given), variant, trial)

    def monte_carlo(trials: int) -> str:
        words = replay_command(replace(plan, campaign=replace(plan.campaign, trials=trials)), variant, 0)
        return words.removesuffix(" --replay 0")

    return Commands(replay, monte_carlo)


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
        compare=compared(compare),
        faults=faults_of(faults),
        series=None if input is None else read_series(input),
        watch=Watch(timeout, log),
    )
