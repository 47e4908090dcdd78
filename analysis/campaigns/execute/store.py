"""Where the shards of a campaign go, into its folder or into memory, and the trials of a variant in them."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path

import pyarrow
import pyarrow.parquet

from ....common.errors import InputError
from ....common.regular import check_regular
from ..definition.plan import BatchPlan
from ..trials import Trace, TrialTable, join_trials
from .shards.files import (
    IDENTITY,
    NEW_FOLDER,
    check_rows,
    describe_columns,
    read_trace,
    shard_path,
    trace_files,
    trace_path,
    unreadable,
    with_draws,
    write_shard,
)
from .shards.numbering import Numbering


class ShardTable(TrialTable):
    """The trials of one variant in ``shards`` that all lie in a folder, read whenever they are needed.

    ``batch`` is the digest that tells the campaign from others.
    """

    def __init__(
        self, folder: Path, batch: str, plan: BatchPlan, variant: str, numbering: Numbering, shards: range
    ) -> None:
        self._folder, self._batch, self._variant = folder, batch, variant
        self._group = [each.name for each in plan.campaign.variants()].index(variant)
        self._metrics = [f"metric.{metric.name}" for metric in plan.campaign.metrics]
        self._numbering, self._shards = numbering, shards

    def __len__(self) -> int:
        return sum(len(self._numbering.of(shard)) for shard in self._shards)

    @property
    def _schema(self) -> pyarrow.Schema:
        """The columns of the first shard. Raises InputError where it lacks one."""
        path = shard_path(self._folder, self._shards.start)
        check_regular(path, NEW_FOLDER)
        try:
            schema = pyarrow.parquet.read_schema(path)
        except (OSError, ValueError, pyarrow.ArrowException) as error:
            raise unreadable(path, error) from error
        for name in ("variant", *self._metrics):
            if name not in schema.names:
                raise InputError(path, name, "no such column", NEW_FOLDER)
        return schema.remove(schema.names.index("variant"))

    @property
    def table(self) -> pyarrow.Table:
        """All columns in memory. Raises InputError for a shard that is damaged, or has other columns than the first."""
        tables: list[pyarrow.Table] = []
        for shard in self._shards:
            table = self._read(shard, None).drop_columns(["variant"])
            expected = {*self._metrics, *(tables[0].column_names if tables else ())}
            for name in sorted(expected - set(table.column_names)):
                raise InputError(shard_path(self._folder, shard), name, "no such column", NEW_FOLDER)
            for name in sorted(set(table.column_names) - expected if tables else ()):
                raise InputError(shard_path(self._folder, shard), name, "not a column of all shards", NEW_FOLDER)
            tables.append(table)
        return pyarrow.concat_tables(tables, promote_options="permissive").combine_chunks()

    def tables(self, names: Sequence[str]) -> Iterator[pyarrow.Table]:
        """Some columns, a shard at a time. Raises InputError for a shard that is damaged."""
        for shard in self._shards:
            yield self._read(shard, names).select(names)

    def traced(self) -> list[int]:
        first, last = (self._numbering.of(shard) for shard in (self._shards.start, self._shards.stop - 1))
        flown = range(first.start, last.stop)
        return [trial for trial in trace_files(self._folder, self._variant) if trial in flown]

    @property
    def traces(self) -> dict[int, Trace]:
        read = {trial: self.trace(trial) for trial in self.traced()}
        return {trial: trace for trial, trace in read.items() if trace is not None}

    def trace(self, trial: int, names: Collection[str] | None = None) -> Trace | None:
        path = trace_path(self._folder, self._variant, trial)
        is_own = describe_columns(path) == {"batch": self._batch, "variant": self._variant, "trial": trial}
        return read_trace(path, names) if is_own else None

    def whole(self) -> TrialTable:
        return self._like(self.table, self.traces)

    def _read(self, shard: int, names: Sequence[str] | None) -> pyarrow.Table:
        """Some columns of a shard, or all, and those that identify trials, its rows checked."""
        path = shard_path(self._folder, shard)
        check_regular(path, NEW_FOLDER)
        needed = None if names is None else list(dict.fromkeys([*names, *IDENTITY]))
        try:
            with pyarrow.parquet.ParquetFile(path, page_checksum_verification=True) as file:
                table = file.read_row_group(self._group, needed)
        except (OSError, ValueError, IndexError, pyarrow.ArrowException) as error:
            raise unreadable(path, error) from error
        check_rows(table, self._variant, self._numbering.of(shard), names, path)
        return table


class ShardStore:
    """The shards of a campaign, in memory where ``folder`` is None, else there as soon as they are added.

    ``batch`` tells the campaign from others.
    """

    def __init__(self, plan: BatchPlan, folder: Path | None, batch: str) -> None:
        self._plan, self._folder, self._batch = plan, folder, batch
        self._flown: dict[int, Mapping[str, TrialTable]] = {}

    def add(self, shard: int, trials: Mapping[str, TrialTable]) -> None:
        """Keep the trials of a shard by variant."""
        if self._folder is None:
            self._flown[shard] = trials
        else:
            write_shard(self._folder, self._batch, shard, self._plan, trials)

    def rows(self, numbering: Numbering, shards: range | None = None) -> dict[str, TrialTable]:
        """The trials of shards that are all there, of all or of some, by variant."""
        some = range(numbering.count) if shards is None else shards
        names = [variant.name for variant in self._plan.campaign.variants()]
        if self._folder is not None:
            folder, batch, plan = self._folder, self._batch, self._plan
            return {name: ShardTable(folder, batch, plan, name, numbering, some) for name in names}
        flown = {name: join_trials(self._flown[shard][name] for shard in some) for name in names}
        numbers = range(numbering.of(some.start).start, numbering.of(some.stop - 1).stop)
        sampled = self._plan.values_of(numbers)
        return {name: with_draws(trials, sampled) for name, trials in flown.items()}
