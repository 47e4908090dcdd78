"""A batch read back from the folder that `perilune batch --output` wrote, every file checked against the others."""

from __future__ import annotations

import json
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet

from ..campaign.campaign import Metric
from ..campaign.expressions import Expression
from ..campaign.groups import Group, groups_of
from ..errors import InputError
from ..system.names import parted
from .results import batch_digest, trace_path
from .trials import Trials

WRITE = "give a folder that perilune batch --output wrote"
AGAIN = "fly the batch again into an empty folder"
FACTS = (
    "system", "system_sha256", "campaign", "campaign_sha256", "parameter_sets", "set", "variant", "trials", "seed",
    "step", "algorithm", "fmus", "perilune", "description", "success", "metrics", "record", "signals", "targets",
)  # fmt: skip
COLUMNS = ("variant", "trial", "status", "success", "end_time")


@dataclass(frozen=True)
class StoredBatch:
    """A batch on disk.

    ``document`` is summary.json. ``draws`` are columns over trials, ``variants`` the trials by
    variant (in order of trial, without traces), ``traced`` the trials of each that have a trace of
    this batch, and ``strangers`` the number of traces of other batches in the folder.
    """

    folder: Path
    document: dict[str, Any]
    metrics: tuple[Metric, ...]
    draws: dict[str, np.ndarray]
    variants: dict[str, Trials]
    traced: dict[str, list[int]]
    strangers: int

    @property
    def provenance(self) -> dict[str, Any]:
        """What the batch's numbers depend on: summary.json without the summary."""
        return {key: value for key, value in self.document.items() if key != "variants"}

    @property
    def group(self) -> str | None:
        """The drawn or derived value that the campaign groups trials by, if it does."""
        return self.document.get("group")

    @property
    def faults(self) -> list[str]:
        """The faults that flew, the campaign's and the user's."""
        return self.document.get("faults", [])

    @cached_property
    def groups(self) -> list[Group]:
        """The groups of trials; none where the campaign does not ask for them. Raises InputError."""
        where = (str(self.folder / "summary.json"), "group")
        if self.group is None:
            return []
        if self.group not in self.draws:
            raise InputError(*where, f"{self.group} is not a column of draws.parquet", AGAIN)
        return groups_of(self.draws[self.group], where)

    def parted(self, name: str) -> tuple[str, str]:
        """Component and variable of a signal or parameter of any variant."""
        return parted(name, (component for fmus in self.document["fmus"].values() for component in fmus))

    def trace(self, variant: str, trial: int, names: Collection[str] | None = None) -> dict[str, np.ndarray]:
        """The kept signals of one flight, ``time`` (s) among them; of ``names`` those that there are, or all."""
        path = trace_path(self.folder, variant, trial)
        table = read_table(path, names if names is None else [*names, "time"])
        if "time" not in table.column_names:
            raise InputError(path, "time", "no such column", AGAIN)
        return {name: _numbers(table, name, path) for name in table.column_names}


def read_batch(folder: Path) -> StoredBatch:
    """The batch in a folder. Raises InputError for what is missing, damaged, or of two batches."""
    for name in ("summary.json", "trials.parquet", "draws.parquet"):
        if not (folder / name).is_file():
            raise InputError(folder, name, "not found", WRITE)
    document = _read_summary(folder / "summary.json")
    provenance = {key: value for key, value in document.items() if key != "variants"}
    path = folder / "trials.parquet"
    table = read_table(path)
    if _metadata(table) != provenance:
        raise InputError(path, "", "of another batch than summary.json", AGAIN)
    metrics = _metrics(document, folder / "summary.json")
    draws = read_table(folder / "draws.parquet")
    columns = {name: _numbers(draws, name, folder / "draws.parquet") for name in draws.column_names}
    variants = _variants(table, metrics, columns, path)
    _check_summary(document, variants, folder / "summary.json")
    traced, strangers = _traced(folder, list(variants), batch_digest(provenance))
    columns.pop("trial")
    return StoredBatch(folder, document, metrics, columns, variants, traced, strangers)


def read_table(path: Path, columns: Collection[str] | None = None) -> pyarrow.Table:
    """A parquet file, or those of its ``columns`` that there are, checksums verified. Raises InputError."""
    try:
        with pyarrow.parquet.ParquetFile(path, page_checksum_verification=True) as file:
            names = file.schema_arrow.names
            return file.read(names if columns is None else [name for name in names if name in columns])
    except (OSError, pyarrow.ArrowException) as error:
        reason = str(error).split(": ")[-1] or type(error).__name__
        raise InputError(path, "", f"cannot be read as parquet ({' '.join(reason.split())})", AGAIN) from error


def _read_summary(path: Path) -> dict[str, Any]:
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
        raise InputError(path, "", f"not JSON: {error}", AGAIN) from error
    variants = document.get("variants") if isinstance(document, dict) else None
    if not isinstance(variants, dict) or not variants:
        raise InputError(path, "variants", "missing", WRITE)
    for key in FACTS:
        if key not in document:
            raise InputError(path, key, "missing, as in results of an older version", "fly the batch again")
    return document


