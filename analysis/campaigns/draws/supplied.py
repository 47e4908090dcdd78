"""Samples supplied by the user instead of drawn, with one trial for each row."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ....common.bounds import INPUT_BYTES, TABLE_TRIALS, TRIALS
from ....common.errors import InputError, suggestion
from ....common.regular import read_input
from .interfaces import CampaignDraws, input_names

if TYPE_CHECKING:  # imported at run time only when a file is read
    import pyarrow

STREAMS = "streams_of"  # column of the trials whose random streams are used; streams_of.NAME for a single component
ALL = ""  # key for all components without a separate entry
TRIAL = "trial"
REMEDY = "give a Parquet file of draws"

Streams = Mapping[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class SuppliedDraws:
    """Supplied draws for all trials: ``columns`` maps every drawn name to an array (trials,) of doubles.

    ``streams`` maps a component to the numbers (trials,) of the trials whose random streams the component uses. The key
    `ALL` stands for all components without an entry; if it is missing, they use the streams of the trial itself.
    ``file`` and ``sha256`` are the origin. There is at least one column or stream.
    """

    columns: Mapping[str, np.ndarray]
    streams: Streams = field(default_factory=dict)
    file: str = ""
    sha256: str = ""

    @property
    def trials(self) -> int:
        return len(next(iter((*self.columns.values(), *self.streams.values()))))

    @property
    def table(self) -> dict[str, np.ndarray]:
        """All columns, including columns of streams if trials use the streams of other trials."""
        return dict(self.columns) | {stream_column(name): values.astype(float) for name, values in self.streams.items()}

    def streams_of(self, trials: range, component: str) -> np.ndarray:
        """Return the numbers of the trials whose random streams a component uses in these trials."""
        streams = self.streams.get(component, self.streams.get(ALL))
        return np.arange(trials.start, trials.stop) if streams is None else streams[trials.start : trials.stop]

    def of_part(self, trials: range) -> SuppliedDraws:
        rows = slice(trials.start, trials.stop)
        streams = dict(self.streams)
        if trials.start and ALL not in streams:
            streams[ALL] = np.arange(self.trials)
        return replace(
            self,
            columns={name: values[rows] for name, values in self.columns.items()},
            streams={name: values[rows] for name, values in streams.items()},
        )


def stream_column(component: str) -> str:
    """Return the name of a component's column with the numbers of trials whose random streams it uses."""
    return STREAMS if component == ALL else f"{STREAMS}.{component}"


def stream_component(column: str) -> str | None:
    """Return the component in the name of a stream column; None for other columns."""
    if column == STREAMS:
        return ALL
    return column.removeprefix(f"{STREAMS}.") if column.startswith(f"{STREAMS}.") else None


def part_streams(columns: Mapping[str, np.ndarray]) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Split the columns of a file into draws, and streams (as integers) by component."""
    components = {name: stream_component(name) for name in columns}
    draws = {name: values for name, values in columns.items() if components[name] is None}
    streams = {
        component: columns[name].astype(np.int64) for name, component in components.items() if component is not None
    }
    return draws, streams


def read_supplied(path: Path, campaign: CampaignDraws) -> SuppliedDraws:
    """Read the draws of a campaign from a Parquet file with a row for each trial, like a batch's draws.parquet.

    A column ``streams_of.COMPONENT`` states the trial whose random stream the component uses in a row; a column
    ``streams_of`` states it for all other components. The default is the row's number. Derived values are not read, but
    evaluated again. Raises InputError.
    """
    import pyarrow.parquet

    content = read_input(path, REMEDY, INPUT_BYTES)
    sampled = input_names(campaign)
    try:
        file = pyarrow.parquet.ParquetFile(pyarrow.BufferReader(content))
        TABLE_TRIALS.check(file.metadata.num_rows, path, "rows")
        _check_columns(path, file.schema_arrow, campaign)
        table = file.read()
    except OSError as error:  # includes Arrow's errors for damaged files
        raise InputError(path, "", error.strerror or str(error), REMEDY) from error
    except (UnicodeDecodeError, pyarrow.ArrowException) as error:  # UnicodeDecodeError for names of columns
        raise InputError(path, "", f"not Parquet: {error}", REMEDY) from error
    stream_columns = [name for name in table.column_names if stream_component(name) is not None]
    if not table.num_rows:
        raise InputError(path, "", "the table is empty", "give one row or more")
    if not sampled and not stream_columns:
        raise InputError(path, "", f"{campaign.file} draws nothing", "leave out `draws`")
    columns = {name: _numbers(path, table, name) for name in (*sampled, *stream_columns)}
    for name in stream_columns:
        if np.any((columns[name] < 0.0) | (columns[name] > TRIALS.limit) | (columns[name] != np.round(columns[name]))):
            raise InputError(path, name, "a value is not a trial number", "give whole numbers, 0 or more")
    return SuppliedDraws(*part_streams(columns), str(path), hashlib.sha256(content).hexdigest())


def _check_columns(path: Path, schema: pyarrow.Schema, campaign: CampaignDraws) -> None:
    """Reject missing, unknown and duplicate columns, and columns without numbers."""
    import pyarrow

    sampled = input_names(campaign)
    numbers = (pyarrow.types.is_integer, pyarrow.types.is_floating, pyarrow.types.is_boolean)
    for name in sampled:
        if name not in schema.names:
            raise InputError(
                path, name, "the campaign draws this value, but the file has no such column", "add the column"
            )
    for name, count in Counter(schema.names).items():
        known = [*sampled, *campaign.derived, *(lookup.name for lookup in campaign.lookups)]
        if stream_component(name) is None and name not in (TRIAL, *known):
            remedy = suggestion(name, [*known, STREAMS])
            raise InputError(path, name, f"{campaign.file} neither draws nor derives this value", remedy)
        if count > 1:
            raise InputError(path, name, "two columns of this name", "remove one of the two")
        if not any(is_of(schema.field(name).type) for is_of in numbers):
            raise InputError(path, name, "not a column of numbers", "give a number in every row")


def _numbers(path: Path, table: pyarrow.Table, name: str) -> np.ndarray:
    """Return a column as finite doubles."""
    values = np.ascontiguousarray(table[name].to_numpy(), dtype=np.float64)
    wrong = np.flatnonzero(~np.isfinite(values))
    if wrong.size:
        raise InputError(path, name, f"row {wrong[0]} contains {values[wrong[0]]}", "give a finite number in every row")
    return values
