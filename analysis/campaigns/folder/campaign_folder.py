"""Folder of a campaign, complete or still being written: its identity, and its shards, which are checked when read."""

from __future__ import annotations

import itertools
import os
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pyarrow

from ....common.bounds import TRIALS
from ....common.errors import InputError
from ....common.machine.arrow import table_of
from ..definition.plan import BatchPlan
from ..trials import Trace, TrialTable
from .campaign_manifest import FILE as MANIFEST
from .provenance import CampaignProvenance, batch_digest
from .shard_files import (
    COLUMNS,
    FOLDER,
    IDENTITY,
    NEW_FOLDER,
    SUMMARY,
    check_columns,
    describe,
    describe_columns,
    numbers,
    read_metadata,
    read_schema,
    read_table,
    read_trace,
    shard_path,
    trace_files,
    trace_path,
    trial_table,
    write_parquet,
)
from .summary_file import SummaryDocument, without_summary


class Shard(NamedTuple):
    """File of a shard, and the trials of each variant in it."""

    path: Path
    trials: range


@dataclass(frozen=True)
class CampaignFolder:
    """Campaign in a folder, as of the time when it was opened.

    ``provenance`` contains the inputs that determine its numbers; ``summary`` is summary.json, or None while trials are
    missing.
    """

    folder: Path
    provenance: CampaignProvenance
    summary: SummaryDocument | None = None

    @classmethod
    def complete(cls, folder: Path, summary: SummaryDocument) -> CampaignFolder:
        """Return the folder of a complete campaign."""
        return cls(folder, without_summary(summary), summary)

    @property
    def is_complete(self) -> bool:
        return self.summary is not None

    @property
    def variants(self) -> list[str]:
        return list(self.provenance["fmus"])

    @cached_property
    def batch(self) -> str:
        """Digest that identifies the campaign's files."""
        return batch_digest(self.provenance)

    @cached_property
    def shards(self) -> tuple[Shard, ...]:
        """Stored shards in order, at least one.

        Raises InputError for a shard that is damaged or belongs to another campaign, for missing shards of a complete
        campaign, and if there are no shards.
        """
        shards = tuple(self._all_shards() if self.is_complete else map(self._find, self._paths))
        if not shards:
            raise InputError(self.folder, FOLDER, "no shard is complete yet", "open it again when a shard is complete")
        return shards

    @property
    def flown(self) -> int:
        """Number of stored trials of each variant."""
        return sum(len(shard.trials) for shard in self.shards) if self._paths else 0

    @cached_property
    def _paths(self) -> list[Path]:
        """Files of all shards, of any campaign."""
        return sorted(path for path in (self.folder / FOLDER).glob("*.parquet") if path.stem.isdecimal())

    def _all_shards(self) -> Iterator[Shard]:
        """Yield all shards, which contain every trial once; ignore further shards of a longer campaign."""
        end = 0
        for number in itertools.count():
            if end == self.provenance["trials"]:
                break
            path = shard_path(self.folder, number)
            if not os.path.lexists(path):
                raise InputError(path, "", f"not found; the trials from {end} on are missing", NEW_FOLDER)
            shard = self._find(path)
            if shard.trials.start != end:
                raise InputError(path, "", f"begins with trial {shard.trials.start}, not {end}", NEW_FOLDER)
            yield shard
            end = shard.trials.stop

    def _find(self, path: Path) -> Shard:
        return Shard(path, self._trials_in(path, describe_columns(path), SUMMARY if self.is_complete else MANIFEST))

    def _trials_in(self, path: Path, about: object, whose: str) -> range:
        """Return the trials in a shard's file from its metadata ``about``, as returned by `_about`.

        Raises InputError if the file has the name of another shard, or belongs to another batch than the file
        ``whose``.
        """
        if not isinstance(about, dict) or about.get("batch") != self.batch:
            raise InputError(path, "", f"belongs to another batch than {whose}", NEW_FOLDER)
        if about.get("shard") != int(path.stem):
            raise InputError(path, "", "its metadata states another shard than its name", NEW_FOLDER)
        match about.get("trials"):
            case [int(first), int(stop)] if 0 <= first < stop <= TRIALS.limit:
                return range(first, stop)
        raise InputError(path, "trials", "does not state a valid range of trials", NEW_FOLDER)

    def _about(self, number: int, trials: range) -> dict[str, object]:
        return {"batch": self.batch, "shard": number, "trials": [trials.start, trials.stop]}

    def _about_trace(self, variant: str, trial: int) -> dict[str, object]:
        return {"batch": self.batch, "variant": variant, "trial": trial}

    def has(self, number: int, trials: range) -> bool:
        """Return True if the campaign's shard with these trials is stored. Raises InputError for a damaged shard."""
        return describe_columns(shard_path(self.folder, number)) == self._about(number, trials)

    def write(self, number: int, plan: BatchPlan, trials: Mapping[str, TrialTable]) -> None:
        """Write the traces of a shard, then its table of ``trials`` by variant, which marks the shard as complete."""
        for variant, rows in trials.items():
            for trial, trace in rows.traces.items():
                table = describe(table_of(trace), self._about_trace(variant, trial))
                write_parquet(table, trace_path(self.folder, variant, trial))
        flown = next(iter(trials.values())).trial
        about = self._about(number, range(int(flown[0]), int(flown[-1]) + 1))
        table = describe(trial_table(plan, trials), about)
        write_parquet(table, shard_path(self.folder, number), len(flown))  # with a row group for each variant

    def read(self, shard: Shard, names: Collection[str] | None = None, variant: str | None = None) -> pyarrow.Table:
        """Return columns of a shard (default: all) and the columns that identify its rows, of one variant or of all.

        Raises InputError if the file is damaged, if a column is missing or has another type, and if the rows are not
        the shard's trials in order.
        """
        path, size = shard.path, len(shard.trials)
        group = None if variant is None else self.variants.index(variant)
        table = read_table(path, names if names is None else {*names, *IDENTITY}, group)
        if self._trials_in(path, read_metadata(table.schema), "the campaign that was opened") != shard.trials:
            raise InputError(path, "trials", "changed since the campaign was opened", "run the command again")
        whole = (*COLUMNS, *(f"metric.{name}" for name in self.provenance["metrics"]))
        check_columns(table, whole if names is None else names, path)
        variants = self.variants if variant is None else [variant]
        if table.num_rows != size * len(variants) and variant is None:
            problem = f"{table.num_rows} rows, not {size} for each of {len(variants)} variants"
            raise InputError(path, "", problem, NEW_FOLDER)
        for number, name in enumerate(variants):
            _check_rows(table.slice(number * size, size), name, shard.trials, path)
        return table

    def schema(self, shard: Shard) -> pyarrow.Schema:
        """Return the columns of a shard. Raises InputError if a variant or metric is missing or unknown."""
        schema = read_schema(shard.path)
        metrics = [f"metric.{name}" for name in self.provenance["metrics"]]
        for name in ("variant", *metrics):
            if name not in schema.names:
                raise InputError(shard.path, name, "no such column", NEW_FOLDER)
        for name in schema.names:
            if name.startswith("metric.") and name not in metrics:
                raise InputError(shard.path, name, "not a metric of the campaign", NEW_FOLDER)
        return schema

    def traces(self, variant: str) -> dict[int, Path]:
        """Return the trace files of a variant by trial, without traces of other campaigns.

        Raises InputError for a damaged file.
        """
        return {
            trial: path
            for trial, path in trace_files(self.folder, variant).items()
            if describe_columns(path) == self._about_trace(variant, trial)
        }

    def trace(self, variant: str, trial: int, names: Collection[str] | None = None) -> Trace | None:
        """Return a trial's trace of these signals (default: all) and ``time`` (s), or None if it has no trace.

        Raises InputError for a damaged trace.
        """
        path = trace_path(self.folder, variant, trial)
        return read_trace(path, names) if describe_columns(path) == self._about_trace(variant, trial) else None


def _check_rows(table: pyarrow.Table, variant: str, trials: range, path: Path) -> None:
    """Reject rows that are not the trials of a variant in order. Raises InputError."""
    if not np.array_equal(numbers(table, "trial", path), np.arange(trials.start, trials.stop)):
        problem = f"the rows are not the trials {trials.start} to {trials.stop - 1} of {variant} in ascending order"
        raise InputError(path, "trial", problem, NEW_FOLDER)
    if set(table["variant"].unique().to_pylist()) != {variant}:
        raise InputError(path, "variant", f"contains rows of a variant other than {variant}", NEW_FOLDER)
