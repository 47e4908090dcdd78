"""A check as a value: a trajectory with tolerances, and its two files."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

Columns = dict[str, np.ndarray]

STEP = 0.125  # s; its multiples are exact


def follow(rows: np.ndarray) -> np.ndarray:
    """Return a direct output as FMPy reads it: at the start of the first row's inputs, then of
    those of the row before."""
    return np.concatenate([rows[:1], rows[:-1]])


def expand(values: Mapping[str, object], dimensions: int = 0) -> dict[str, np.ndarray]:
    """Return FMI names: a vector becomes name[1], name[2], ..., a matrix name[1,1], name[1,2], ..."""
    columns = {}
    for name, array in values.items():
        array = np.asarray(array)
        if array.ndim == dimensions:
            columns[name] = array
        elif array.ndim == dimensions + 2:
            rows, width = array.shape[-2:]
            columns |= {f"{name}[{i + 1},{k + 1}]": array[..., i, k] for i in range(rows) for k in range(width)}
        else:
            columns |= {f"{name}[{i + 1}]": array[..., i] for i in range(array.shape[-1])}
    return columns


@dataclass(frozen=True)
class Check:
    """Row n has the outputs at t_n and the inputs from t_n to t_(n+1).

    Vectors are arrays of (rows, elements). ``tolerances``: output -> (absolute, relative), for all its elements, or
    for one of them by its own name.
    """

    truth: str
    step: float
    inputs: Mapping[str, object]
    outputs: Mapping[str, object]
    tolerances: Mapping[str, tuple[float, float]]
    parameters: Mapping[str, object]

    def csv(self) -> str:
        columns = expand(self.inputs, 1) | expand(self.outputs, 1)
        rows = len(next(iter(columns.values())))
        columns = {"time": self.step * np.arange(rows)} | columns
        assert {len(column) for column in columns.values()} == {rows}
        table = zip(*(column.tolist() for column in columns.values()), strict=True)
        return "\n".join([",".join(columns), *(",".join(repr(float(number)) for number in row) for row in table), ""])

    def toml(self) -> str:
        rows = len(next(iter(expand(self.outputs, 1).values())))
        lines = [
            f"truth = {json.dumps(self.truth)}",
            f"step_size = {self.step!r}",
            f"stop_time = {self.step * (rows - 1)!r}",
            "",
            "[parameters]",
            *(f"{json.dumps(name)} = {json.dumps(array.item())}" for name, array in expand(self.parameters).items()),
            "",
            "# |output - reference| <= absolute + relative |reference|",
            "[tolerances]",
        ]
        for name, array in self.outputs.items():
            for column in expand({name: array}, 1):
                absolute, relative = self.tolerances.get(column, self.tolerances[name])
                lines.append(f"{json.dumps(column)} = {{ absolute = {absolute!r}, relative = {relative!r} }}")
        return "\n".join([*lines, ""])

    def write(self, folder: Path, name: str) -> None:
        folder.mkdir(exist_ok=True)
        (folder / f"{name}.csv").write_text(self.csv(), encoding="utf-8")
        (folder / f"{name}.toml").write_text(self.toml(), encoding="utf-8")


def read_declarations(text: bytes) -> dict:
    return tomllib.loads(text.decode())
