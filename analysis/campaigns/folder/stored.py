"""Reader of a complete campaign from the folder that `perilune batch --output` wrote, for comparisons of campaigns."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow

from ....common.errors import InputError
from ..definition.campaign import Metric, TrialGroup, groups_of
from ..definition.expressions import Expression
from ..trials import TrialTable, join_trials
from .campaign_folder import CampaignFolder, Shard
from .campaign_manifest import FILE as MANIFEST
from .campaign_manifest import WRITE
from .provenance import CampaignProvenance
from .shard_files import (
    DRAWS,
    FLIGHT,
    FOLDER,
    NEW_FOLDER,
    NUMBER_PREFIXES,
    SUMMARY,
    check_folders,
    numbers,
    read_table,
    trace_files,
)
from .summary_file import SummaryDocument, read_metrics, read_summary

RESUME = "complete the batch: repeat its command with `resume`"


@dataclass(frozen=True)
class StoredBatch:
    """All trials of a campaign in a folder.

    ``document`` is summary.json. ``draws`` contains columns over trials, and ``variants`` the trials by variant, in
    order and without traces. ``traced`` lists, for each variant, the trials with a trace of this campaign.
    """

    source: CampaignFolder
    document: SummaryDocument
    metrics: tuple[Metric, ...]
    draws: dict[str, np.ndarray]
    variants: dict[str, TrialTable]
    traced: dict[str, list[int]]

    @property
    def folder(self) -> Path:
        return self.source.folder

    @property
    def provenance(self) -> CampaignProvenance:
        """Inputs that determine the campaign's numbers."""
        return self.source.provenance

    @property
    def group(self) -> str | None:
        """Name of the drawn or derived value by which the campaign groups trials, or None."""
        return self.document.get("group")

    @property
    def faults(self) -> list[str]:
        """Simulated faults of the campaign and of the user."""
        return self.document.get("faults", [])

    @property
    def foreign_traces(self) -> int:
        """Number of traces of other campaigns in the folder."""
        there = sum(len(trace_files(self.folder, variant)) for variant in self.variants)
        return there - sum(map(len, self.traced.values()))

    @property
    def has_requirements(self) -> bool:
        """True if the campaign declares requirements."""
        summaries: Any = self.document["variants"]  # as JSON
        return any(entry.get("requirements") for entry in summaries.values())

    def judged_expressions(self) -> list[Expression]:
        """Return the expressions of success and of the requirements."""
        summaries: Any = self.document["variants"]  # as JSON
        required = [
            verdict["text"].rpartition(", ")[0]
            for entry in summaries.values()
            for verdict in entry.get("requirements", {}).values()
        ]
        return [Expression(text) for text in dict.fromkeys([self.document["success"], *required])]

    @cached_property
    def groups(self) -> list[TrialGroup]:
        """Groups of trials; empty unless the campaign declares them. Raises InputError."""
        where = (str(self.folder / "summary.json"), "group")
        if self.group is None:
            return []
        if self.group not in self.draws:
            raise InputError(*where, f"{self.group} is not a column of draws.parquet", NEW_FOLDER)
        return groups_of([self.draws[self.group]], where)

    def trace(self, variant: str, trial: int, names: Collection[str] | None = None) -> dict[str, np.ndarray]:
        """Return the recorded signals of a traced trial with ``time`` (s): the signals in ``names``, by default all."""
        trace = self.source.trace(variant, trial, names)
        assert trace is not None  # it exists unless another campaign has replaced it meanwhile
        return trace


def read_batch(folder: Path) -> StoredBatch:
    """Return the batch in a folder. Raises InputError if files are missing, damaged, or from different batches."""
    for name in (SUMMARY, FOLDER):
        _check_there(folder, name)
    check_folders(folder)
    document = read_summary(folder / SUMMARY)
    source = CampaignFolder.complete(folder, document)
    metrics = read_metrics(document, folder / SUMMARY)
    shards = {shard: source.read(shard) for shard in source.shards}
    columns = _draws(folder, shards, document.get("draw_scheme") == "counter")
    variants = _variants(source, shards, columns)
    _check_summary(document, variants, folder / SUMMARY)
    traced = {variant: list(source.traces(variant)) for variant in variants}
    columns.pop("trial")
    return StoredBatch(source, document, metrics, columns, variants, traced)


def _draws(folder: Path, shards: Mapping[Shard, pyarrow.Table], is_counted: bool) -> dict[str, np.ndarray]:
    """Return the draws of all trials from their table or, without a table, from the first variant in the shards."""
    if not is_counted:
        _check_there(folder, DRAWS)
        sampled = read_table(folder / DRAWS)
        return {name: numbers(sampled, name, folder / DRAWS) for name in sampled.column_names}
    columns: dict[str, list[np.ndarray]] = {}
    for shard, table in shards.items():
        rows = table.slice(0, len(shard.trials))
        for name in rows.column_names:
            if name == "trial" or name.startswith("draw."):
                columns.setdefault(name.removeprefix("draw."), []).append(numbers(rows, name, shard.path))
    return {name: np.concatenate(parts) for name, parts in columns.items()}


def _check_there(folder: Path, name: str) -> None:
    if not (folder / name).exists():
        is_unfinished = (folder / MANIFEST).is_file()
        raise InputError(folder, name, "not found", RESUME if is_unfinished else WRITE)


def _variants(
    source: CampaignFolder, shards: Mapping[Shard, pyarrow.Table], draws: Mapping[str, np.ndarray]
) -> dict[str, TrialTable]:
    """Return the trials by variant, after comparing their draws with draws.parquet."""
    by_variant: dict[str, list[TrialTable]] = {variant: [] for variant in source.variants}
    is_sampled = "trial" in draws and {len(column) for column in draws.values()} == {source.provenance["trials"]}
    for shard, table in shards.items():
        for name in draws:
            if _column(name) not in table.column_names:
                raise InputError(shard.path, _column(name), "no such column", NEW_FOLDER)
        retained = [name for name in table.column_names if name in FLIGHT or name.startswith(NUMBER_PREFIXES)]
        trials, size = table.select(retained), len(shard.trials)
        expected = {_column(name): column[shard.trials.start : shard.trials.stop] for name, column in draws.items()}
        for number, (variant, joined) in enumerate(by_variant.items()):
            rows = TrialTable(trials.slice(number * size, size).combine_chunks())
            is_same = is_sampled and all(np.array_equal(rows.column(name), column) for name, column in expected.items())
            if not is_same:
                raise InputError(shard.path, variant, "its samples differ from draws.parquet", NEW_FOLDER)
            joined.append(rows)
    return {variant: join_trials(joined) for variant, joined in by_variant.items()}


def _column(draw: str) -> str:
    """Return the column of the shards that repeats a column of draws.parquet."""
    return "trial" if draw == "trial" else f"draw.{draw}"


def _check_summary(document: SummaryDocument, variants: Mapping[str, TrialTable], path: Path) -> None:
    """Reject a summary with variants or success rates that differ from the table's."""
    if list(document["variants"]) != list(variants):
        raise InputError(path, "variants", "differ from the variants in trials/", NEW_FOLDER)
    for name, trials in variants.items():
        stated = document["variants"][name]
        rate = stated.get("success_rate") if isinstance(stated, dict) else None
        if rate != int(trials.success.sum()) / len(trials.success):
            raise InputError(
                path, f"variants.{name}", "its success rate differs from the trials in trials/", NEW_FOLDER
            )
