"""Storage of a campaign's shards, in its folder or in memory, and the table of a variant's trials in them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

import pyarrow
import pyarrow.parquet

from ....common.errors import InputError
from ..definition.plan import BatchPlan
from ..folder.campaign_folder import CampaignFolder, Shard
from ..folder.numbering import Numbering
from ..folder.shard_files import NEW_FOLDER, shard_path, trace_files, with_draws
from ..trials import Trace, TrialTable, join_trials


class ShardTable(TrialTable):
    """Trials of one variant in stored ``shards``, read on demand."""

    def __init__(self, stored: CampaignFolder, variant: str, shards: Sequence[Shard]) -> None:
        self._stored, self._variant, self._shards = stored, variant, shards

    def __len__(self) -> int:
        return sum(len(shard.trials) for shard in self._shards)

    @property
    def _schema(self) -> pyarrow.Schema:
        """Columns of the first shard. Raises InputError if a column is missing."""
        schema = self._stored.schema(self._shards[0])
        return schema.remove(schema.names.index("variant"))

    @property
    def table(self) -> pyarrow.Table:
        """All columns in memory.

        Raises InputError for a shard that is damaged, or has other columns than the first shard.
        """
        tables: list[pyarrow.Table] = []
        for shard in self._shards:
            table = self._read(shard, None).drop_columns(["variant"])
            expected = set(tables[0].column_names if tables else table.column_names)
            for name in sorted(expected - set(table.column_names)):
                raise InputError(shard.path, name, "no such column", NEW_FOLDER)
            for name in sorted(set(table.column_names) - expected):
                raise InputError(shard.path, name, "other shards do not have this column", NEW_FOLDER)
            tables.append(table)
        return pyarrow.concat_tables(tables, promote_options="permissive").combine_chunks()

    def tables(self, names: Sequence[str]) -> Iterator[pyarrow.Table]:
        """Yield some columns, shard by shard. Raises InputError for a damaged shard."""
        for shard in self._shards:
            yield self._read(shard, names).select(names)

    def traced(self) -> list[int]:
        flown = range(self._shards[0].trials.start, self._shards[-1].trials.stop)
        return [trial for trial in trace_files(self._stored.folder, self._variant) if trial in flown]

    @property
    def traces(self) -> dict[int, Trace]:
        read = {trial: self.trace(trial) for trial in self.traced()}
        return {trial: trace for trial, trace in read.items() if trace is not None}

    def trace(self, trial: int, names: Collection[str] | None = None) -> Trace | None:
        return self._stored.trace(self._variant, trial, names)

    def whole(self) -> TrialTable:
        return self._like(self.table, self.traces)

    def _read(self, shard: Shard, names: Sequence[str] | None) -> pyarrow.Table:
        return self._stored.read(shard, names, self._variant)


class ShardStore:
    """Shards of a campaign, in memory if ``stored`` is None, else written to its folder when they are added."""

    def __init__(self, plan: BatchPlan, stored: CampaignFolder | None) -> None:
        self._plan, self._stored = plan, stored
        self._flown: dict[int, Mapping[str, TrialTable]] = {}

    def add(self, shard: int, trials: Mapping[str, TrialTable]) -> None:
        """Store the trials of a shard by variant."""
        if self._stored is None:
            self._flown[shard] = trials
        else:
            self._stored.write(shard, self._plan, trials)

    def rows(self, numbering: Numbering, shards: range | None = None) -> dict[str, TrialTable]:
        """Return the trials of all shards, or of some, by variant; these shards must be present."""
        some = range(numbering.count) if shards is None else shards
        if self._stored is not None:
            files = [Shard(shard_path(self._stored.folder, shard), numbering.of(shard)) for shard in some]
            return {name: ShardTable(self._stored, name, files) for name in self._stored.variants}
        flown = {name: join_trials(self._flown[shard][name] for shard in some) for name in self._flown[some.start]}
        numbers = range(numbering.of(some.start).start, numbering.of(some.stop - 1).stop)
        sampled = self._plan.values_of(numbers)
        return {name: with_draws(trials, sampled) for name, trials in flown.items()}
