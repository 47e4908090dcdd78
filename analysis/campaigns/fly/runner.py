"""Runs a campaign: manifest, draws, shards flown by workers, results."""

from __future__ import annotations

from collections.abc import Callable, Collection, Generator, Iterable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ...common.errors import InputError
from ...runtime.system.prepared import PreparedSystem
from ..spec.checks import check_plan, prepare_variants
from ..spec.plan import BatchPlan
from ..trials import Trials
from .decision import Decision
from .manifest.folder import begin, cut, go_on, tidy
from .manifest.gather import gather
from .manifest.manifest import Manifest, read_manifest
from .manifest.restore import restore
from .metadata import campaign_facts
from .results import BatchResult, batch_digest, make_result
from .shards.files import is_flown
from .shards.flights import fly_shards, task_size
from .shards.numbering import Numbering, spans
from .store import FlownRows, HeldShards, StoredShards
from .workers.engines import in_threads
from .workers.progress import flight_progress
from .workers.workers import FlyerPool, worker_count


@dataclass(frozen=True)
class Campaign:
    """A campaign that is ready to fly: every file of it read, in its folder if it has one (absolute).

    ``plan`` is what results tell of, ``flown`` the same with the files that the folder holds; ``named`` is the folder
    as its user names it.
    """

    plan: BatchPlan
    flown: BatchPlan
    systems: Mapping[str, PreparedSystem]
    manifest: Manifest
    folder: Path | None
    named: Path | None = None

    def of_first(self, trials: int) -> Campaign:
        """The campaign of the first trials, which end with a shard; its folder holds no more either."""
        if trials == self.manifest.trials:
            return self
        plan = self.plan.of_first(trials)
        if self.folder is None:
            return replace(self, plan=plan, manifest=replace(self.manifest, trials=trials))
        return replace(self, plan=plan, manifest=cut(self.folder, self.manifest, plan))

    @property
    def provenance(self) -> dict[str, Any]:
        """What its numbers depend on, apart from the trials themselves."""
        return provenance(self.plan, self.systems) | {"manifest": self.manifest.key}

    @property
    def numbering(self) -> Numbering:
        return Numbering(self.manifest.trials, self.manifest.shard_size)

    @cached_property
    def batch(self) -> str:
        """What tells its files from those of others."""
        return batch_digest(self.provenance)

    def store(self) -> HeldShards | StoredShards:
        """Where its shards go."""
        return HeldShards(self.plan) if self.folder is None else StoredShards(self.flown, self.folder, self.batch)

    def shard_rows(self, shard: int) -> Mapping[str, FlownRows]:
        """The trials of one shard that its folder holds, by variant."""
        if self.folder is None:
            raise ValueError("a campaign without a folder holds no shards")
        return StoredShards(self.flown, self.folder, self.batch).rows(self.numbering, range(shard, shard + 1))

    def missing(self) -> list[int]:
        """The shards that its folder does not hold."""
        shards = range(self.numbering.count)
        if self.folder is None:
            return list(shards)
        return [shard for shard in shards if not is_flown(self.folder, self.batch, shard, self.numbering.of(shard))]

    def checked(self, shards: Iterable[int]) -> list[int]:
        """Those of some shards that its folder does not hold. Raises InputError for a number that is none's."""
        wanted = set(shards)
        for shard in sorted(wanted):
            if not 0 <= shard < self.numbering.count:
                raise InputError("shard", str(shard), "no such shard", f"give 0 to {self.numbering.count - 1}")
        return sorted(wanted & set(self.missing()))


# What flies shards of a campaign: each one's trials by variant, as soon as all are there, in any order of shards.
Elsewhere = Callable[[Campaign, Sequence[int]], Generator[tuple[int, dict[str, Trials]]]]


def open_campaign(plan: BatchPlan, output: Path | None, *, resume: bool = False, engine: str | None = None) -> Campaign:
    """Check a plan and write down what it flies. Raises InputError before anything is written or flown.

    With ``output`` a campaign begins in that folder, in place of what is there, or goes on there with ``resume``; what
    flies are the files that the folder then holds, whatever becomes of their originals.
    """
    systems = check_plan(plan)
    in_threads(systems.values(), engine)  # refused before anything is written
    manifest, contents = gather(plan, systems)
    if output is None:
        return Campaign(plan, plan, systems, manifest, None)
    folder = output.absolute()  # FMUs may change the working folder
    manifest = (go_on if resume else begin)(folder, manifest, contents, plan)
    flown = restore(folder, manifest, plan.watch.log)
    plan.__dict__["draws"] = flown.draws  # which lie in the folder, and not in memory
    return Campaign(plan, flown, systems, manifest, folder, output)


def open_folder(folder: Path) -> Campaign:
    """The campaign whose manifest lies in a folder. Raises InputError."""
    named, folder = folder, folder.absolute()
    manifest = read_manifest(folder)
    plan = restore(folder, manifest)  # whose draws were looked at when the folder was made
    return Campaign(plan, plan, prepare_variants(plan), manifest, folder, named)


