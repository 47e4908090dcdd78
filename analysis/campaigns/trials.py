"""The trials of a variant as columns, in memory or read part by part."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
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


@dataclass(frozen=True)
class Trials(TrialColumns):
    """Trials of one variant, an entry per trial in every column.

    ``trial`` are their numbers, ``end_time`` is in s, ``messages`` explain failed flights,
    ``final`` and ``traces`` (by trial) are what the campaign records beside the metrics.
    """

    trial: np.ndarray
    end_time: np.ndarray
    messages: dict[int, str]
    final: dict[str, np.ndarray]
    traces: dict[int, dict[str, np.ndarray]]

    def __len__(self) -> int:
        return len(self.trial)

    def whole(self) -> Trials:
        """Already in memory: returns itself."""
        return self

    def traced(self) -> list[int]:
        """The trials with a trace, in order."""
        return sorted(self.traces)

    def trace(self, trial: int, names: Collection[str]) -> dict[str, np.ndarray] | None:
        """What a trial has recorded of these signals, and ``time`` (s); None where it has no trace."""
        if trial not in self.traces:
            return None
        return {name: values for name, values in self.traces[trial].items() if name in names or name == "time"}

    def column(self, name: str) -> np.ndarray:
        kind, _, own = name.partition(".")
        if kind == "final":
            return self.final[own]
        if name == "message":
            return np.array([self.messages.get(trial, "") for trial in self.trial.tolist()], dtype=object)
        return getattr(self, name) if name in ("trial", "end_time") else super().column(name)

    def part(self, numbers: range) -> Trials:
        """Those with some consecutive numbers; trials are in order of number."""
        first, end = (int(np.searchsorted(self.trial, number)) for number in (numbers.start, numbers.stop))
        rows = slice(first, end)
        return Trials(
            statuses=list(self.statuses[rows]),
            success=self.success[rows],
            metrics={name: values[rows] for name, values in self.metrics.items()},
            trial=self.trial[rows],
            end_time=self.end_time[rows],
            messages={trial: text for trial, text in self.messages.items() if trial in numbers},
            final={name: values[rows] for name, values in self.final.items()},
            traces={trial: traces for trial, traces in self.traces.items() if trial in numbers},
            draws={name: values[rows] for name, values in self.draws.items()},
        )

    @property
    def flown(self) -> np.ndarray:
        """Which flights came to their end (trials,)."""
        return np.array([int(trial) not in self.messages for trial in self.trial])

    def renumber(self, first: int) -> Trials:
        """The same with other numbers, as many higher."""
        return replace(
            self,
            trial=self.trial + first,
            messages={trial + first: text for trial, text in self.messages.items()},
            traces={trial + first: traces for trial, traces in self.traces.items()},
        )


def join_trials(parts: Iterable[Trials]) -> Trials:
    """Parts of one variant, in any order, as one in order of trial."""
    ordered = sorted(parts, key=lambda part: int(part.trial[0]))
    first = ordered[0]
    return Trials(
        statuses=[status for part in ordered for status in part.statuses],
        success=np.concatenate([part.success for part in ordered]),
        metrics={name: np.concatenate([part.metrics[name] for part in ordered]) for name in first.metrics},
        trial=np.concatenate([part.trial for part in ordered]),
        end_time=np.concatenate([part.end_time for part in ordered]),
        messages={trial: text for part in ordered for trial, text in part.messages.items()},
        final={name: np.concatenate([part.final[name] for part in ordered]) for name in first.final},
        traces={trial: traces for part in ordered for trial, traces in part.traces.items()},
        draws={name: np.concatenate([part.draws[name] for part in ordered]) for name in first.draws},
    )
