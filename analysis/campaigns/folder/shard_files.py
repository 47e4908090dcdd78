"""Functions that read and write files of shards. A shard's file exists only if all trials and traces are stored."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet

from ....common.atomic import whole_file
from ....common.errors import InputError
from ....common.machine.arrow import numpy_of, table_of, texts_of
from ....common.regular import check_folder, check_regular
from ..definition.plan import BatchPlan, TrialSamples
from ..trials import TrialTable

FOLDER = "trials"
TRACES = "traces"
DRAWS = "draws.parquet"
SUMMARY = "summary.json"
NEW_FOLDER = "run the batch again with an empty folder"


def check_folders(folder: Path, remedy: str = NEW_FOLDER) -> None:
    """Reject trials and traces that are not in folders, but for instance in links to folders. Raises InputError."""
    for path in (folder / FOLDER, folder / TRACES, *folder.glob(f"{TRACES}/*")):
        check_folder(path, remedy)


def shard_path(folder: Path, shard: int) -> Path:
    return folder / FOLDER / f"{shard:06d}.parquet"


def trace_path(folder: Path, variant: str, trial: int) -> Path:
    """Return the path of a trial's trace; slashes in the variant's name, which may be a path, are replaced."""
    return folder / TRACES / variant.replace("/", "_") / f"{trial:06d}.parquet"


def clear(folder: Path) -> None:
    """Remove the shards of an earlier batch. Traces are not removed, since each names its batch."""
    if (folder / FOLDER).is_dir():
        shutil.rmtree(folder / FOLDER)


def write_draws(plan: BatchPlan, folder: Path, size: int) -> None:
    """Write the table of draws to ``folder``/draws.parquet, a row for each trial, ``size`` rows in each row group.

    Counter-based draws have no table: the files of trials contain them.
    """
    if plan.is_counted:
        (folder / DRAWS).unlink(missing_ok=True)
        return
    with whole_file(folder / DRAWS) as partial:
        writer, first = None, 0
        try:
            for part in plan.draw_parts(size):
                numbers = np.arange(first, first + part.trials)
                table = table_of({"trial": numbers, **part.columns})
                writer = writer or pyarrow.parquet.ParquetWriter(partial, table.schema, write_page_checksum=True)
                writer.write_table(table)
                first += part.trials
        finally:
            if writer is not None:
                writer.close()


def trial_table(plan: BatchPlan, trials: Mapping[str, TrialTable]) -> pyarrow.Table:
    """Return a row for each variant and trial: identity, status, draws, the campaign's faults, final values, metrics.

    All variants have the same trials, which are consecutive.
    """
    numbers = next(iter(trials.values())).trial
    sampled = plan.values_of(range(int(numbers[0]), int(numbers[-1]) + 1))
    tables = [
        with_draws(part, sampled).table.add_column(0, "variant", texts_of([name] * len(part)))
        for name, part in trials.items()
    ]
    return pyarrow.concat_tables(tables).combine_chunks()


def with_draws(trials: TrialTable, sampled: TrialSamples) -> TrialTable:
    """Return the trials with columns added for their samples and the campaign's faults, in the column order of the
    stored files.
    """
    table = trials.table
    sampled_columns = {f"draw.{name}": values for name, values in sampled.table.columns.items()}
    for fault in sampled.faults:
        sampled_columns |= fault.columns()
    recorded = [name for name in table.column_names if name.startswith(("final.", "metric."))]
    columns = {name: table[name] for name in FLIGHT} | sampled_columns | {name: table[name] for name in recorded}
    return TrialTable(table_of(columns), trials.traces)


def write_parquet(table: pyarrow.Table, path: Path, rows: int | None = None) -> None:
    """Write a table with a checksum on every page, so that damage is detected on reading.

    ``rows`` is the number of rows in a row group; None stands for a single group.
    """
    with whole_file(path) as partial:
        pyarrow.parquet.write_table(table, partial, row_group_size=rows, write_page_checksum=True)


def describe(table: pyarrow.Table, about: Mapping[str, object]) -> pyarrow.Table:
    return table.replace_schema_metadata({"perilune": json.dumps(about)})


def describe_columns(path: Path) -> object:
    """Return the metadata in a file of a shard or trace, or None if the file is missing or has no metadata.

    Raises InputError for a damaged file.
    """
    return read_metadata(read_schema(path)) if os.path.lexists(path) else None


def read_schema(path: Path) -> pyarrow.Schema:
    """Return the columns of a Parquet file. Raises InputError."""
    check_regular(path, NEW_FOLDER)
    try:
        with pyarrow.parquet.ParquetFile(path) as file:
            return file.schema_arrow
    except (OSError, ValueError, pyarrow.ArrowException) as error:
        raise unreadable(path, error) from error


def trace_files(folder: Path, variant: str) -> dict[int, Path]:
    """Return the files of a variant's traces, of any batch, by trial and in order."""
    files = trace_path(folder, variant, 0).parent.glob("*.parquet")
    numbered = {int(path.stem): path for path in files if path.stem.isdecimal()}
    return dict(sorted(numbered.items()))


