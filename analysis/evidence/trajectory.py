"""A reference trajectory or stimuli: a CSV table of signals over time."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pyarrow
import pyarrow.csv

from ...common.errors import InputError
from ..runtime.system.series import TIME, InputSeries

FORM = "write comma-separated columns, time first"


@dataclass(frozen=True, eq=False)
class Trajectory:
    """``signals`` (float64, [n]) by name over ``time`` (s, [n], ascending); ``texts`` names the non-numeric columns."""

    file: str
    sha256: str
    time: np.ndarray
    signals: Mapping[str, np.ndarray]
    texts: tuple[str, ...]

    def series(self, without: set[str]) -> InputSeries:
        """Return the columns, except those in ``without``, as inputs over time; non-finite samples are allowed.

        Raises InputError if a remaining column is not numeric.
        """
        for name in self.texts:
            if name not in without:
                raise InputError(self.file, f"column {name}", "has values that are not numbers", "write numbers")
        columns = {name: samples for name, samples in self.signals.items() if name not in without}
        return InputSeries(self.file, self.sha256, self.time, columns)


def read_trajectory(content: bytes, file: str) -> Trajectory:
    """Read the trajectory of a CSV file. Raises InputError, naming the column, for any other content."""
    try:
        table = pyarrow.csv.read_csv(io.BytesIO(content))
    except pyarrow.ArrowException as error:
        raise InputError(file, "", f"not a table: {' '.join(str(error).split())}", FORM) from error
    names = [name.strip() for name in table.column_names]
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        raise InputError(file, repeated[0], "two columns of this name", "remove one")
    signals: dict[str, np.ndarray] = {}
    texts = []
    for name, column in zip(names, table.columns, strict=True):
        numbers = _numbers(column)
        if numbers is None:
            texts.append(name)
        else:
            signals[name] = numbers
    if TIME not in signals or not table.num_rows:
        raise InputError(file, TIME, "no such column, or a column without numbers", FORM)
    time = signals.pop(TIME)
    if not np.all(np.isfinite(time)) or np.any(np.diff(time) < 0.0):
        raise InputError(file, TIME, *_fault_of(time))
    return Trajectory(file, hashlib.sha256(content).hexdigest(), time, signals, tuple(texts))


def _fault_of(time: np.ndarray) -> tuple[str, str]:
    """Return the problem and its remedy if times are not finite or decrease."""
    if not np.all(np.isfinite(time)):
        row = int(np.argmin(np.isfinite(time)))
        return f"{time[row]} in row {row + 1} is not finite", "write a finite time in every row"
    row = int(np.argmax(np.diff(time) < 0.0)) + 1
    return f"{time[row]:.12g} s in row {row + 1} is before the time of the preceding row", "sort the rows by time"


def _numbers(column: pyarrow.ChunkedArray) -> np.ndarray | None:
    """Return a column as float64, with Booleans as 0 and 1; None for a column of texts."""
    if pyarrow.types.is_boolean(column.type):
        column = column.cast(pyarrow.int8())
    if not (pyarrow.types.is_integer(column.type) or pyarrow.types.is_floating(column.type)):
        return None
    return np.asarray(column.cast(pyarrow.float64(), safe=False).to_numpy(), dtype=np.float64)
