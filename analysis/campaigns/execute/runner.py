"""Run of a campaign: manifest, draws, shards simulated by workers, results."""

from __future__ import annotations

from collections.abc import Callable, Collection, Generator, Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import numpy as np

from ....common.errors import InputError
from ....common.progress import progress_bar
from ..definition.plan import BatchPlan
from ..folder.lock import lock_folder
from ..folder.numbering import format_shards
from ..requirement_verdicts import satisfies, trials_to_decision
from ..trials import TrialTable
from .campaign_result import CampaignResult
from .loaded_campaign import LoadedCampaign, open_campaign
from .shard_flights import fly_shards, task_size
from .store import ShardStore
from .workers import FlyerPool, in_threads, worker_count

# Simulates shards of a campaign; yields each one's number and trials by variant on completion, in any order.
Elsewhere = Callable[[LoadedCampaign, Sequence[int]], Generator[tuple[int, dict[str, TrialTable]]]]


def run_batch(
    plan: BatchPlan,
    *,
    workers: int | None = None,
    output: Path | None = None,
    resume: bool = False,
    engine: str | None = None,
    elsewhere: Elsewhere | None = None,
) -> CampaignResult:
    """Simulate every trial of every variant of a plan. Raises InputError before any simulation.

    ``workers`` is the number of parallel simulations (default: one for each processor), ``engine`` one of `ENGINES`
    (default: threads if the FMUs permit); ``elsewhere`` is an executor that replaces both. With ``output`` every shard
    is stored in that folder on completion, and the summary at the end, so that ``resume`` can continue after an
    interruption. Without ``output`` no results remain after Ctrl-C.
    """
    campaign = open_campaign(plan, output, resume=resume, engine=engine, workers=workers)
    rows = fly_campaign(campaign, campaign.missing(), workers=workers, engine=engine, elsewhere=elsewhere)
    return CampaignResult.finish(campaign, rows)


def merge_rows(campaign: LoadedCampaign) -> Mapping[str, TrialTable]:
    """Return the trials by variant of a campaign with stored shards. Raises InputError if shards are missing."""
    missing = campaign.missing()
    decision = _decide(campaign, missing)
    if missing and not decision.is_decided:
        count = f"{len(missing)} of {campaign.numbering.count} shards are missing"
        remedy = f"perilune shard {campaign.folder} {format_shards(missing)} simulates them"
        raise InputError(str(campaign.folder), f"shards {format_shards(missing)}", count, remedy)
    return _rows(campaign, campaign.store(), decision)


def fly_campaign(
    campaign: LoadedCampaign,
    shards: Sequence[int],
    *,
    workers: int | None = None,
    engine: str | None = None,
    elsewhere: Elsewhere | None = None,
) -> Mapping[str, TrialTable]:
    """Simulate shards of a campaign, store them if it has a folder, and return all of its trials by variant.

    If the campaign ends once it is decided, trials after the deciding shard are omitted, even if they were simulated.
    """
    store = campaign.store()
    decision = _decide(campaign, campaign.missing())
    flights = sum(len(campaign.numbering.of(shard)) for shard in shards) * len(campaign.plan.campaign.variants())
    if elsewhere is not None:
        flying = elsewhere(campaign, shards)
    else:
        flying = _fly_here(campaign, shards, workers, engine)
    failed = 0
    with lock_folder(campaign.folder), progress_bar(total=flights, unit="flight") as bar, closing(flying) as flown:
        for shard, trials in () if decision.is_decided else flown:
            store.add(shard, trials)
            decision.add(shard, trials)
            failed += sum(int(np.count_nonzero(~rows.flown)) for rows in trials.values())
            bar.set_postfix_str(f"{failed} failed", refresh=False)
            bar.update(sum(map(len, trials.values())))
            if decision.is_decided:
                break
    return _rows(campaign, store, decision)


def _decide(campaign: LoadedCampaign, missing: Collection[int]) -> CampaignDecision:
    """Return the decision that follows from the stored shards of a campaign."""
    decision, store, numbering = CampaignDecision(campaign.plan), campaign.store(), campaign.numbering
    if campaign.plan.until_decided and campaign.folder is not None:
        for shard in sorted(set(range(numbering.count)) - set(missing)):
            decision.add(shard, store.rows(numbering, range(shard, shard + 1)))
    return decision


def _rows(campaign: LoadedCampaign, store: ShardStore, decision: CampaignDecision) -> dict[str, TrialTable]:
    """Return the trials of a campaign by variant, up to the shard that decides it."""
    numbering = campaign.numbering
    if decision.shards is not None:
        numbering = replace(numbering, trials=numbering.of(decision.shards - 1).stop)
    return store.rows(numbering)


def _fly_here(
    campaign: LoadedCampaign, shards: Sequence[int], workers: int | None, engine: str | None
) -> Generator[tuple[int, dict[str, TrialTable]]]:
    count = worker_count(workers)
    threads = in_threads(campaign.systems.values(), engine)
    trials = sum(len(campaign.numbering.of(shard)) for shard in shards)
    flights = trials * len(campaign.plan.campaign.variants())
    size = task_size(campaign.numbering.trials, count, threads)
    tasks = -(-flights // size)
    with (
        FlyerPool(
            campaign.stored_plan, min(count, max(tasks, 1)), threads, in_child=engine == "processes", trials=trials
        ) as pool,
        closing(fly_shards(campaign.numbering, shards, pool, size)) as flown,
    ):
        yield from flown


class CampaignDecision:
    """Decision of a campaign from its shards in order of number, regardless of the order in which they arrive.

    ``shards`` is the number of shards, counted from the first, that decide the campaign, or None while it is undecided.
    It depends neither on workers nor on further simulated shards. A campaign that is not to end early is never decided.
    """

    def __init__(self, plan: BatchPlan) -> None:
        self._plan = plan
        self._ahead: dict[int, dict[str, list[np.ndarray]]] = {}  # shards that arrived before an earlier one
        self._kept: dict[str, list[np.ndarray]] = {}  # True for satisfied trials, by variant and for each requirement
        self._looked = 0
        self.shards: int | None = None

    @property
    def is_decided(self) -> bool:
        return self.shards is not None

    def add(self, shard: int, variants: Mapping[str, TrialTable]) -> None:
        """Add the trials of a shard by variant, which are evaluated once all earlier shards are present."""
        if not self._plan.until_decided:
            return
        requirements = self._plan.campaign.requirements
        self._ahead[shard] = {
            name: [satisfies(requirement, trials) for requirement in requirements] for name, trials in variants.items()
        }
        while not self.is_decided and self._looked in self._ahead:
            for name, rows in self._ahead.pop(self._looked).items():
                before = self._kept.get(name)
                self._kept[name] = (
                    rows if before is None else [np.concatenate(both) for both in zip(before, rows, strict=True)]
                )
            self._looked += 1
            if trials_to_decision(requirements, self._kept) is not None:
                self.shards = self._looked
