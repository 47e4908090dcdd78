"""Where flown shards go, into a campaign's folder or into memory, and the trials of a variant in them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol

import numpy as np
import pyarrow
import pyarrow.parquet

from ....common.errors import InputError
from ....common.machine.arrow import numpy_of
from ....common.regular import check_regular
from ..definition.plan import BatchPlan
from ..trials import Part, TrialRows, Trials, join_trials
from .shards.files import (
    IDENTITY,
    NEW_FOLDER,
    check_rows,
    describe_columns,
    read_trace,
    shard_path,
    trace_files,
    trace_path,
    trials_of,
    unreadable,
    write_shard,
)
from .shards.numbering import Numbering


@dataclass(frozen=True)
class ShardRows:
    """The trials of one variant in ``shards`` that all lie in a folder, read anew whenever they are asked for.

    ``batch`` is the digest that tells the campaign from others.
    """

    folder: Path
    batch: str
    plan: BatchPlan
    variant: str
    numbering: Numbering
    shards: range

    def __len__(self) -> int:
        return sum(len(self.numbering.of(shard)) for shard in self.shards)

    def parts(self, *names: str) -> Iterator[Part]:
        """Some columns, a shard at a time. Raises InputError for a shard that is damaged."""
        for shard in self.shards:
            table = self._table(shard, list(names))
            yield {name: numpy_of(table[name]) for name in names}

    def whole(self) -> Trials:
        flown: list[Trials] = []
        for shard in self.shards:
            part = self._trials(shard)
            different = set(part.final) ^ set(flown[0].final) if flown else ()
            if different:
                path, name = shard_path(self.folder, shard), f"final.{min(different)}"
                raise InputError(path, name, "not a column of all shards", NEW_FOLDER)
            flown.append(part)
        return join_trials(flown)

    def traced(self) -> list[int]:
        flown = range(self.numbering.of(self.shards.start).start, self.numbering.of(self.shards.stop - 1).stop)
        return [trial for trial in trace_files(self.folder, self.variant) if trial in flown]

    def trace(self, trial: int, names: Collection[str] | None = None) -> dict[str, np.ndarray] | None:
        path = trace_path(self.folder, self.variant, trial)
        is_own = describe_columns(path) == {"batch": self.batch, "variant": self.variant, "trial": trial}
        return read_trace(path, names) if is_own else None

    def _table(self, shard: int, names: list[str] | None = None) -> pyarrow.Table:
        path = shard_path(self.folder, shard)
        group = [variant.name for variant in self.plan.campaign.variants()].index(self.variant)
        check_regular(path, NEW_FOLDER)
        try:
            with pyarrow.parquet.ParquetFile(path, page_checksum_verification=True) as file:
                table = file.read_row_group(group, None if names is None else list(dict.fromkeys([*names, *IDENTITY])))
        except (OSError, ValueError, IndexError, pyarrow.ArrowException) as error:
            raise unreadable(path, error) from error
        check_rows(table, self.variant, self.numbering.of(shard), names, path)
        return table

    def _trials(self, shard: int) -> Trials:
        path = shard_path(self.folder, shard)
        metrics = [metric.name for metric in self.plan.campaign.metrics]
        trials = trials_of(self._table(shard), metrics, path)[self.variant]
        for trial in trials.trial.tolist():
            if (trace := self.trace(trial)) is not None:
                trials.traces[trial] = trace
        return trials


class FlownRows(TrialRows, Protocol):
    """All trials of one variant that have flown."""

    def __len__(self) -> int: ...

    def whole(self) -> Trials:
        """All of them in memory, with their traces."""
        ...

    def traced(self) -> list[int]:
        """The trials with the file of a trace, in order, which may be another batch's."""
        ...

    def trace(self, trial: int, names: Collection[str]) -> dict[str, np.ndarray] | None:
        """What a trial has recorded of these signals, and ``time`` (s); None without a trace of this batch.

        Raises InputError for one that is damaged.
        """
        ...


class HeldShards:
    """Shards in memory."""

    def __init__(self, plan: BatchPlan) -> None:
        self._plan = plan
        self._parts: dict[int, Mapping[str, Trials]] = {}

    def add(self, shard: int, trials: Mapping[str, Trials]) -> None:
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
        write_shard(self._folder, self._batch, shard, self._plan, trials)

    def rows(self, numbering: Numbering, shards: range | None = None) -> dict[str, FlownRows]:
        """The trials of shards that lie there, of all or of some, by variant; they are read when they are asked for."""
        names = [variant.name for variant in self._plan.campaign.variants()]
        some = range(numbering.count) if shards is None else shards
        return {name: ShardRows(self._folder, self._batch, self._plan, name, numbering, some) for name in names}