def read_trace(path: Path, names: Collection[str] | None = None) -> dict[str, np.ndarray]:
    """Return the recorded signals of a trial with ``time`` (s): the signals in ``names`` that exist, by default all.

    Raises InputError.
    """
    table = read_table(path, names if names is None else [*names, "time"])
    if "time" not in table.column_names:
        raise InputError(path, "time", "no such column", NEW_FOLDER)
    return {name: numbers(table, name, path) for name in table.column_names}


def unreadable(path: Path, error: Exception) -> InputError:
    """Return the error for a damaged file."""
    reason = str(error).split(": ")[-1] or type(error).__name__
    problem = f"cannot be read as parquet ({' '.join(reason.split())})"
    return InputError(
        path, "", problem, "remove this file: the batch's command with `resume` simulates its trials again"
    )


def read_metadata(schema: pyarrow.Schema) -> object:
    """Return the metadata of a table, or None if it has none."""
    try:
        return json.loads((schema.metadata or {}).get(b"perilune", b"null"))
    except ValueError:
        return None


COLUMNS = ("variant", "trial", "status", "success", "end_time")
FLIGHT = ("trial", "status", "success", "message", "end_time")


IDENTITY = ("variant", "trial")  # columns that identify the simulation of a row
TEXTS = ("variant", "status", "message")
NUMBERS = ("trial", "success", "end_time")
NUMBER_PREFIXES = ("draw.", "fault.", "final.", "metric.")


def check_columns(table: pyarrow.Table, names: Collection[str], path: Path) -> None:
    """Reject a table of trials with columns in ``names`` that are missing or have other types. Raises InputError."""
    for name in (*IDENTITY, *names):
        if name not in table.column_names:
            raise InputError(path, name, "no such column", NEW_FOLDER)
    for name in table.column_names:
        if name in TEXTS:
            check_texts(table, name, path)
        if name in NUMBERS or name.startswith(NUMBER_PREFIXES):
            numbers(table, name, path)


def check_texts(table: pyarrow.Table, name: str, path: Path) -> None:
    """Reject a column that does not contain texts. Raises InputError."""
    kind = table.schema.field(name).type
    if pyarrow.types.is_dictionary(kind):
        kind = kind.value_type
    is_text = pyarrow.types.is_string(kind) or pyarrow.types.is_large_string(kind)
    if not is_text or table[name].null_count:
        raise InputError(path, name, "not a column of texts", NEW_FOLDER)


def read_table(path: Path, columns: Collection[str] | None = None, group: int | None = None) -> pyarrow.Table:
    """Return a Parquet file with verified checksums: all of it, the ``columns`` that exist, or one row group.

    Raises InputError.
    """
    check_regular(path, NEW_FOLDER)
    try:
        with pyarrow.parquet.ParquetFile(path, page_checksum_verification=True) as file:
            names = file.schema_arrow.names
            some = names if columns is None else [name for name in names if name in columns]
            table = file.read(some) if group is None else file.read_row_group(group, some)
    except (OSError, ValueError, IndexError, pyarrow.ArrowException) as error:
        raise unreadable(path, error) from error
    check_names(table.column_names, path)
    return table


def check_names(names: Sequence[str], path: Path) -> None:
    """Reject duplicate column names, which Arrow cannot distinguish. Raises InputError."""
    if len(set(names)) < len(names):
        raise InputError(path, max(names, key=names.count), "two columns have this name", NEW_FOLDER)


def numbers(table: pyarrow.Table, name: str, path: Path) -> np.ndarray:
    """Return a column as doubles, integers or booleans, depending on its type. Raises InputError."""
    kind = table.schema.field(name).type
    column = table[name]
    known = pyarrow.types.is_floating(kind) or pyarrow.types.is_integer(kind) or pyarrow.types.is_boolean(kind)
    if column.null_count or not known:
        raise InputError(path, name, "not a column of numbers", NEW_FOLDER)
    return numpy_of(column)
