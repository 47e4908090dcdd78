"""Repetition of a trial of a stored campaign, from its folder alone, and comparison with the stored result."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

from ....common.errors import InputError, suggestion
from ...runtime.flight.results import TIMED_OUT, FlightResult
from ...runtime.system.options import UNTRUSTED, Trust
from ...runtime.system.prepared import PreparedSystem
from ..definition.campaign import Variant
from ..definition.checks import check_plan
from ..definition.plan import BatchPlan
from ..folder.campaign_manifest import read_manifest
from ..trials import TrialTable
from .flyer import Flyer, TrialResult, result_of
from .loaded_campaign import LoadedCampaign, open_folder
from .plan_manifest import restore

CUT_OFF = ("interrupted", TIMED_OUT)


@dataclass(frozen=True)
class ReplayedTrial:
    """Repeated trial of a ``configuration`` of a campaign: its ``flight`` with every signal, and its ``outcome``.

    ``faults`` are the faults that acted in the trial. ``stored`` is True if the folder contains the trial, and
    ``differences`` describes how the repeated trial differs from it. Differences can occur only if the campaign was
    simulated by another version of Perilune, if foreign FMUs were simulated on another machine, or if ``timeout`` or
    Ctrl-C ended the simulation (``is_cut_off``); rows after such an end are not compared.
    """

    plan: BatchPlan
    prepared: PreparedSystem
    configuration: str
    trial: int
    flight: FlightResult
    outcome: TrialResult
    faults: tuple[str, ...]
    stored: bool
    differences: tuple[str, ...]

    @property
    def is_cut_off(self) -> bool:
        """True if the simulation was ended by a limit of wall-clock time, or by Ctrl-C."""
        return self.outcome.status in CUT_OFF


def replay_trial(
    folder: Path,
    trial: int,
    configuration: str | None = None,
    *,
    log: str | None = None,
    timeout: float | None = None,
    trust: Trust = UNTRUSTED,
) -> ReplayedTrial:
    """Repeat a trial from a campaign's folder with the same bits. Raises InputError and StuckError.

    ``configuration`` names the variant if there are several. ``log`` is the level of the FMUs' messages. ``timeout`` (s
    of wall time) replaces the campaign's. ``trust`` contains the permissions of foreign FMUs.
    """
    folder = folder.absolute()  # FMUs may change the working folder
    campaign = open_folder(folder, trust)
    variant = _variant_of(campaign.plan, folder, configuration)
    _check_trial(folder, trial, campaign.manifest.trials)
    manifest = read_manifest(folder)
    plan = restore(folder, manifest if timeout is None else replace(manifest, timeout=timeout), log, trust=trust)
    return _replay(plan, campaign.systems[variant.name], variant, trial, campaign)


def replay_plan(plan: BatchPlan, trial: int, configuration: str | None = None) -> ReplayedTrial:
    """Repeat a trial of a plan without a folder. Raises InputError and StuckError."""
    check_plan(plan)
    variant = _variant_of(plan, plan.campaign.file, configuration)
    _check_trial(plan.campaign.file, trial, plan.campaign.trials)
    return _replay(plan, plan.prepare(variant), variant, trial, None)


def _replay(
    plan: BatchPlan, prepared: PreparedSystem, variant: Variant, trial: int, campaign: LoadedCampaign | None
) -> ReplayedTrial:
    """Repeat a trial, and compare it with the stored trial if the ``campaign`` has a folder that contains it."""
    flight, outcome = Flyer(plan).replay(variant.name, trial)
    stored = None if campaign is None else _read_stored(campaign, variant, trial)
    return ReplayedTrial(
        plan=plan,
        prepared=prepared,
        configuration=variant.name,
        trial=trial,
        flight=flight,
        outcome=outcome,
        faults=tuple(str(fault) for fault in plan.faults_of(trial) if fault is not None),
        stored=stored is not None,
        differences=() if stored is None else _differences(stored, outcome),
    )


def _check_trial(file: str | Path, trial: int, trials: int) -> None:
    if not 0 <= trial < trials:
        raise InputError(file, f"trial {trial}", "no such trial", f"give 0 to {trials - 1}")


def _variant_of(plan: BatchPlan, file: str | Path, name: str | None) -> Variant:
    variants = {variant.name: variant for variant in plan.campaign.variants()}
    if name is None and len(variants) > 1:
        problem = f"the campaign has {len(variants)} configurations, and none is selected"
        raise InputError(file, "`configuration`", problem, f"give one of {', '.join(variants)}")
    if name is not None and name not in variants:
        raise InputError(file, f"`configuration` {name}", "no such configuration", suggestion(name, variants))
    return variants[name] if name is not None else next(iter(variants.values()))


def _read_stored(campaign: LoadedCampaign, variant: Variant, trial: int) -> TrialResult | None:
    """Return the stored result of a trial, or None if its shard is missing. Raises InputError for a damaged shard."""
    shard = trial // campaign.numbering.size
    if not campaign.has(shard):
        return None
    metrics = [f"metric.{metric.name}" for metric in campaign.plan.campaign.metrics]
    trials = campaign.shard_rows(shard)[variant.name]
    (table,) = trials.tables(["status", "success", "message", "end_time", *metrics])
    return result_of(TrialTable(table), trial - campaign.numbering.of(shard).start)


def _differences(stored: TrialResult, flown: TrialResult) -> tuple[str, ...]:
    """Return the bitwise differences between two results of a trial, a phrase for each."""
    if flown.status in CUT_OFF:
        return (f"status {stored.status!r} is stored, {flown.status!r} was simulated: other results are not compared",)
    pairs: dict[str, tuple[object, object]] = {
        "status": (stored.status, flown.status),
        "success": (stored.success, flown.success),
        "end_time": (stored.end_time, flown.end_time),
    }
    pairs |= {name: (value, flown.metrics[name]) for name, value in stored.metrics.items()}
    return tuple(
        f"{name} {before!r} is stored, {now!r} was simulated"
        for name, (before, now) in pairs.items()
        if not _same(before, now)
    )


def _same(one: object, other: object) -> bool:
    if isinstance(one, float) and isinstance(other, float):
        return one.hex() == other.hex() or (math.isnan(one) and math.isnan(other))
    return one == other