def _metadata(table: pyarrow.Table) -> Any:
    try:
        return json.loads((table.schema.metadata or {}).get(b"perilune", b"null"))
    except ValueError:
        return None


def _metrics(document: Mapping[str, Any], path: Path) -> tuple[Metric, ...]:
    try:
        return tuple(
            Metric(
                name=name,
                expression=Expression(fact["expression"], (str(path), f"metrics.{name}.expression")),
                reduction=fact["reduction"],
                unit=fact["unit"],
                description=fact["description"],
                condition=_condition(fact, (str(path), f"metrics.{name}.condition")),
                delay=fact.get("delay", 0.0),
            )
            for name, fact in document["metrics"].items()
        )
    except (AttributeError, KeyError, TypeError) as error:
        raise InputError(path, "metrics", "not as perilune batch writes them", AGAIN) from error


def _condition(fact: Mapping[str, Any], where: tuple[str, str]) -> Expression | None:
    return Expression(fact["condition"], where) if "condition" in fact else None


def _numbers(table: pyarrow.Table, name: str, path: Path) -> np.ndarray:
    """A column as doubles, or whole numbers or booleans where it holds such."""
    kind = table.schema.field(name).type
    column = table[name]
    known = pyarrow.types.is_floating(kind) or pyarrow.types.is_integer(kind) or pyarrow.types.is_boolean(kind)
    if column.null_count or not known:
        raise InputError(path, name, "not a column of numbers", AGAIN)
    return column.to_numpy()


def _variants(
    table: pyarrow.Table, metrics: tuple[Metric, ...], draws: Mapping[str, np.ndarray], path: Path
) -> dict[str, Trials]:
    wanted = [*COLUMNS, *(f"metric.{metric.name}" for metric in metrics), *(f"draw.{name}" for name in draws)]
    for name in wanted:
        if name not in table.column_names and name != "draw.trial":
            raise InputError(path, name, "no such column", AGAIN)
    labels = np.array(table["variant"].to_pylist(), dtype=str)
    statuses = np.array(table["status"].to_pylist(), dtype=str)
    columns = {
        name: _numbers(table, name, path) for name in table.column_names if name not in ("variant", "status", "message")
    }
    found = {}
    for variant in dict.fromkeys(labels.tolist()):
        rows = labels == variant
        mine = {name: column[rows] for name, column in columns.items()}
        same = all(np.array_equal(mine[_column(name)], column) for name, column in draws.items())
        if "trial" not in draws or not same:
            raise InputError(path, variant, "its draws are not those of draws.parquet", AGAIN)
        found[variant] = Trials(
            statuses=statuses[rows].tolist(),
            success=mine["success"].astype(bool),
            metrics={metric.name: mine[f"metric.{metric.name}"] for metric in metrics},
            trial=mine["trial"],
            end_time=mine["end_time"],
            messages={},
            final={name.removeprefix("final."): mine[name] for name in mine if name.startswith("final.")},
            traces={},
        )
    return found


def _column(draw: str) -> str:
    """The column of trials.parquet that repeats one of draws.parquet."""
    return "trial" if draw == "trial" else f"draw.{draw}"


def _check_summary(document: Mapping[str, Any], variants: Mapping[str, Trials], path: Path) -> None:
    """Refuse a summary that does not count what the table holds."""
    if list(document["variants"]) != list(variants):
        raise InputError(path, "variants", "not those of trials.parquet", AGAIN)
    for name, trials in variants.items():
        stated = document["variants"][name]
        rate = stated.get("success_rate") if isinstance(stated, dict) else None
        if rate != int(trials.success.sum()) / len(trials.success):
            raise InputError(path, f"variants.{name}", "its success rate is not that of trials.parquet", AGAIN)


def _traced(folder: Path, variants: list[str], batch: str) -> tuple[dict[str, list[int]], int]:
    """Trials of each variant with a trace of this batch, and how many traces are of others."""
    traced: dict[str, list[int]] = {}
    strangers = 0
    for variant in variants:
        traced[variant] = []
        for path in sorted(trace_path(folder, variant, 0).parent.glob("*.parquet")):
            trial = int(path.stem) if path.stem.isdecimal() else -1
            if _metadata_of(path) == {"batch": batch, "variant": variant, "trial": trial}:
                traced[variant].append(trial)
            else:
                strangers += 1
    return traced, strangers


def _metadata_of(path: Path) -> Any:
    try:
        with pyarrow.parquet.ParquetFile(path) as file:
            return json.loads((file.schema_arrow.metadata or {}).get(b"perilune", b"null"))
    except (OSError, pyarrow.ArrowException) as error:  # the latter is a ValueError too
        raise InputError(path, "", "cannot be read as parquet", AGAIN) from error
    except ValueError:
        return None
