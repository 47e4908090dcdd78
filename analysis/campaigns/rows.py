"""The trials of a variant, read part by part: what sums a campaign up holds no more of it than a part."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

from .verdicts.order_statistics import Blocks

Part = Mapping[str, np.ndarray]


class TrialRows(Protocol):
    """All trials of one variant, in order of number, an entry per trial in every column.

    Columns are named as in files of trials: ``trial``, ``status``, ``success``, ``end_time``, ``message``,
    ``metric.NAME``, ``draw.NAME``, ``final.NAME``.
    """

    def parts(self, *names: str) -> Iterator[Part]:
        """Some columns, trials in a row at a time."""
        ...


@dataclass(frozen=True)
class TrialColumns:
    """Trials of one variant in memory, one entry per trial: status, success, every metric and draw by name."""

    statuses: Sequence[str]
    success: np.ndarray
    metrics: Mapping[str, np.ndarray]
    draws: Mapping[str, np.ndarray] = field(default_factory=dict, kw_only=True)

    def parts(self, *names: str) -> Iterator[Part]:
        """See `TrialRows`."""
        yield {name: self.column(name) for name in names}

    def column(self, name: str) -> np.ndarray:
        """A column by the name that files of trials give it. Raises KeyError."""
        kind, _, own = name.partition(".")
        columns = {"metric": self.metrics, "draw": self.draws}
        if kind in columns:
            return np.asarray(columns[kind][own])
        return {"status": np.array(self.statuses, dtype=object), "success": np.asarray(self.success, dtype=bool)}[name]


def blocks(rows: TrialRows, name: str, where: str | None = None, value: float = 1.0) -> Blocks:
    """A column of numbers as blocks; of the trials in which the column ``where`` has that value, or of all."""

    def read() -> Iterator[np.ndarray]:
        for part in rows.parts(name, *(() if where is None else (where,))):
            values = np.asarray(part[name], dtype=float)
            yield values if where is None else values[part[where] == value]

    return read


def whole_column(rows: TrialRows, name: str) -> np.ndarray:
    """A column in memory (trials,)."""
    return np.concatenate([part[name] for part in rows.parts(name)])


@dataclass(frozen=True)
class _Held:
    """Trials of which some columns are in memory; the others are read."""

    rows: TrialRows
    columns: Part

    def parts(self, *names: str) -> Iterator[Part]:
        if self.columns.keys() >= set(names):
            yield {name: self.columns[name] for name in names}
        else:
            yield from self.rows.parts(*names)


def has_all_in_memory(rows: TrialRows, names: Sequence[str], most: int) -> TrialRows:
    """The same trials, these columns of theirs read once and kept, if they have no more than ``most`` values in all."""
    parts: list[Part] = []
    size = 0
    for part in rows.parts(*names):
        size += sum(map(len, part.values()))
        if size > most:
            return rows
        parts.append(part)
    return _Held(rows, {name: np.concatenate([part[name] for part in parts]) for name in names})
