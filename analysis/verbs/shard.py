"""A campaign in shards: `prepare` writes its folder, `shard` simulates some shards, `merge` combines them."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path
from typing import Unpack

from ...common.errors import InputError
from ...common.targets import check_folder
from ..campaigns.execute.cluster.connection import cluster
from ..campaigns.execute.loaded_campaign import open_campaign, open_folder
from ..campaigns.execute.runner import fly_campaign, merge_rows
from ..campaigns.folder.numbering import parse_shards
from ..campaigns.summary_text import select_metrics
from ..documents.model import Document
from ..documents.of.batch.printed import failure_lines, find_failed
from ..documents.of.campaign_folders import prepared_document, shards_document
from ..options.declared.campaigns import MERGE, PREPARE, SHARD, MergeOptions, PrepareOptions, ShardOptions
from ..options.option import FilePath
from ..options.verb import verb
from ..runtime.system.options import select_permissions
from .batch import BatchResult
from .common.campaign_options import campaign_requirements, read_campaign, resume_hint, warn_of_foreign_fmus
from .common.documented import Documented


@dataclass(frozen=True)
class PreparedCampaign(Documented):
    """A campaign's ``folder`` with ``shards`` of ``shard_size`` trials each; the last shard may be smaller."""

    folder: Path
    shards: int
    shard_size: int

    def document(self) -> Document:
        """Return a document with the folder and the commands that simulate and merge its shards."""
        return prepared_document(**vars(self))


@verb(PREPARE)
def prepare(
    system: FilePath, campaign: FilePath, output: FilePath, **options: Unpack[PrepareOptions]
) -> PreparedCampaign:
    """Write a campaign to the folder ``output`` without simulating it: `perilune prepare`.

    `shard` simulates its shards on any machine that has the folder, and `merge` combines them. Options are as in
    `batch`. Raises InputError.
    """
    folder = Path(output)
    if options["resume"] and options["overwrite"]:
        raise InputError(
            "`resume`",
            "`overwrite`",
            "one keeps the stored results, the other overwrites them",
            "leave out `resume` or `overwrite`",
        )
    is_kept = options["overwrite"] or options["resume"]
    check_folder("`output`", folder, overwrite=is_kept, otherwise="`resume` or `overwrite`")
    with chdir(Path.cwd()):  # an FMU may change the folder
        plan = read_campaign(system, campaign, options)
        opened = open_campaign(plan, folder, resume=options["resume"], elsewhere="shards")
    return PreparedCampaign(folder, opened.numbering.count, opened.numbering.size)


@dataclass(frozen=True)
class ShardResult(Documented):
    """Numbers of shards simulated now, complete before and still missing, out of ``count``."""

    simulated: int
    complete_before: int
    missing: int
    count: int
    failures: tuple[str, ...]

    def document(self) -> Document:
        """Return a document with the numbers of shards."""
        return shards_document(self.simulated, self.complete_before, self.missing, self.count)

    def problems(self) -> list[str]:
        """Return a line for each variant with failed simulations."""
        return list(self.failures)


@verb(SHARD)
def shard(folder: FilePath, numbers: Sequence[int | str] | int, **options: Unpack[ShardOptions]) -> ShardResult:
    """Simulate some shards of a campaign's folder, except complete ones: `perilune shard`.

    ``numbers`` is the number of a shard, from 0, or a list of numbers and texts "A-B". ``scheduler`` and
    ``retry_crashed`` are as in `batch`. Raises InputError, also for an unknown number.
    """
    if isinstance(numbers, str):
        raise InputError("shard", numbers, "a text, not a list of shards", f"give [{numbers!r}]")
    shards = [numbers] if isinstance(numbers, int) else parse_shards([str(number) for number in numbers])
    campaign = open_folder(Path(folder), select_permissions(options))
    warn_of_foreign_fmus(campaign)
    if options["retry_crashed"]:
        campaign.discard_lost(shards)
    incomplete = campaign.check_campaign(shards)
    workers, engine = options["workers"], options["engine"]
    with (
        chdir(Path.cwd()),  # an FMU may change the folder
        resume_hint(Path(folder)),
        cluster(options["scheduler"], workers=workers, engine=engine) as elsewhere,
    ):
        fly_campaign(campaign, incomplete, workers=workers, engine=engine, elsewhere=elsewhere)
    missing = campaign.missing()
    complete = sorted(set(incomplete) - set(missing))
    failures = find_failed(campaign.shard_rows(number) for number in complete)
    return ShardResult(
        len(incomplete),
        len(shards) - len(incomplete),
        len(missing),
        campaign.numbering.count,
        tuple(failure_lines(failures, campaign.plan, Path(folder))),
    )


@verb(MERGE)
def merge(folder: FilePath, **options: Unpack[MergeOptions]) -> BatchResult:
    """Merge the shards of a campaign's folder: `perilune merge`. Raises InputError if shards are missing."""
    with chdir(Path.cwd()), resume_hint(Path(folder)):
        campaign = open_folder(Path(folder))
        requirements = campaign_requirements(campaign.plan, options["require"])
        displayed = tuple(options["metrics"])
        select_metrics(displayed, [metric.name for metric in campaign.plan.campaign.metrics], ())
        rows = merge_rows(campaign)
        return BatchResult.finish(campaign, rows, requirements=tuple(requirements), displayed=displayed)
