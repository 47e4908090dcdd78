"""Inputs over time, from a CSV file, a structured array, or columns by name."""

from __future__ import annotations

import csv
import hashlib
import io
import math
import os
from array import array
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ....common.bounds import INPUT_BYTES
from ....common.errors import InputError
from ....common.regular import read_input
from ....common.visible import unquote_formula

TIME = "time"
FORM = "write a comma-separated file whose first line is time and the inputs' names"
TRUTHS = {"true": 1.0, "false": 0.0}


@dataclass(frozen=True, eq=False)
class InputSeries:
    """Samples of inputs: ``time`` [n] (s, never decreasing) and ``columns`` by input name, float64 [n] each.

    ``file`` is the name of their source in messages. ``lines`` contains the line numbers of samples, and is empty for
    arrays. ``sha256`` is the digest of the file, or of names and numbers.
    """

    file: str
    sha256: str
    time: np.ndarray
    columns: Mapping[str, np.ndarray]
    lines: Sequence[int] = ()

    def place(self, row: int, name: str) -> str:
        """Return the position of a sample's number, as text for messages."""
        return f"{f'line {self.lines[row]}' if self.lines else f'sample {row}'}, column {name}"


SeriesSource = str | os.PathLike[str] | npt.NDArray[Any] | Mapping[str, npt.ArrayLike] | Any


def read_series(source: SeriesSource) -> InputSeries:
    """Read inputs over time from a CSV file, a structured array, or columns by name that include ``time``.

    Raises InputError, with line and column, unless it is a table of numbers with a time that never decreases.
    """
    series = _of_file(os.fspath(source)) if isinstance(source, str | os.PathLike) else _of_arrays(source)
    if not series.time.size:
        raise InputError(series.file, "", "no samples", "give a line of numbers for each time")
    if not series.columns:
        raise InputError(series.file, "", "no column except time", "give a column with the name of each input")
    for name, values in {TIME: series.time, **series.columns}.items():
        wrong = np.flatnonzero(~np.isfinite(values))
        if wrong.size:
            row = int(wrong[0])
            raise InputError(series.file, series.place(row, name), f"{values[row]} is not finite", "give a number")
    if not math.isfinite(float(series.time[-1]) - float(series.time[0])):
        raise InputError(series.file, f"column {TIME}", "times too far apart for double precision", "correct the times")
    falls = np.flatnonzero(np.diff(series.time) < 0.0)
    if falls.size:
        row = int(falls[0]) + 1
        problem = f"the time falls from {series.time[row - 1]:.12g} s to {series.time[row]:.12g} s"
        raise InputError(series.file, series.place(row, TIME), problem, "sort the samples by time")
    return series


def _of_file(path: str) -> InputSeries:
    content = read_input(path, "give a CSV file of inputs over time", INPUT_BYTES)
    try:
        reader = csv.reader(io.StringIO(content.decode("utf-8-sig"), newline=""), skipinitialspace=True)
        names = [unquote_formula(name.strip()) for name in next(reader, [])]
        _check_names(path, "line 1", names)
        numbers, lines = array("d"), array("q")
        for fields in reader:
            if not fields:
                continue  # an empty line
            if len(fields) != len(names):
                problem = f"{len(fields)} values, but there are {len(names)} columns"
                raise InputError(path, f"line {reader.line_num}", problem, "give one value for each column")
            try:
                numbers.extend(map(float, fields))
            except ValueError:
                del numbers[len(lines) * len(names) :]
                numbers.extend(_number(path, reader.line_num, *pair) for pair in zip(names, fields, strict=True))
            lines.append(reader.line_num)
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(path, "", f"not a CSV file: {error}", FORM) from error
    table = np.array(numbers).reshape(-1, len(names))
    columns = {name: np.ascontiguousarray(table[:, index]) for index, name in enumerate(names)}
    return InputSeries(path, hashlib.sha256(content).hexdigest(), columns.pop(TIME), columns, lines)


def _check_names(file: str, place: str, names: Sequence[str]) -> None:
    if not any(names):
        raise InputError(file, "", "empty", FORM)
    if names[0] != TIME:
        raise InputError(file, place, f"the first column is {names[0]!r}, not {TIME}", FORM)
    for name, count in Counter(names).items():
        if count > 1:
            raise InputError(file, place, f"column {name} occurs twice", "remove one of the two")


def _number(file: str, line: int, name: str, text: str) -> float:
    """Return the number in a cell; True and False, as written by FMPy for Booleans, are 1 and 0."""
    try:
        return TRUTHS.get(text.strip().lower(), math.nan) if text.strip().lower() in TRUTHS else float(text)
    except ValueError as error:
        problem = f"{text.strip()!r} is not a number" if text.strip() else "no number"
        raise InputError(file, f"line {line}, column {name}", problem, "give a number, or true or false") from error


def _of_arrays(arrays: npt.NDArray[Any] | Mapping[str, npt.ArrayLike]) -> InputSeries:
    file = "input"
    names = list(arrays.dtype.names or ()) if isinstance(arrays, np.ndarray) else list(arrays)
    if TIME not in names:
        raise InputError(file, TIME, "no such column", "give an array with named columns, time and inputs")
    columns: dict[str, np.ndarray] = {}
    for name in names:
        try:
            columns[name] = np.array(arrays[name], dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(file, f"column {name}", f"not numbers: {error}", "give an array of numbers") from error
        if columns[name].ndim != 1 or columns[name].size != columns[names[0]].size:
            problem = f"its shape is {columns[name].shape}, but the shape of {names[0]} is {columns[names[0]].shape}"
            raise InputError(file, f"column {name}", problem, "give one number for each time")
    digest = hashlib.sha256()
    for name, values in columns.items():
        digest.update(name.encode() + b"\0" + values.tobytes())
    return InputSeries(file, digest.hexdigest(), columns.pop(TIME), columns)
