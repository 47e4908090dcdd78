"""Where flown shards go: into a campaign's folder, or into memory where it has none."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Protocol

from ..rows import TrialRows
from ..spec.plan import BatchPlan
from ..trials import Trials, join_trials
from .shards.files import write_shard
from .shards.numbering import Numbering
from .shards.rows import ShardRows


class FlownRows(TrialRows, Protocol):
    """All trials of one variant that have flown."""

    def __len__(self) -> int: ...

    def whole(self) -> Trials:
        """All of them in memory, with their traces."""
        ...


class HeldShards:
    """Shards in memory."""

    def __init__(self, plan: BatchPlan) -> None:
        self._plan = plan
        self._parts: dict[int, Mapping[str, Trials]] = {}

    def add(self, shard: int, trials: Mapping[str, Trials]) -> None:
        """Keep the trials of a shard, by variant."""
        self._parts[shard] = trials

    def rows(self, numbering: Numbering) -> dict[str, FlownRows]:
        """The trials of shards that are all there, by variant."""
        parts = [self._parts[shard] for shard in range(numbering.count)]
        sampled = self._plan.values_of(range(numbering.trials)).table.columns
        return {name: replace(join_trials(part[name] for part in parts), draws=sampled) for name in parts[0]}


class StoredShards:
    """Shards in a folder, each there as soon as it is added; ``batch`` tells the campaign from others."""

    def __init__(self, plan: BatchPlan, folder: Path, batch: str) -> None:
        self._plan = plan
        self._folder = folder
        self._batch = batch

    def add(self, shard: int, trials: Mapping[str, Trials]) -> None:
        """Write the trials of a shard, by variant."""
        write_shard(self._folder, self._batch, shard, self._plan, trials)

    def rows(self, numbering: Numbering, shards: range | None = None) -> dict[str, FlownRows]:
        """The trials of shards that lie there, of all or of some, by variant; they are read when they are asked for."""
        names = [variant.name for variant in self._plan.campaign.variants()]
        some = range(numbering.count) if shards is None else shards
        return {name: ShardRows(self._folder, self._batch, self._plan, name, numbering, some) for name in names}
