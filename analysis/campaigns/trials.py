"""Table of a variant's trials in memory; the table that reads the shards of a folder is in `execute/store.py`."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from copy import copy
from typing import Self

import numpy as np
import pyarrow

from ...common.machine.arrow import numbers_of, numpy_of, table_of, texts_of
from .trial_columns import Describe, with_metadata
from .verdicts.order_statistics import Blocks

Trace = dict[str, np.ndarray]  # signals by name, and ``time`` (s)
Member = tuple[str, Callable[[np.ndarray], np.ndarray]]  # a column, and a function: True for entries in a group


class TrialTable:
    """Trials of one variant, in order of number, with an entry for each trial in every column.

    Columns are named as in files of trials: ``trial``, ``status``, ``success``, ``message`` (why the trial failed, else
    empty), ``end_time`` (s), ``draw.NAME``, ``final.NAME``, ``metric.NAME``.
    """

    _describe: Describe | None = None

    def __init__(self, table: pyarrow.Table, traces: Mapping[int, Trace] | None = None) -> None:
        self._table = table
        self._traces = {} if traces is None else dict(traces)

    @classmethod
    def of(
        cls, columns: Mapping[str, np.ndarray | Sequence[str]], traces: Mapping[int, Trace] | None = None
    ) -> TrialTable:
        """Return the table of columns by name: numbers or Booleans (trials,), or texts; ``traces`` are by trial."""
        return cls(
            table_of(
                {
                    name: column if isinstance(column, np.ndarray) and column.dtype != object else texts_of(column)
                    for name, column in columns.items()
                }
            ),
            traces,
        )

    @property
    def table(self) -> pyarrow.Table:
        """All columns in memory."""
        return self._table

    @property
    def schema(self) -> pyarrow.Schema:
        """Columns in order; described columns have metadata: kind, meaning and unit."""
        schema = self._schema.remove_metadata()
        return schema if self._describe is None else with_metadata(schema, self._describe)

    @property
    def _schema(self) -> pyarrow.Schema:
        return self._table.schema

    @property
    def names(self) -> list[str]:
        """Names of the columns in order."""
        return list(self._schema.names)

    def described(self, describe: Describe) -> Self:
        """Return the same trials with descriptions of their columns."""
        trials = copy(self)
        trials._describe = describe
        return trials

    def _like(self, table: pyarrow.Table, traces: Mapping[int, Trace] | None = None) -> TrialTable:
        """Return another table with this table's descriptions of columns."""
        trials = TrialTable(table, traces)
        trials._describe = self._describe
        return trials

    def units(self, prefix: str) -> dict[str, str]:
        """Return the units of columns whose names begin with a prefix, by the remaining name; "1" if undeclared."""
        fields = {field.name: field.metadata or {} for field in self.schema if field.name.startswith(prefix)}
        return {name.removeprefix(prefix): about.get(b"unit", b"1").decode() for name, about in fields.items()}

    def __len__(self) -> int:
        return int(self._table.num_rows)

    def tables(self, names: Sequence[str]) -> Iterator[pyarrow.Table]:
        """Yield some columns for blocks of consecutive trials."""
        yield self._table.select(names)

    def traced(self) -> list[int]:
        """Return the trials with a trace, in order. In a folder they may be traces of another batch."""
        return sorted(self._traces)

    def trace(self, trial: int, names: Collection[str] | None = None) -> Trace | None:
        """Return a trial's trace of these signals (default: all) and ``time`` (s), or None if it has no trace.

        Raises InputError for a damaged file.
        """
        if trial not in self._traces:
            return None
        signals = self._traces[trial].items()
        return {name: values for name, values in signals if names is None or name in names or name == "time"}

    def whole(self) -> TrialTable:
        """Return the table in memory, with all traces."""
        return self

    def parts(self, *names: str, members: Sequence[Member] = ()) -> Iterator[dict[str, np.ndarray]]:
        """Yield columns as numpy arrays for blocks of trials; with ``members``, only trials in all of these groups."""
        needed = list(dict.fromkeys((*names, *(name for name, _ in members))))
        for table in self.tables(needed):
            columns = {name: numpy_of(table[name]) for name in needed}
            for name, is_in in members:
                rows = is_in(columns[name])
                columns = {each: values[rows] for each, values in columns.items()}
            yield {name: columns[name] for name in names}

    def blocks(self, name: str, members: Sequence[Member] = ()) -> Blocks:
        """Return a numeric column as blocks; with ``members``, only of trials in all of these groups."""
        return lambda: (np.asarray(part[name], dtype=float) for part in self.parts(name, members=members))

    def column(self, name: str) -> np.ndarray:
        """Return a column in memory (trials,). Raises KeyError."""
        return self._columns([name])[name]

    def _columns(self, names: Sequence[str]) -> dict[str, np.ndarray]:
        first, *others = self.parts(*names)
        if not others:
            return first
        return {name: np.concatenate([values, *(part[name] for part in others)]) for name, values in first.items()}

    def in_memory(self, names: Sequence[str], most: int) -> TrialTable:
        """Return a table with these columns in memory, or this table if they have more than ``most`` numbers."""
        tables: list[pyarrow.Table] = []
        size = 0
        for table in self.tables(names):
            size += table.num_rows * sum(not pyarrow.types.is_string(column.type) for column in table.itercolumns())
            if size > most:
                return self
            tables.append(table)
        return self._like(pyarrow.concat_tables(tables).combine_chunks())

    def part(self, numbers: range) -> TrialTable:
        """Return the trials with consecutive ``numbers``."""
        first, end = np.searchsorted(self.trial, [numbers.start, numbers.stop]).tolist()
        traces = {trial: trace for trial, trace in self.traces.items() if trial in numbers}
        return self._like(self.table.slice(first, end - first), traces)

    def renumber(self, first: int) -> TrialTable:
        """Return the table with all trial numbers increased by ``first``."""
        numbers = numbers_of(self.trial + first)
        table = self.table.set_column(self.names.index("trial"), "trial", numbers)
        return self._like(table, {trial + first: trace for trial, trace in self.traces.items()})

    @property
    def trial(self) -> np.ndarray:
        """Numbers of the trials (trials,)."""
        return self.column("trial")

    @property
    def statuses(self) -> list[str]:
        """Status of each trial, with the worst status that components reported."""
        return list(self.column("status").tolist())

    @property
    def success(self) -> np.ndarray:
        """True for each successful trial (trials,)."""
        return np.asarray(self.column("success"), dtype=bool)

    @property
    def end_time(self) -> np.ndarray:
        """Times (s) of the last rows (trials,)."""
        return self.column("end_time")

    @property
    def messages(self) -> dict[int, str]:
        """Reasons why trials failed, a text for each trial."""
        columns = self._columns(["trial", "message"])
        numbers, texts = columns.values()
        return {int(numbers[row]): texts[row] for row in np.flatnonzero(texts != "")}

    @property
    def flown(self) -> np.ndarray:
        """True for each trial that reached its end (trials,)."""
        return np.asarray(self.column("message") == "", dtype=bool)

    @property
    def traces(self) -> dict[int, Trace]:
        """Traces in memory, by trial."""
        return self._traces

    @property
    def metrics(self) -> dict[str, np.ndarray]:
        """All metrics by name, each (trials,)."""
        return self._kind("metric.")

    @property
    def draws(self) -> dict[str, np.ndarray]:
        """All drawn and derived values by name, each (trials,)."""
        return self._kind("draw.")

    @property
    def final(self) -> dict[str, np.ndarray]:
        """Last values of the signals recorded as final values, by name, each (trials,)."""
        return self._kind("final.")

    def _kind(self, prefix: str) -> dict[str, np.ndarray]:
        names = [name for name in self.names if name.startswith(prefix)]
        return {name.removeprefix(prefix): values for name, values in self._columns(names).items()}


def join_trials(parts: Iterable[TrialTable]) -> TrialTable:
    """Join the tables of one variant, in any order, into one in order of trial."""
    ordered = sorted(parts, key=lambda part: int(part.trial[0]))
    traces = {trial: trace for part in ordered for trial, trace in part.traces.items()}
    if len(ordered) == 1:
        return ordered[0]
    tables = [part.table for part in ordered]
    return ordered[0]._like(pyarrow.concat_tables(tables, promote_options="permissive").combine_chunks(), traces)
