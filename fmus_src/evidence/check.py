"""Check of a block: a short reference trajectory computed without the block's code."""

from __future__ import annotations

import csv
import io
import math
import sys
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Any

from ..block import Block
from ..variables import Input, Output, Parameter, Variable

TIME = "time"
TABLE, DECLARATIONS = ".csv", ".toml"
KEYS = {"truth": str, "step_size": float, "stop_time": float, "parameters": dict, "tolerances": dict}
BOUNDS = ("absolute", "relative")
PARAMETER_TYPES = {"Real": (float, int), "Integer": (int,), "Boolean": (bool,)}
Tolerances = Mapping[str, tuple[float, float]]  # by signal: absolute and relative tolerance


class CheckError(ValueError):
    """Error raised for a check that is incomplete or does not fit its block; the message names file and element."""


@dataclass(frozen=True)
class Check:
    """Reference trajectory of a block, with tolerances and settings.

    Each row of ``table`` (CSV) contains a time (s), the outputs at this time, and the inputs from this time to the next
    row. An output may differ from the reference by ``absolute + relative |reference|``, with the two ``tolerances`` of
    the output. ``truth`` describes how the reference was computed. Steps are in s; ``parameters`` are set before
    initialisation.
    """

    table: bytes
    truth: str
    step: float
    stop_time: float
    parameters: Mapping[str, float | int | bool]
    tolerances: Tolerances

    def columns(self) -> dict[str, list[float]]:
        """Return the numbers of the table by column, ``time`` first."""
        names, *rows = csv.reader(io.StringIO(self.table.decode()))
        if not rows:
            raise ValueError("no rows")
        columns = zip(*([float(text) for text in row] for row in rows), strict=True)
        return dict(zip(names, map(list, columns), strict=True))


def elements_of(block_class: type[Block]) -> dict[str, Variable]:
    """Return the variable that declares each element of a block, by the FMI name of the element."""
    return {name: variable for variable in block_class.variables.values() for name in variable.element_names()}


def read_check(block_class: type[Block]) -> Check | None:
    """Read a block's check, checks/NAME.csv and checks/NAME.toml next to the block's file; None without both.

    Raises CheckError, naming file and element, if only one of them exists or one does not fit the block.
    """
    source = getattr(sys.modules.get(block_class.__module__), "__file__", None)
    if source is None:
        return None
    folder = Path(source).parent / "checks"
    table, declarations = (folder / f"{block_class.fmu_name}{suffix}" for suffix in (TABLE, DECLARATIONS))
    missing = [path for path in (table, declarations) if not path.is_file()]
    if len(missing) == 1:
        raise CheckError(f"{missing[0]}: no such file; a check is a trajectory, .csv, and its tolerances, .toml")
    if missing:
        return None
    declared = _read_declarations(declarations)
    check = Check(
        table.read_bytes(),
        declared["truth"],
        float(declared["step_size"]),
        float(declared["stop_time"]),
        declared["parameters"],
        {name: (float(each["absolute"]), float(each["relative"])) for name, each in declared["tolerances"].items()},
    )
    _refuse_unknown(block_class, check, table, declarations)
    return check


def _read_declarations(path: Path) -> dict[str, Any]:
    try:
        declared = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise CheckError(f"{path}: not TOML: {error}") from None
    for key, kind in KEYS.items():
        value = declared.get(key)
        if not (_is_number(value) if kind is float else isinstance(value, kind)):
            raise CheckError(
                f"{path}: {key}: missing, or of another type than {kind.__name__}; write {key} as {kind.__name__}"
            )
    if declared["step_size"] <= 0.0:
        raise CheckError(f"{path}: step_size: {declared['step_size']:g} s; give a positive step")
    for name, bounds in declared["tolerances"].items():
        if not isinstance(bounds, dict) or any(not _is_number(bounds.get(key)) or bounds[key] < 0 for key in BOUNDS):
            raise CheckError(f"{path}: tolerances.{name}: write {{ absolute = 0.0, relative = 1e-9 }}")
    if not declared["tolerances"]:
        raise CheckError(f"{path}: tolerances: no output, so nothing is compared; add one")
    return declared


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _refuse_unknown(block_class: type[Block], check: Check, table: Path, declarations: Path) -> None:
    """Reject columns, tolerances and parameters that the block does not have."""
    elements = elements_of(block_class)
    try:
        columns = check.columns()
    except ValueError as error:
        raise CheckError(f"{table}: not a table of numbers: {error}") from None
    names = next(csv.reader(io.StringIO(check.table.decode())))
    if len(columns) < len(names):
        raise CheckError(f"{table}: line 1: two columns of the same name; remove one")
    if next(iter(columns), None) != TIME:
        raise CheckError(f"{table}: line 1: the first column is not {TIME}; write time, inputs, outputs")
    times = columns[TIME]
    for row, (earlier, later) in enumerate(pairwise([-math.inf, *times]), 1):
        if not math.isfinite(later):
            raise CheckError(f"{table}: row {row}, {TIME}: {later} is not finite; write a finite time")
        if later < earlier:
            raise CheckError(f"{table}: row {row}, {TIME}: {later!r} is before {earlier!r}; sort the rows by time")
    for name in check.tolerances:
        if name not in columns:
            problem = f"{table.name} has no such column; add the column, or remove the tolerance"
            raise CheckError(f"{declarations}: tolerances.{name}: {problem}")
    for name in columns:
        is_output = isinstance(elements.get(name), Output) and name in check.tolerances
        if name != TIME and not isinstance(elements.get(name), Input) and not is_output:
            raise CheckError(
                f"{table}: column {name}: neither an input nor an output with a tolerance; remove the column"
            )
    for name, number in check.parameters.items():
        variable = elements.get(name)
        if not isinstance(variable, Parameter | Input):
            raise CheckError(f"{declarations}: parameters.{name}: no such parameter; correct the name")
        types = PARAMETER_TYPES[variable.type_name]
        if type(number) not in types or not math.isfinite(number):
            kinds = " or ".join(each.__name__ for each in types)
            raise CheckError(
                f"{declarations}: parameters.{name}: {number!r} is not a finite {kinds}; correct the value"
            )
