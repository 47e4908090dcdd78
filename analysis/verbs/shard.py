"""`perilune.shard`: some shards of a campaign whose folder is prepared; the result says what is missing."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import chdir
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Unpack

from ..campaigns.fly.campaign import open_folder
from ..campaigns.fly.cluster.connection import cluster
from ..campaigns.fly.runner import fly_campaign
from ..campaigns.fly.shards.numbering import numbers_of
from .common.campaign_text import failure_lines, find_failed
from .common.plans import resume_hint
from .options.campaigns import SHARD, ExecutionOptions
from .options.option import FilePath
from .options.verb import verb


@dataclass(frozen=True)
class ShardResult:
    """How many shards were simulated, how many were complete before, and how many of ``count`` are missing."""

    simulated: int
    complete_before: int
    missing: int
    count: int
    failures: tuple[str, ...]

    def to_json(self) -> dict[str, Any]:
        """The numbers of shards."""
        return {
            "simulated": self.simulated,
            "complete_before": self.complete_before,
            "missing": self.missing,
            "count": self.count,
        }

    def lines(self) -> list[str]:
        """What `perilune shard` prints."""
        return [
            f"shards: {self.simulated} simulated, {self.complete_before} already complete, "
            f"{self.missing} of {self.count} missing"
        ]

    def problems(self) -> list[str]:
        """Failed simulations of each variant."""
        return list(self.failures)


@verb(SHARD)
def shard(folder: FilePath, numbers: Sequence[int | str] | int, **options: Unpack[ExecutionOptions]) -> ShardResult:
    """Simulate some shards of a campaign's folder: `perilune shard`. Complete ones stay as they are.

    ``numbers`` are shards, the first is 0, or texts "A-B"; ``scheduler`` is as in `batch`. Raises InputError, for a
    number that is no shard's too.
    """
    shards = [numbers] if isinstance(numbers, int) else numbers_of([str(number) for number in numbers])
    campaign = open_folder(Path(folder))
    wanted = campaign.check_campaign(shards)
    workers, engine = options["workers"], options["engine"]
    with (
        chdir(Path.cwd()),  # an FMU may change the folder
        resume_hint(Path(folder)),
        cluster(options["scheduler"], workers=workers, engine=engine) as elsewhere,
    ):
        fly_campaign(campaign, wanted, workers=workers, engine=engine, elsewhere=elsewhere)
    missing = campaign.missing()
    complete = sorted(set(wanted) - set(missing))
    failures = find_failed(campaign.shard_rows(number) for number in complete)
    return ShardResult(
        len(wanted),
        len(shards) - len(wanted),
        len(missing),
        campaign.numbering.count,
        tuple(failure_lines(failures, campaign.plan, Path(folder))),
    )
