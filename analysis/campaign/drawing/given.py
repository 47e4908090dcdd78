"""Draws that are given and not drawn: a trial for each row."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pyarrow
import pyarrow.parquet

from ...errors import InputError, suggestion
from .declared import Declared, drawn_names

STREAMS = "streams_of"  # the column that says whose random streams a row flies with
TRIAL = "trial"


@dataclass(frozen=True, eq=False)
class GivenDraws:
    """Draws for all trials: ``columns`` maps every name that a campaign draws to an array (trials,) of doubles.

    ``streams`` (trials,) are the numbers of the trials whose random streams components fly with; None for each its
    own. ``file`` and ``sha256`` say where they come from.
    """

    columns: Mapping[str, np.ndarray]
    streams: np.ndarray | None = None
    file: str = ""
    sha256: str = ""

    @property
    def trials(self) -> int:
        return len(next(iter(self.columns.values())))

    @property
    def table(self) -> dict[str, np.ndarray]:
        """Its columns, with that of the streams where trials do not have their own."""
        return dict(self.columns) | ({} if self.streams is None else {STREAMS: self.streams.astype(float)})

    def stream_of(self, trial: int) -> int:
        """The trial whose random streams one flies with."""
        return trial if self.streams is None else int(self.streams[trial])

    def of_part(self, trials: range) -> GivenDraws:
        """Those of trials in a row, which are counted from 0 then."""
        rows = slice(trials.start, trials.stop)
        streams = self.streams
        if streams is not None or trials.start:
            streams = (np.arange(self.trials) if streams is None else streams)[rows]
        return replace(self, columns={name: values[rows] for name, values in self.columns.items()}, streams=streams)


def read_given(path: Path, campaign: Declared) -> GivenDraws:
    """The draws of a campaign in a Parquet file, a row per trial, as draws.parquet of a batch. Raises InputError.

    The column ``streams_of``, where there is one, says with which trial's random streams a row flies; else that is the
    row's number. Columns of derived values are not read: they are derived anew.
    """
    try:
        data = path.read_bytes()
        table = pyarrow.parquet.read_table(pyarrow.BufferReader(data))
    except OSError as error:  # Arrow's own errors of damaged files are such, too
        raise InputError(path, "", error.strerror or str(error), "give a Parquet file of draws") from error
    except pyarrow.ArrowInvalid as error:
        raise InputError(path, "", f"not Parquet: {error}", "give a Parquet file of draws") from error
    drawn = drawn_names(campaign)
    for name in drawn:
        if name not in table.column_names:
            raise InputError(path, name, "is drawn, and no column has it", "add the column")
    for name in table.column_names:
        if name not in (TRIAL, STREAMS, *drawn, *campaign.derived):
            known = [*drawn, *campaign.derived, STREAMS]
            raise InputError(path, name, f"{campaign.file} draws and derives no such value", suggestion(name, known))
    if not table.num_rows:
        raise InputError(path, "", "no row", "give one row or more")
    if not drawn:
        raise InputError(path, "", f"{campaign.file} draws nothing", "leave the file out")
    columns = {name: _numbers(path, table, name) for name in drawn}
    streams = _numbers(path, table, STREAMS) if STREAMS in table.column_names else None
    if streams is not None and np.any((streams < 0.0) | (streams != np.round(streams))):
        raise InputError(path, STREAMS, "not all are numbers of trials", "give whole numbers, 0 or more")
    whose = None if streams is None else streams.astype(np.int64)
    return GivenDraws(columns, whose, str(path), hashlib.sha256(data).hexdigest())


def _numbers(path: Path, table: pyarrow.Table, name: str) -> np.ndarray:
    """A column as finite doubles."""
    try:
        values = np.ascontiguousarray(table[name].to_numpy(), dtype=np.float64)
    except (TypeError, ValueError, pyarrow.ArrowInvalid) as error:
        raise InputError(path, name, "not a column of numbers", "give a number in every row") from error
    wrong = np.flatnonzero(~np.isfinite(values))
    if wrong.size:
        raise InputError(path, name, f"{values[wrong[0]]} in row {wrong[0]}", "give a finite number in every row")
    return values
