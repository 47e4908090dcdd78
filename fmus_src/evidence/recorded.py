"""Recorded outputs of a block for its check, bit for bit as its FMU computes them on every processor."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence

from ..block import Block
from ..runtime import BlockInstance
from ..variables import Input, Variable
from .check import TIME, Check, CheckError, elements_of


def record_outputs(block_class: type[Block], check: Check) -> bytes:
    """Return a CSV table of time (s) and outputs for the inputs and parameters of a check.

    Raises CheckError if the block raises an exception.
    """
    try:
        return _record(block_class, check)
    except Exception as error:  # any exception from a user's block is reported in one line
        problem = f"the block raises {type(error).__name__}: {error}"
        raise CheckError(f"{block_class.fmu_name}: check: {problem}; correct the block or the check") from error


def _record(block_class: type[Block], check: Check) -> bytes:
    elements = elements_of(block_class)
    references = {name: index for index, name in enumerate(elements)}
    columns = check.columns()
    inputs = [name for name in columns if isinstance(elements.get(name), Input)]
    outputs = list(check.tolerances)
    component = BlockInstance(block_class)
    for name, number in check.parameters.items():
        component.set([references[name]], [of_type(elements[name], number)])
    times = columns[TIME]
    component.start_time = times[0]
    rows = []
    for row, time in enumerate(times):
        if row:
            component.do_step(times[row - 1], time - times[row - 1])
        values = [_sample(elements[name], columns[name], row) for name in inputs]
        component.set([references[name] for name in inputs], values)
        if not row:
            component.start()
        rows.append([repr(time), *map(_text, component.get([references[name] for name in outputs]))])
    return write_table([TIME, *outputs], rows)


def write_table(names: Sequence[str], rows: Iterable[Sequence[str]]) -> bytes:
    """Return a CSV table; names that contain commas, as for matrix elements, are quoted."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([names, *rows])
    return text.getvalue().encode()


def _sample(variable: Variable, samples: list[float], row: int) -> float | int | bool:
    """Return an input at a row's time as importers interpolate a continuous input: 0 * before + 1 * here.

    The result equals the sample ``here``, except if that is -0.0 or if ``before`` is not finite.
    """
    if variable.type_name == "Real" and row:
        return 0.0 * samples[row - 1] + 1.0 * samples[row]
    return of_type(variable, samples[row])


def of_type(variable: Variable, number: float | int | bool) -> float | int | bool:
    """Return a number of a check as the Python type of its variable."""
    return {"Real": float, "Boolean": bool}.get(variable.type_name, int)(number)


def _text(number: float | int | bool) -> str:
    return repr(number) if isinstance(number, float) else str(int(number))
