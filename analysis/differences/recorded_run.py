"""Recorded run: a table written by `run --output` or by another tool."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow
import pyarrow.csv
import pyarrow.parquet

from ...common.bounds import INPUT_BYTES
from ...common.errors import InputError
from ...common.regular import read_input
from ...common.visible import unquote_formula

TIME = "time"
FORM = "give a .parquet or .csv of signals over time, as `perilune run` writes it"


@dataclass(frozen=True, eq=False)
class RecordedRun:
    """Signals by name (float64, [n]) over ``time`` (s, [n], ascending).

    ``origin`` describes what was simulated, and is empty if the table does not state it. ``units`` maps signals to
    their units, as far as they are known, and ``axes`` maps vector elements to the names of their axes. ``discrete``
    contains the signals that are constant between samples (Integers and Booleans), and ``relative`` the signals that
    are differences, which are converted between units without an offset.
    """

    file: str
    origin: str
    time: np.ndarray
    signals: dict[str, np.ndarray]
    units: dict[str, str]
    discrete: frozenset[str]
    relative: frozenset[str] = frozenset()
    axes: Mapping[str, str] = field(default_factory=dict)


def read_run(path: Path) -> RecordedRun:
    """Read a run from a Parquet file, or from a CSV file with units and types in its .json file. Raises InputError.

    Without a .json file, integer columns of a CSV file are read as Reals.
    """
    content = read_input(path, FORM, INPUT_BYTES)
    is_parquet = path.suffix == ".parquet"
    about = {} if is_parquet else _read_document(path.with_name(f"{path.name}.json"))
    try:
        if is_parquet:
            table = pyarrow.parquet.read_table(io.BytesIO(content))
            about = _document(table.schema.metadata or {})
        else:
            table = pyarrow.csv.read_csv(io.BytesIO(content))
            table = table.rename_columns([unquote_formula(name.strip()) for name in table.column_names])
    except (OSError, ValueError, pyarrow.ArrowException) as error:
        problem = f"cannot be read as a table ({' '.join(str(error).split())})"
        raise InputError(path, "", problem, FORM) from error
    names = table.column_names
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        raise InputError(path, repeated[0], "there are two columns of this name", FORM)
    if TIME not in names:
        raise InputError(path, TIME, "no such column", FORM)
    signals = {name: _numbers(table, name, path) for name in names}
    time = signals.pop(TIME)
    if not time.size:
        raise InputError(path, TIME, "no samples", FORM)
    is_good = np.isfinite(time) & np.append(True, np.diff(time) > 0.0)
    if not np.all(is_good):
        row = int(np.argmin(is_good))
        fault = "does not exceed the time in the preceding row" if np.isfinite(time[row]) else "is not finite"
        raise InputError(path, TIME, f"the time in row {row + 1}, {time[row]:.12g}, {fault}", FORM)
    fields = [field for field in table.schema if field.name != TIME]
    units = {field.name: _unit(field) for field in fields} if is_parquet else about.get("units", {})
    types, relative, axes = about.get("types", {}), about.get("relative_quantities"), about.get("axes")
    return RecordedRun(
        file=str(path),
        origin=_origin(about),
        time=time,
        signals=signals,
        units={name: str(unit) for name, unit in units.items() if unit and name in signals},
        discrete=frozenset(
            field.name for field in fields if _is_discrete(field.type, is_parquet) or field.name in types
        ),
        relative=frozenset(map(str, relative if isinstance(relative, list) else ())),
        axes={name: str(axis) for name, axis in axes.items()} if isinstance(axes, dict) else {},
    )


def _is_discrete(kind: pyarrow.DataType, is_typed: bool) -> bool:
    return bool(pyarrow.types.is_boolean(kind) or (is_typed and pyarrow.types.is_integer(kind)))


def _document(metadata: Mapping[bytes, bytes]) -> dict[str, Any]:
    try:
        document = json.loads(metadata.get(b"perilune", b"{}"))
    except ValueError:
        return {}
    return document if isinstance(document, dict) else {}


def _read_document(path: Path) -> dict[str, Any]:
    """Read the .json file of a CSV file; return an empty dict if there is no such file. Raises InputError."""
    if not path.exists():
        return {}
    remedy = "remove this file, or simulate again"
    try:
        document = json.loads(read_input(path, remedy, INPUT_BYTES).decode())
    except (json.JSONDecodeError, UnicodeDecodeError, RecursionError) as error:
        raise InputError(path, "", f"not JSON: {error}", remedy) from error
    if not isinstance(document, dict):
        raise InputError(path, "", "not an object", remedy)
    for key in ("units", "types"):
        if not isinstance(document.get(key, {}), dict):
            raise InputError(path, key, "not an object", remedy)
    return document


def _unit(field: pyarrow.Field) -> str:
    return (field.metadata or {}).get(b"unit", b"").decode()


def _numbers(table: pyarrow.Table, name: str, path: Path) -> np.ndarray:
    try:
        column = table[name].combine_chunks()
        if pyarrow.types.is_boolean(column.type):
            column = column.cast(pyarrow.int8())
        return np.asarray(column.cast(pyarrow.float64()).to_numpy(zero_copy_only=False), dtype=np.float64)
    except (ValueError, pyarrow.ArrowException) as error:
        raise InputError(path, name, "not a column of numbers", "remove this column") from error


def _origin(about: Mapping[str, object]) -> str:
    stated = [str(about[key]) for key in ("system", "variant") if about.get(key)]
    version = about.get("perilune")
    return ", ".join([*stated, *([f"perilune {version}"] if version else [])])
