"""A batch read back from the folder that `perilune batch --output` wrote, every file checked against the others."""

from __future__ import annotations

import itertools
import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.compute

from ....common.bounds import INPUT_BYTES
from ....common.errors import InputError
from ....common.machine.arrow import numpy_of
from ....common.regular import read_regular
from ..columns import describe_metric
from ..definition.campaign import Group, Metric, groups_of
from ..definition.expressions import Expression
from ..execute.manifest import FILE as MANIFEST
from ..execute.manifest import WRITE
from ..execute.metadata import Provenance, batch_digest
from ..execute.shards.files import (
    COLUMNS,
    DRAWS,
    FLIGHT,
    FOLDER,
    NEW_FOLDER,
    NUMBER_PREFIXES,
    SUMMARY,
    TEXTS,
    about_of,
    check_texts,
    list_traces,
    numbers,
    read_table,
    read_trace,
    shard_path,
    trace_path,
    trials_in,
)
from ..trials import TrialTable, join_trials

RESUME = "resume it: the batch's command with `resume`"


class SummaryDocument(Provenance, total=False):
    """summary.json: the provenance, and the summary by variant."""

    variants: Mapping[str, object]


FACTS = (
    "system", "system_sha256", "campaign", "campaign_sha256", "parameter_sets", "set", "variant", "trials", "seed",
    "step", "algorithm", "fmus", "perilune", "description", "success", "metrics", "record", "signals", "targets",
)  # fmt: skip


@dataclass(frozen=True)
class StoredBatch:
    """A batch on disk.

    ``document`` is summary.json. ``draws`` are columns over trials, ``variants`` the trials by
    variant (in order of trial, without traces), ``traced`` the trials of each that have a trace of
    this batch, and ``strangers`` the number of traces of other batches in the folder.
    """

    folder: Path
    document: SummaryDocument
    metrics: tuple[Metric, ...]
    draws: dict[str, np.ndarray]
    variants: dict[str, TrialTable]
    traced: dict[str, list[int]]
    strangers: int

    @property
    def provenance(self) -> Provenance:
        """What the batch's numbers depend on."""
        return without_summary(self.document)

    @property
    def group(self) -> str | None:
        """The drawn or derived value that the campaign groups trials by, if it does."""
        return self.document.get("group")

    @property
    def faults(self) -> list[str]:
        """The faults that flew, the campaign's and the user's."""
        return self.document.get("faults", [])

    def judged_names(self) -> set[str]:
        """Return the names in success and requirements."""
        summaries: Any = self.document["variants"]  # as JSON
        required = {
            verdict["text"].rpartition(", ")[0]
            for entry in summaries.values()
            for verdict in entry.get("requirements", {}).values()
        }
        texts = [self.document["success"], *required]
        return set().union(*(Expression(text).names for text in texts))

    @cached_property
    def groups(self) -> list[Group]:
        """The groups of trials; none where the campaign does not ask for them. Raises InputError."""
        where = (str(self.folder / "summary.json"), "group")
        if self.group is None:
            return []
        if self.group not in self.draws:
            raise InputError(*where, f"{self.group} is not a column of draws.parquet", NEW_FOLDER)
        return groups_of([self.draws[self.group]], where)

    def trace(self, variant: str, trial: int, names: Collection[str] | None = None) -> dict[str, np.ndarray]:
        """The kept signals of one flight, ``time`` (s) among them; of ``names`` those that there are, or all."""
        return read_trace(trace_path(self.folder, variant, trial), names)


def read_batch(folder: Path) -> StoredBatch:
    """The batch in a folder. Raises InputError for what is missing, damaged, or of two batches."""
    for name in (SUMMARY, FOLDER):
        _check_there(folder, name)
    document = read_summary(folder / SUMMARY)
    batch = batch_digest(without_summary(document))
    shards = _read_shards(folder, batch, document["trials"])
    metrics = _metrics(document, folder / SUMMARY)
    columns = _draws(folder, shards, document.get("draw_scheme") == "counter")
    variants = _variants(shards, document["trials"], metrics, columns)
    _check_summary(document, variants, folder / SUMMARY)
    traced, strangers = _list_traces(folder, list(variants), batch)
    columns.pop("trial")
    return StoredBatch(folder, document, metrics, columns, variants, traced, strangers)


def _draws(folder: Path, shards: Mapping[Path, pyarrow.Table], is_counted: bool) -> dict[str, np.ndarray]:
    """The draws of all trials: of their table or, where they were drawn without one, of the shards' first variant."""
    if not is_counted:
        _check_there(folder, DRAWS)
        sampled = read_table(folder / DRAWS)
        return {name: numbers(sampled, name, folder / DRAWS) for name in sampled.column_names}
    columns: dict[str, list[np.ndarray]] = {}
    for path, table in shards.items():
        first = pyarrow.compute.equal(table["variant"], table["variant"][0])
        rows = table.filter(first)
        for name in rows.column_names:
            if name == "trial" or name.startswith("draw."):
                columns.setdefault(name.removeprefix("draw."), []).append(numbers(rows, name, path))
    return {name: np.concatenate(parts) for name, parts in columns.items()}


def _check_there(folder: Path, name: str) -> None:
    if not (folder / name).exists():
        is_unfinished = (folder / MANIFEST).is_file()
        raise InputError(folder, name, "not found", RESUME if is_unfinished else WRITE)


