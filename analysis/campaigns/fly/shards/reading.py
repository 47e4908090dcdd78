"""Shards read back: tables, with every file's checksums verified, and the trials in them."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.parquet

from ....common.errors import InputError
from ...trials import Trials
from .arrow import numpy_of
from .files import unreadable

AGAIN = "fly the batch again into an empty folder"
COLUMNS = ("variant", "trial", "status", "success", "end_time")


def read_table(path: Path, columns: Collection[str] | None = None) -> pyarrow.Table:
    """A parquet file, or those of its ``columns`` that there are, checksums verified. Raises InputError."""
    try:
        with pyarrow.parquet.ParquetFile(path, page_checksum_verification=True) as file:
            names = file.schema_arrow.names
            return file.read(names if columns is None else [name for name in names if name in columns])
    except (OSError, pyarrow.ArrowException) as error:
        raise unreadable(path, error) from error


def numbers(table: pyarrow.Table, name: str, path: Path) -> np.ndarray:
    """A column as doubles, or whole numbers or booleans where it holds such. Raises InputError."""
    kind = table.schema.field(name).type
    column = table[name]
    known = pyarrow.types.is_floating(kind) or pyarrow.types.is_integer(kind) or pyarrow.types.is_boolean(kind)
    if column.null_count or not known:
        raise InputError(path, name, "not a column of numbers", AGAIN)
    return numpy_of(column)


def trials_of(table: pyarrow.Table, metrics: Iterable[str], path: Path) -> dict[str, Trials]:
    """The trials of a table by variant, without traces; ``path`` is what errors name. Raises InputError."""
    metrics = list(metrics)
    for name in (*COLUMNS, *(f"metric.{metric}" for metric in metrics)):
        if name not in table.column_names:
            raise InputError(path, name, "no such column", AGAIN)
    labels = np.array(table["variant"].to_pylist(), dtype=str)
    statuses = np.array(table["status"].to_pylist(), dtype=object)
    messages = np.array(table["message"].to_pylist(), dtype=object) if "message" in table.column_names else None
    retained = [name for name in table.column_names if name in COLUMNS[1:] or name.startswith(("metric.", "final."))]
    columns = {name: numbers(table, name, path) for name in retained if name != "status"}
    by_variant = {}
    for variant in dict.fromkeys(labels.tolist()):
        rows = labels == variant
        mine = {name: column[rows] for name, column in columns.items()}
        texts = [] if messages is None else zip(mine["trial"].tolist(), messages[rows], strict=True)
        by_variant[variant] = Trials(
            statuses=statuses[rows].tolist(),
            success=mine["success"].astype(bool),
            metrics={metric: mine[f"metric.{metric}"] for metric in metrics},
            trial=mine["trial"],
            end_time=mine["end_time"],
            messages={trial: text for trial, text in texts if text},
            final={name.removeprefix("final."): mine[name] for name in mine if name.startswith("final.")},
            traces={},
        )
    return by_variant


def trials_in(path: Path, about: Any, batch: str, whose: str) -> range:
    """The trials of a shard's file, of which ``about`` is what it says of itself.

    Raises InputError for one of another batch than that of the file ``whose``, and for one that has another's name.
    """
    if not isinstance(about, dict) or about.get("batch") != batch:
        raise InputError(path, "", f"of another batch than {whose}", AGAIN)
    if about.get("shard") != int(path.stem):
        raise InputError(path, "", "not the shard that it is named by", AGAIN)
    return range(*about["trials"])
