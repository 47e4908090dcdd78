"""Commands that repeat a campaign or one of its trials with the options of its plan."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path, PurePosixPath

from ...common.errors import InputError
from ...common.paths import SYSTEMS
from ..campaigns.definition.campaign import Variant
from ..campaigns.definition.plan import BatchPlan
from ..campaigns.execute.plan_manifest import restore
from ..campaigns.folder.campaign_manifest import read_manifest
from ..options.command import write_command
from ..options.declared.campaigns import BATCH, REPLAY


def replay_command(plan: BatchPlan, variant: Variant, trial: int) -> str:
    """Return the command that repeats one trial of one variant of a plan."""
    options = {"campaign": campaign_name(plan), **_of_variant(plan, variant)}
    return write_command(REPLAY, {"source": plan.system, "trial": trial}, options)


def campaign_command(plan: BatchPlan, variant: Variant) -> str:
    """Return the command that repeats a plan with one of its variants."""
    return write_command(BATCH, {"system": plan.system, "campaign": campaign_name(plan)}, _of_variant(plan, variant))


def batch_command(plan: BatchPlan, output: Path | None = None) -> str:
    """Return the command that repeats a plan with all its variants, and writes it to the folder ``output``."""
    campaign = plan.campaign
    compare = {} if campaign.configurations else campaign.compare
    options = {**_options(plan, campaign.selected, compare), "until_decided": plan.until_decided, "output": output}
    return write_command(BATCH, {"system": plan.system, "campaign": campaign_name(plan)}, options)


def batch_of_folder(folder: Path) -> str:
    """Return the command that wrote a campaign's folder; an empty text if its manifest or contents cannot be read."""
    try:
        plan = restore(folder, read_manifest(folder))
    except (InputError, OSError):
        return ""
    name = plan.archive.name if plan.archive is not None else ""
    is_shipped = plan.system == f"{SYSTEMS.name}/{name}"
    return batch_command(replace(plan, system=name) if is_shipped else plan, folder)


def replay_of_folder(folder: Path, configurations: Collection[object], configuration: str, trial: int) -> str:
    """Return the command that repeats a trial of one of the ``configurations`` of a campaign's folder."""
    options = {"configuration": configuration if len(configurations) > 1 else None}
    return write_command(REPLAY, {"source": folder, "trial": trial}, options)


def campaign_name(plan: BatchPlan) -> str:
    """Return a plan's campaign as a command states it: its name if the system contains it, else its path."""
    inside = plan.campaign.file.partition("!")[2]  # name of a campaign inside the system
    return PurePosixPath(inside).stem if inside else plan.campaign.file


def _of_variant(plan: BatchPlan, variant: Variant) -> dict[str, object]:
    """Return the options that select one variant of a plan, by name."""
    if plan.campaign.configurations:
        return _options(plan, variant.name, {})
    return _options(plan, None, {name: [fmu] for name, fmu in variant.use.items()})


def _options(plan: BatchPlan, configuration: str | None, compare: Mapping[str, Sequence[str]]) -> dict[str, object]:
    """Return the options of a plan by name, except arrays of inputs, which have no textual form."""
    campaign, settings = plan.campaign, plan.options.by_name
    trials = {"trials": campaign.trials} if plan.supplied is None else {"draws": plan.supplied.file}
    file = plan.series.file if plan.series is not None and plan.series.lines else None
    return {
        **trials,
        "seed": campaign.seed,
        "configuration": configuration,
        "compare": compare,
        **{name: value for name, value in settings.items() if name != "set"},
        "set": {**campaign.sweeps, **plan.options.set},
        "faults": [str(fault) for fault in plan.faults],
        "input": file,
        "timeout": plan.watch.timeout,
    }
