"""Campaign plan and requirements from a verb's options, and the commands that repeat its trials."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from ....common.errors import EndedError, ExitStatus, InputError
from ....common.machine.os_errors import line_of
from ...campaigns.definition.expressions import Expression
from ...campaigns.definition.file import parse_campaign
from ...campaigns.definition.plan import BatchPlan, read_plan
from ...campaigns.definition.sweeps import split_sweeps
from ...campaigns.draws.supplied import ALL, SuppliedDraws
from ...campaigns.execute.cluster.tasks import WorkersDiedError
from ...campaigns.execute.loaded_campaign import LoadedCampaign
from ...campaigns.folder.campaign_manifest import FILE as MANIFEST
from ...campaigns.summary import requirement_values, summarise
from ...campaigns.trial_columns import describe_metrics
from ...campaigns.trials import TrialTable
from ...commands.campaigns import campaign_command, replay_command
from ...options.fault import faults_of
from ...options.option import FilePath
from ...runtime.system.options import Watch, system_options
from ...runtime.system.series import read_series
from ...studies.flown import StudyCommands
from .arguments import read_requirements


def read_campaign(system: FilePath, campaign: FilePath, options: Mapping[str, Any]) -> BatchPlan:
    """Read the plan of a campaign with the options of a verb. Raises InputError."""
    settings, sweeps = split_sweeps(system_options(options))
    if sweeps and "trials" not in options:  # the options of a study, which draws the samples
        name, text = next(iter(sweeps.items()))
        raise InputError("`set`", f"{name}={text}", "a study cannot sweep a parameter", "give one value")
    series, draws = options["input"], options.get("draws")
    plan = read_plan(
        os.fspath(system),
        os.fspath(campaign),
        settings,
        trials=options.get("trials"),
        seed=options["seed"],
        compare=_read_compare(options["compare"]),
        configuration=options["configuration"],
        faults=faults_of(options["faults"]),
        series=None if series is None else read_series(series),
        watch=Watch(options["timeout"], options["log"]),
        until_decided=options.get("until_decided", False),
        draws=None if draws is None else Path(draws),
        sweeps=sweeps,
    )
    if "trials" in options and draws is None:
        return plan
    read = parse_campaign(plan.source.table()) if plan.source is not None else plan.campaign
    if dropped := read.metrics_of_lookups():
        tables = ", ".join(lookup.name for lookup in read.lookups)
        warnings.warn(
            f"{', '.join(dropped)}: omitted, since {tables} covers only the campaign's own trials", stacklevel=2
        )
    return replace(plan, campaign=plan.campaign.without_lookups())


def _read_compare(compare: Mapping[str, FilePath | Sequence[FilePath]]) -> dict[str, list[str]] | None:
    """Return the compared FMUs (names or paths) by slot; a single FMU becomes a list."""
    if not compare:
        return None
    return {
        slot: [os.fspath(fmus)] if isinstance(fmus, str | os.PathLike) else [os.fspath(fmu) for fmu in fmus]
        for slot, fmus in compare.items()
    }


def campaign_requirements(plan: BatchPlan, texts: Sequence[str]) -> list[Expression]:
    """Read requirements before any simulation. Raises InputError for numbers that the summary will not contain."""
    nothing = np.full(1, np.nan)
    metrics = {f"metric.{metric.name}": nothing for metric in plan.campaign.metrics}
    blank = TrialTable.of({"status": [""], "success": np.zeros(1, dtype=bool), **metrics})
    blank = blank.described(describe_metrics(plan.campaign.metrics))
    variants = [variant.name for variant in plan.campaign.variants()]
    columns = dict.fromkeys(variants, blank)
    summary = {
        name: replace(
            entry, groups={group.label: replace(entry, value=group.value, requirements={}) for group in plan.groups}
        )
        for name, entry in summarise(columns, requirements=plan.campaign.requirements).items()
    }
    known = requirement_values(summary)
    statuses = tuple(f"{name.removesuffix('.trials')}.statuses." for name in known if name.endswith(".trials"))
    return read_requirements(texts, known, statuses)


def commands_of(plan: BatchPlan) -> StudyCommands:
    """Return functions that write the commands for the simulations of a study."""
    (variant,) = plan.campaign.variants()

    def replay(draws: Path, trial: int) -> str:
        samples = SuppliedDraws({}, {ALL: np.zeros(trial + 1, dtype=np.int64)}, str(draws))
        return replay_command(plan.of_samples(samples), variant, trial)

    def monte_carlo(trials: int) -> str:
        return campaign_command(replace(plan, campaign=replace(plan.campaign, trials=trials)), variant)

    return StudyCommands(replay, monte_carlo)


def warn_of_foreign_fmus(campaign: LoadedCampaign) -> None:
    """Warn of the foreign FMUs in a campaign's folder before they run: the author of the folder chose them."""
    fmus = {fmu.digest: fmu for system in campaign.systems.values() for fmu in system.network.fmus.values()}
    foreign = sorted(f"{fmu.name} ({digest[:12]})" for digest, fmu in fmus.items() if not fmu.is_own)
    if foreign:
        warnings.warn(
            f"{campaign.user_folder or campaign.folder}: runs its foreign FMUs {', '.join(foreign)}",
            stacklevel=2,
        )


@contextmanager
def resume_hint(folder: Path | None) -> Iterator[None]:
    """Add a campaign's folder and how to resume it to an error that ends the campaign early. Raises EndedError."""
    home = None if folder is None else folder.absolute()  # an FMU may change the working folder
    try:
        yield
    except WorkersDiedError as error:
        raise EndedError(f"{error}{_hint(home)}", ExitStatus.NOT_MET) from error
    except KeyboardInterrupt as interrupt:
        if hint := _hint(home):
            interrupt.add_note(hint)
        raise
    except OSError as error:
        raise EndedError(f"{line_of(error)}{_hint(home)}", ExitStatus.REFUSED) from error


def _hint(folder: Path | None) -> str:
    if folder is None or not (folder / MANIFEST).is_file():
        return ""
    return f"; completed trials are stored in {folder}: resume with the same command and `resume`, or with shard"
