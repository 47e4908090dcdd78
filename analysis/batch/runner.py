"""Runs a batch: plan, draws, workers, results."""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path
from typing import Any

import pyarrow

from ..campaign.plan import BatchPlan, check_plan
from ..progress import progress_bar
from .facts import campaign_facts
from .results import BatchResult, make_result, write_parquet
from .trials import Trials, joined
from .workers import fly_all, tasks_of, worker_count


def run_batch(plan: BatchPlan, *, workers: int | None = None, output: Path | None = None) -> BatchResult:
    """Fly every trial of every variant of a plan. Raises InputError before anything flies.

    ``workers`` is the number of parallel flights (default: one per processor). With ``output`` the table of draws is
    written there first; the results are the caller's to write. Ctrl-C leaves a result of the first trials, as many as
    every variant has flown; without any it is raised again.
    """
    output = None if output is None else output.absolute()  # FMUs may change the working folder
    count = worker_count(workers)
    systems = check_plan(plan)
    native = all(prepared.flies_in_threads for prepared in systems.values())
    if output is not None:
        write_draws(plan, output)
    tasks = tasks_of(plan, count, native)
    trials: dict[str, list[Trials]] = {variant.name: [] for variant in plan.campaign.variants()}
    planned = plan.campaign.trials
    total = planned * len(trials)
    try:
        with progress_bar(total=total, unit="trial") as progress:
            for variant, found in fly_all(plan, tasks, min(count, len(tasks)), native):
                trials[variant].append(found)
                progress.update(len(found.trial))
    except KeyboardInterrupt:
        first = min(_first_flown(parts) for parts in trials.values())
        if not first:
            raise
        plan = plan.of_first(first)
        trials = {
            name: [part.below(first) for part in parts if part.trial[0] < first] for name, parts in trials.items()
        }
        if output is not None:
            write_draws(plan, output)
    facts = provenance(plan, systems) | ({"planned_trials": planned} if plan.campaign.trials < planned else {})
    return make_result(plan, {name: joined(parts) for name, parts in trials.items()}, facts)


def _first_flown(parts: list[Trials]) -> int:
    """How many trials from the first on are there without a gap."""
    flown = 0
    for part in sorted(parts, key=lambda part: int(part.trial[0])):
        if int(part.trial[0]) == flown:
            flown += len(part.trial)
    return flown


def write_draws(plan: BatchPlan, folder: Path) -> None:
    """Write the table of draws to ``folder``/draws.parquet, a row per trial."""
    columns = {"trial": list(range(plan.campaign.trials)), **plan.draws.columns}
    write_parquet(pyarrow.table(columns), folder / "draws.parquet")


def provenance(plan: BatchPlan, systems: dict) -> dict[str, Any]:
    """What a batch's numbers depend on, apart from the trials themselves."""
    first = next(iter(systems.values()))
    return {
        "system": first.archive.name,
        "system_sha256": first.archive.digest,
        "campaign": plan.campaign.file,
        "campaign_sha256": plan.campaign_sha256,
        "parameter_sets": [*plan.campaign.parameters, *plan.options.parameters],
        "set": {**plan.campaign.settings, **plan.options.set},
        "variant": plan.options.variant,
        "start_time": first.start,
        "steps": first.steps,
        "trials": plan.campaign.trials,
        "seed": plan.campaign.seed,
        "step": first.step,
        "algorithm": first.algorithm,
        **(first.drive.facts() if first.drive is not None else {}),
        **({"timeout": plan.watch.timeout} if plan.watch.timeout is not None else {}),
        "fmus": {
            variant: {name: fmu.digest for name, fmu in prepared.network.fmus.items()}
            for variant, prepared in systems.items()
        },
        "perilune": version("perilune"),
        **campaign_facts(plan, systems),
    }
