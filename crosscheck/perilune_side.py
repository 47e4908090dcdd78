"""Flights of Perilune's FMUs for cross-checks, with commands over time."""

import tempfile
from pathlib import Path

import numpy as np

import perilune
from crosscheck.table import Table
from perilune.common.paths import shipped_fmu


def fly(
    block: str,
    step: float,
    duration: float,
    parameters: dict,
    outputs: dict[str, str],
    commands: dict[str, np.ndarray] | None = None,
    file: Path | None = None,
) -> Table:
    """Return the table of a block's FMU alone: each name with the output that it is, vectors by element.

    ``commands`` are inputs over time, held between their samples, ``time`` (s) among them. The FMU is Perilune's, or
    that of a block in a ``file``, exported as users export theirs.
    """
    if file:
        with tempfile.TemporaryDirectory() as folder:
            (fmu,) = perilune.export(file, output=f"{folder}/{block}.fmu", flavour="native").paths
            return fly_fmu(fmu, block, step, duration, parameters, outputs, commands)
    return fly_fmu(shipped_fmu(block, "native"), block, step, duration, parameters, outputs, commands)


def fly_fmu(
    fmu: Path,
    block: str,
    step: float,
    duration: float,
    parameters: dict,
    outputs: dict[str, str],
    commands: dict[str, np.ndarray] | None,
) -> Table:
    """Return the same of the FMU in a file."""
    inputs = {name if name == "time" else f"{block}.{name}": values for name, values in (commands or {}).items()}
    flight = perilune.simulate(
        fmu,
        step=step,
        stop_time=duration,
        set={f"{block}.{name}": setting for name, setting in parameters.items()},
        input=inputs or None,
    )
    return table_of(flight, {name: f"{block}.{output}" for name, output in outputs.items()})


def table_of(flight: perilune.Result, signals: dict[str, str]) -> Table:
    """Return the table of a flight: each name with the signal that it is, vectors by element."""
    table: Table = {"time": flight.time}
    for name, signal in signals.items():
        columns = flight[signal]
        rows = {name: columns} if columns.ndim == 1 else {f"{name}[{k + 1}]": row for k, row in enumerate(columns.T)}
        table.update(rows)
    return table


def sample(block: str, parameters: dict, inputs: dict[str, np.ndarray], outputs: dict[str, str]) -> Table:
    """Return the table of a block's FMU that samples its inputs every second: a row per input, the number for a time.

    A step sees the inputs of its begin, so the sample of row k is that of time k + 1. Vectors have a row per sample.
    """
    commands: dict[str, np.ndarray] = {}
    for name, rows in inputs.items():
        columns = {name: rows} if rows.ndim == 1 else {f"{name}[{k + 1}]": column for k, column in enumerate(rows.T)}
        commands |= {each: np.append(column, column[-1]) for each, column in columns.items()}
    number = len(next(iter(inputs.values())))
    time = np.arange(number + 1.0)
    table = fly(block, 1.0, float(number), parameters, outputs, {"time": time, **commands})
    return {name: column[1:] for name, column in table.items()} | {"time": time[:-1]}
