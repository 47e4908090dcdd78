"""Tables of flights, which both codes write, and their differences. Needs numpy alone."""

import csv
from pathlib import Path

import numpy as np

from crosscheck.case import ATTITUDE, Case

Table = dict[str, np.ndarray]
SAME_TIME = 1e-9  # s


def write_table(path: Path, table: Table) -> None:
    """Write columns, time first, each number exactly."""
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(table)
        writer.writerows([repr(float(number)) for number in row] for row in zip(*table.values(), strict=True))


def read_table(path: Path) -> Table:
    """Read the columns of a table."""
    with path.open(newline="") as file:
        names, *rows = csv.reader(file)
    numbers = np.array([[float(text) for text in row] for row in rows])
    return dict(zip(names, numbers.T, strict=True))


def at_common_times(ours: Table, other: Table) -> tuple[Table, Table]:
    """Return the rows of both that are at the same times; raises ValueError where there is none."""
    times = other["time"]
    nearest = np.clip(np.searchsorted(times, ours["time"] - SAME_TIME), 0, times.size - 1)
    same = np.abs(times[nearest] - ours["time"]) <= SAME_TIME
    if not same.any():
        raise ValueError("no common times")
    first = {name: column[same] for name, column in ours.items()}
    return first, {name: column[nearest[same]] for name, column in other.items()}


def differences(case: Case, ours: Table, other: Table) -> dict[str, np.ndarray]:
    """Return the distance of both at each common time, by quantity: length of the difference,
    or angle between attitudes."""
    first, second = at_common_times(ours, other)
    apart = {}
    for name, (unit, columns) in case.quantities.items():
        a, b = (np.stack([table[column] for column in columns]) for table in (first, second))
        apart[name] = angles_between(a, b) if (unit, columns) == ATTITUDE else np.linalg.norm(a - b, axis=0)
    return {"time": first["time"], **apart}


def angles_between(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Return angles (rad) of the turns between attitudes, quaternions [4, n] of any length and sign."""
    a, b = (quaternion / np.linalg.norm(quaternion, axis=0) for quaternion in (first, second))
    vector = a[0] * b[1:] - b[0] * a[1:] - np.cross(a[1:], b[1:], axis=0)
    return 2.0 * np.arcsin(np.minimum(np.linalg.norm(vector, axis=0), 1.0))


def rows_table(**vectors: np.ndarray) -> Table:
    """Return the table of quantities at inputs, a row per input, its number in place of time; vectors by element."""
    table: Table = {"time": np.arange(float(len(next(iter(vectors.values())))))}
    for name, rows in vectors.items():
        table |= {f"{name}[{k + 1}]": column for k, column in enumerate(np.asarray(rows, dtype=float).T)}
    return table