def _read_shards(folder: Path, batch: str, trials: int) -> dict[Path, pyarrow.Table]:
    """All shards in order of number, which together hold every trial once."""
    tables: dict[Path, pyarrow.Table] = {}
    end = 0
    for shard in itertools.count():
        if end == trials:
            break
        path = shard_path(folder, shard)
        if not path.is_file():
            raise InputError(path, "", f"not found: trials from {end} on are missing", NEW_FOLDER)
        table = read_table(path)
        there = trials_in(path, about_of(table.schema), batch, SUMMARY)
        if there.start != end:
            raise InputError(path, "", f"begins with trial {there.start}, not {end}", NEW_FOLDER)
        tables[path] = table
        end = there.stop
    return tables


def without_summary(document: SummaryDocument) -> Provenance:
    """summary.json without the summary: what the batch's numbers depend on."""
    entries = document.copy()
    del entries["variants"]
    return entries


def read_summary(path: Path) -> SummaryDocument:
    """The content of summary.json. Raises InputError for what is none, or of an older version."""
    content = read_regular(path, NEW_FOLDER, INPUT_BYTES.limit)
    try:
        document = json.loads(content)
    except (ValueError, RecursionError) as error:
        raise InputError(path, "", f"not JSON: {error}", NEW_FOLDER) from error
    variants = document.get("variants") if isinstance(document, dict) else None
    if not isinstance(variants, dict) or not variants:
        raise InputError(path, "variants", "missing", WRITE)
    for key in FACTS:
        if key not in document:
            raise InputError(path, key, "missing, as in results of an older version", "fly the batch again")
    return document


def _metrics(document: SummaryDocument, path: Path) -> tuple[Metric, ...]:
    try:
        return tuple(
            Metric(
                name=name,
                expression=Expression(fact["expression"], (str(path), f"metrics.{name}.expression")),
                reduction=fact["reduction"],
                unit=fact["unit"],
                description=describe_metric(fact),
                condition=Expression(fact["condition"], (str(path), f"metrics.{name}.condition"))
                if "condition" in fact
                else None,
                delay=fact.get("delay", 0.0),
            )
            for name, fact in document["metrics"].items()
        )
    except (AttributeError, KeyError, TypeError) as error:
        raise InputError(path, "metrics", "not as perilune batch writes them", NEW_FOLDER) from error


def _variants(
    shards: Mapping[Path, pyarrow.Table], total: int, metrics: tuple[Metric, ...], draws: Mapping[str, np.ndarray]
) -> dict[str, TrialTable]:
    """The trials by variant, ``total`` of each, with the draws that draws.parquet has of them."""
    parts: dict[str, list[TrialTable]] = {}
    rows_drawn = {len(column) for column in draws.values()}
    for path, table in shards.items():
        for name in draws:
            if _column(name) not in table.column_names:
                raise InputError(path, _column(name), "no such column", NEW_FOLDER)
        for name in (*COLUMNS, *(f"metric.{metric.name}" for metric in metrics)):
            if name not in table.column_names:
                raise InputError(path, name, "no such column", NEW_FOLDER)
        retained = [
            name for name in table.column_names if name in FLIGHT or name.startswith((*NUMBER_PREFIXES, "fault."))
        ]
        for name in ("variant", *retained):
            (check_texts if name in TEXTS else numbers)(table, name, path)
        labels = numpy_of(table["variant"])
        for variant in dict.fromkeys(labels.tolist()):
            mine = table.select(retained).filter(pyarrow.array(labels == variant))
            trials = TrialTable(mine.combine_chunks())
            sampled = "trial" in draws and rows_drawn == {total}
            same = sampled and all(
                np.array_equal(trials.column(_column(name)), column[trials.trial]) for name, column in draws.items()
            )
            if not same:
                raise InputError(path, variant, "its draws are not those of draws.parquet", NEW_FOLDER)
            parts.setdefault(variant, []).append(trials)
    if len({sum(map(len, variants)) for variants in parts.values()}) != 1:
        raise InputError(next(iter(shards)).parent, "variant", "not every variant has every trial", NEW_FOLDER)
    return {variant: join_trials(variants) for variant, variants in parts.items()}


def _column(draw: str) -> str:
    """The column of the shards that repeats one of draws.parquet."""
    return "trial" if draw == "trial" else f"draw.{draw}"


def _check_summary(document: SummaryDocument, variants: Mapping[str, TrialTable], path: Path) -> None:
    """Refuse a summary that does not count what the table holds."""
    if list(document["variants"]) != list(variants):
        raise InputError(path, "variants", "not those of trials/", NEW_FOLDER)
    for name, trials in variants.items():
        stated = document["variants"][name]
        rate = stated.get("success_rate") if isinstance(stated, dict) else None
        if rate != int(trials.success.sum()) / len(trials.success):
            raise InputError(path, f"variants.{name}", "its success rate is not that of trials/", NEW_FOLDER)


def _list_traces(folder: Path, variants: list[str], batch: str) -> tuple[dict[str, list[int]], int]:
    """Trials of each variant with a trace of this batch, and how many traces are of others."""
    traced = {variant: list(list_traces(folder, batch, variant)) for variant in variants}
    there = sum(len(list(trace_path(folder, variant, 0).parent.glob("*.parquet"))) for variant in variants)
    return traced, there - sum(map(len, traced.values()))
