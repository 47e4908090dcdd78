"""The trials of a variant in the shards of a folder, of which no more than one is held."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import pyarrow
import pyarrow.parquet

from ...rows import Part
from ...spec.plan import BatchPlan
from ...trials import Trials, join_trials
from .arrow import numpy_of
from .files import describe_columns, shard_path, trace_path, unreadable
from .numbering import Numbering
from .reading import numbers, read_table, trials_of


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
        """All of them in memory, with their traces. Raises InputError."""
        return join_trials(self._trials(shard) for shard in self.shards)

    def _table(self, shard: int, names: list[str] | None = None) -> pyarrow.Table:
        path = shard_path(self.folder, shard)
        place = [variant.name for variant in self.plan.campaign.variants()].index(self.variant)
        try:
            with pyarrow.parquet.ParquetFile(path, page_checksum_verification=True) as file:
                return file.read_row_group(place, names)
        except (OSError, pyarrow.ArrowException) as error:
            raise unreadable(path, error) from error

    def _trials(self, shard: int) -> Trials:
        path = shard_path(self.folder, shard)
        metrics = [metric.name for metric in self.plan.campaign.metrics]
        trials = trials_of(self._table(shard), metrics, path)[self.variant]
        for trial in trials.trial.tolist():
            place = trace_path(self.folder, self.variant, trial)
            if describe_columns(place) == {"batch": self.batch, "variant": self.variant, "trial": trial}:
                table = read_table(place)
                trials.traces[trial] = {name: numbers(table, name, place) for name in table.column_names}
        return trials
