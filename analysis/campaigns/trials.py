"""The trials of a variant as one table, in memory; `execute/store.py` has the one that reads the shards of a folder."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from copy import copy
from typing import Self

import numpy as np
import pyarrow

from ...common.machine.arrow import numbers_of, numpy_of, table_of, texts_of
from .columns import Describe, with_metadata
from .verdicts.order_statistics import Blocks

Trace = dict[str, np.ndarray]  # signals by name, and ``time`` (s)
Member = tuple[str, Callable[[np.ndarray], np.ndarray]]  # a column, and which of its entries are in a group


class TrialTable:
    """Trials of one variant, in order of number, an entry per trial in every column.

    Columns are named as in files of trials: ``trial``, ``status``, ``success``, ``message`` (why the flight failed,
    empty where it did not), ``end_time`` (s), ``draw.NAME``, ``final.NAME``, ``metric.NAME``.
    """

    _describe: Describe | None = None

    def __init__(self, table: pyarrow.Table, traces: Mapping[int, Trace] | None = None) -> None:
        self._table = table
        self._traces = {} if traces is None else dict(traces)

    @classmethod
    def of(
        cls, columns: Mapping[str, np.ndarray | Sequence[str]], traces: Mapping[int, Trace] | None = None
    ) -> TrialTable:
        """Return the table of columns by name: numbers or truths (trials,), or texts; ``traces`` are by trial."""
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
        """The columns in their order, with the metadata of each: kind, meaning and unit, where they are described."""
        schema = self._schema.remove_metadata()
        return schema if self._describe is None else with_metadata(schema, self._describe)

    @property
    def _schema(self) -> pyarrow.Schema:
        return self._table.schema

    @property
    def names(self) -> list[str]:
        """The columns in their order."""
        return list(self._schema.names)

    def described(self, describe: Describe) -> Self:
        """Return the same trials with descriptions of their columns."""
        trials = copy(self)
        trials._describe = describe
        return trials

    def _like(self, table: pyarrow.Table, traces: Mapping[int, Trace] | None = None) -> TrialTable:
        """Return other trials whose columns mean the same."""
        trials = TrialTable(table, traces)
        trials._describe = self._describe
        return trials

    def units(self, prefix: str) -> dict[str, str]:
        """Return the units of the columns whose names begin so, by the rest of the name; "1" where there is none."""
        fields = {field.name: field.metadata or {} for field in self.schema if field.name.startswith(prefix)}
        return {name.removeprefix(prefix): about.get(b"unit", b"1").decode() for name, about in fields.items()}

    def __len__(self) -> int:
        return int(self._table.num_rows)

    def tables(self, names: Sequence[str]) -> Iterator[pyarrow.Table]:
        """Yield some columns, consecutive trials at a time."""
        yield self._table.select(names)

    def traced(self) -> list[int]:
        """Return the trials with a trace, in order; of a folder those with a file of one, which may be another
        batch's."""
        return sorted(self._traces)

    def trace(self, trial: int, names: Collection[str] | None = None) -> Trace | None:
        """Return a trial's record of these signals, or of all, and ``time`` (s); None where it has no trace.

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
        """Yield some columns in numpy, consecutive trials at a time; of the trials that are in all of some groups."""
        needed = list(dict.fromkeys((*names, *(name for name, _ in members))))
        for table in self.tables(needed):
            columns = {name: numpy_of(table[name]) for name in needed}
            for name, is_in in members:
                rows = is_in(columns[name])
                columns = {each: values[rows] for each, values in columns.items()}
            yield {name: columns[name] for name in names}

    def blocks(self, name: str, members: Sequence[Member] = ()) -> Blocks:
        """Return a column of numbers as blocks; of the trials that are in all of some groups."""
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
        """Read these columns once, if they have no more than ``most`` numbers in all; otherwise
        return the table itself."""
        tables: list[pyarrow.Table] = []
        size = 0
        for table in self.tables(names):
            size += table.num_rows * sum(not pyarrow.types.is_string(column.type) for column in table.itercolumns())
            if size > most:
                return self
            tables.append(table)
        return self._like(pyarrow.concat_tables(tables).combine_chunks())

    def part(self, numbers: range) -> TrialTable:
        """Return the trials with some consecutive numbers."""
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
        """Ending of each flight, and the worst status that components had."""
        return list(self.column("status").tolist())

    @property
    def success(self) -> np.ndarray:
        """Success of each trial (trials,)."""
        return np.asarray(self.column("success"), dtype=bool)

    @property
    def end_time(self) -> np.ndarray:
        """Times of the last rows (trials,), s."""
        return self.column("end_time")

    @property
    def messages(self) -> dict[int, str]:
        """Why flights failed, by trial."""
        columns = self._columns(["trial", "message"])
        numbers, texts = columns.values()
        return {int(numbers[row]): texts[row] for row in np.flatnonzero(texts != "")}

    @property
    def flown(self) -> np.ndarray:
        """True for each flight that reached its end (trials,)."""
        return np.asarray(self.column("message") == "", dtype=bool)

    @property
    def traces(self) -> dict[int, Trace]:
        """All traces, by trial."""
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
        """Last values of the signals of which they are recorded, by name, each (trials,)."""
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
