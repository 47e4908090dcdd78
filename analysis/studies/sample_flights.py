"""Simulation of samples by persistent workers, for repeated calls by a study."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from ...common.errors import InputError
from ...common.progress import progress_bar
from ..campaigns.definition.campaign import TrialRecord
from ..campaigns.definition.checks import check_draws, check_plan
from ..campaigns.definition.plan import BatchPlan
from ..campaigns.draws.interfaces import Columns
from ..campaigns.draws.supplied import ALL, Streams, SuppliedDraws
from ..campaigns.execute.flyer import Flyer
from ..campaigns.execute.metadata import provenance
from ..campaigns.execute.shard_flights import task_size
from ..campaigns.execute.workers import FlyerPool, worker_count
from ..campaigns.folder.provenance import CampaignProvenance
from ..campaigns.lost_trials import count_lost
from ..campaigns.trials import TrialTable, join_trials
from ..runtime.system.prepared import PreparedSystem
from .noise import make_samples, noise_of


class SampleFlights:
    """Simulator of chosen samples of one variant of a campaign. A context manager, since it holds workers.

    ``first`` are samples with which the campaign is checked before any simulation; ``noise_trial`` is the campaign's
    trial whose random streams all simulations use, None if they are passed to `fly`. ``workers`` (default: one per
    processor) does not change results. Raises InputError, also for a campaign that compares FMUs.
    """

    def __init__(
        self, plan: BatchPlan, first: Columns, *, noise_trial: int | None = None, workers: int | None = None
    ) -> None:
        variants = plan.campaign.variants()
        if len(variants) != 1:
            problem = f"the campaign has {len(variants)} variants, but a study needs one"
            raise InputError(plan.campaign.file, "`configuration`", problem, f"give `configuration` {variants[0].name}")
        self._count = worker_count(workers)
        self.plan = plan_of_samples(plan, first)
        systems = check_plan(self.plan)
        self.variant, self.prepared = next(iter(systems.items()))
        self.noise = noise_of(self.prepared, noise_trial, plan.campaign.seed)
        self.facts = study_provenance(self.plan, systems)
        self.flown = 0
        self.lost: Counter[str] = Counter()  # simulations that crashed, hung or ran out of memory
        self._pool = FlyerPool(self.plan, self._count, self.prepared.flies_in_threads)
        self._progress = progress_bar(unit="flight")

    def fly(self, columns: Columns, streams: Streams) -> tuple[TrialTable, Mapping[str, np.ndarray]]:
        """Return the trials of samples with these random streams, in order, and the drawn and derived values.

        ``streams`` are those of all sources of noise, by component. Raises InputError.
        """
        plan = self.plan.of_samples(make_samples(columns, streams, self.noise))
        check_draws(plan, [self.prepared])
        trials = plan.campaign.trials
        size = task_size(trials, self._count, self.prepared.flies_in_threads)
        pieces = [range(first, min(first + size, trials)) for first in range(0, trials, size)]
        parts: dict[int, TrialTable] = {}
        for place, flown in self._pool.work(_fly, [(self.variant, plan.of_part(piece)) for piece in pieces]):
            if flown is None:
                raise KeyboardInterrupt
            parts[place] = flown.renumber(pieces[place].start)
            self._progress.update(len(pieces[place]))
        self.flown += trials
        flown_trials = join_trials(parts.values())
        self.lost += count_lost(Counter(flown_trials.statuses))
        return flown_trials, plan.draws.of_part(range(trials)).columns

    def __enter__(self) -> SampleFlights:
        self._pool.__enter__()
        return self

    def __exit__(self, *error: object) -> None:
        self._progress.close()
        self._pool.__exit__(*error)


def _fly(
    flyer: Flyer, variant: str, plan: BatchPlan
) -> TrialTable | None:  # a function of a module, since workers import it
    return flyer.fly_others(variant, plan)


def plan_of_samples(plan: BatchPlan, first: Columns) -> BatchPlan:
    """Return the campaign's plan with the draws ``first``, without records, groups and scatter plots."""
    campaign = replace(plan.campaign, record=TrialRecord(), group=None, scatters=())
    return replace(plan, campaign=campaign).of_samples(SuppliedDraws(first, {ALL: np.zeros(1, dtype=np.int64)}))


class StudyProvenance(CampaignProvenance, total=False):
    """Inputs that determine the numbers of a study; ``loop``, ``point`` and ``time`` (s) are set for margins."""

    loop: str
    point: str
    time: float


def study_provenance(plan: BatchPlan, systems: Mapping[str, PreparedSystem]) -> StudyProvenance:
    """Return a batch's provenance without the entries that do not apply to a study of samples."""
    entries: StudyProvenance = {**provenance(plan, systems)}
    del entries["trials"], entries["record"]
    entries.pop("group", None)
    entries.pop("draws_sha256", None)
    return entries