def run_batch(
    plan: BatchPlan,
    *,
    workers: int | None = None,
    output: Path | None = None,
    resume: bool = False,
    engine: str | None = None,
    elsewhere: Elsewhere | None = None,
) -> BatchResult:
    """Fly every trial of every variant of a plan. Raises InputError before anything flies.

    ``workers`` is the number of parallel flights (default: one per processor), ``engine`` one of `ENGINES` (default:
    threads where the FMUs can fly in them); ``elsewhere`` flies in place of both. With ``output`` every shard is
    written there as soon as it is flown, and the summary at the end: whatever ends it early, ``resume`` goes on from
    there. Without it Ctrl-C leaves nothing.
    """
    worker_count(workers)  # looked at before anything is written
    campaign = open_campaign(plan, output, resume=resume, engine=engine)
    rows = fly_campaign(campaign, campaign.missing(), workers=workers, engine=engine, elsewhere=elsewhere)
    return finish(campaign, rows)


def merge(campaign: Campaign) -> BatchResult:
    """The result of a campaign whose shards all lie in its folder. Raises InputError where some are missing."""
    missing = campaign.missing()
    decision = _decision(campaign, missing)
    if missing and not decision.is_made:
        count = f"{len(missing)} of {campaign.numbering.count} shards are missing"
        remedy = f"perilune shard {campaign.folder} {spans(missing)} flies them"
        raise InputError(str(campaign.folder), f"shards {spans(missing)}", count, remedy)
    return finish(campaign, _rows(campaign, campaign.store(), decision))


def finish(campaign: Campaign, rows: Mapping[str, FlownRows]) -> BatchResult:
    """The result of the first trials, by variant; its summary makes the campaign's folder whole, if it has one."""
    campaign = campaign.of_first(len(next(iter(rows.values()))))
    result = make_result(campaign.plan, rows, campaign.provenance, campaign.named)
    if campaign.folder is not None:
        result.write_summary(campaign.folder)
        tidy(campaign.folder)
    return result


def fly_campaign(
    campaign: Campaign,
    shards: Sequence[int],
    *,
    workers: int | None = None,
    engine: str | None = None,
    elsewhere: Elsewhere | None = None,
) -> Mapping[str, FlownRows]:
    """Fly some shards of a campaign, and write them where it has a folder; all of its trials by variant then.

    Where the campaign ends as soon as it is decided, those behind the shard at whose end it was are missing, however
    many of them have flown.
    """
    store = campaign.store()
    decision = _decision(campaign, campaign.missing())
    flights = sum(len(campaign.numbering.of(shard)) for shard in shards) * len(campaign.plan.campaign.variants())
    if elsewhere is not None:
        flying = elsewhere(campaign, shards)
    else:
        flying = _fly_here(campaign, shards, workers, engine)
    with flight_progress(flights) as progress, closing(flying) as flown:
        for shard, found in () if decision.is_made else flown:
            store.add(shard, found)
            decision.add(shard, found)
            progress.add(found)
            if decision.is_made:
                break
    return _rows(campaign, store, decision)


def _decision(campaign: Campaign, missing: Collection[int]) -> Decision:
    """What the shards decide that lie in a campaign's folder."""
    decision, store, numbering = Decision(campaign.plan), campaign.store(), campaign.numbering
    if campaign.plan.until_decided and isinstance(store, StoredShards):
        for shard in sorted(set(range(numbering.count)) - set(missing)):
            decision.add(shard, store.rows(numbering, range(shard, shard + 1)))
    return decision


def _rows(campaign: Campaign, store: HeldShards | StoredShards, decision: Decision) -> dict[str, FlownRows]:
    """The trials of the shards that decide a campaign, or else of all, by variant."""
    numbering = campaign.numbering
    if decision.shards is not None:
        numbering = replace(numbering, trials=numbering.of(decision.shards - 1).stop)
    return store.rows(numbering)


def _fly_here(
    campaign: Campaign, shards: Sequence[int], workers: int | None, engine: str | None
) -> Generator[tuple[int, dict[str, Trials]]]:
    """Fly shards on this machine, in threads or processes."""
    count = worker_count(workers)
    threads = in_threads(campaign.systems.values(), engine)
    flights = sum(len(campaign.numbering.of(shard)) for shard in shards) * len(campaign.plan.campaign.variants())
    size = task_size(campaign.numbering.trials, count, threads)
    tasks = -(-flights // size)
    with (
        FlyerPool(campaign.flown, min(count, max(tasks, 1)), threads, apart=engine == "processes") as pool,
        closing(fly_shards(campaign.numbering, shards, pool, size)) as flown,
    ):
        yield from flown


def provenance(plan: BatchPlan, systems: Mapping[str, PreparedSystem]) -> dict[str, Any]:
    """What a batch's numbers depend on, apart from the trials themselves."""
    first = next(iter(systems.values()))
    options = plan.options
    assumptions = list(dict.fromkeys(note for prepared in systems.values() for note in prepared.assumptions))
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
        **({"feedthrough": list(options.feedthrough)} if options.feedthrough else {}),
        **({"no_feedthrough": list(options.no_feedthrough)} if options.no_feedthrough else {}),
        **({"assumptions": assumptions} if assumptions else {}),
        **(first.drive.facts() if first.drive is not None else {}),
        **({"timeout": plan.watch.timeout} if plan.watch.timeout is not None else {}),
        "fmus": {
            variant: {name: fmu.digest for name, fmu in prepared.network.fmus.items()}
            for variant, prepared in systems.items()
        },
        "perilune": version("perilune"),
        **campaign_facts(plan, systems),
    }
