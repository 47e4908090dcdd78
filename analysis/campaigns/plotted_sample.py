"""Trials shown in figures: all trials of a campaign or, if it is long, the first trials and later failures."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pyarrow

from ...common.machine.arrow import numpy_of
from .trials import TrialTable

FIRST = 100_000  # most of the first trials of a variant
FAILURES = 20_000  # most of the later failures


@dataclass(frozen=True)
class PlottedSample:
    """Sample for figures: ``dots`` contains the first trials of a variant and later failures.

    ``trials`` and ``failures`` are the numbers of all trials and of all failures.
    """

    dots: TrialTable
    trials: int
    failures: int

    @cached_property
    def first(self) -> TrialTable:
        """First trials, without later failures."""
        return self.dots.part(range(FIRST))

    @property
    def note(self) -> str:
        """Note on omitted trials; "" if no trials are omitted."""
        if self.trials == len(self.first):
            return ""
        plotted = int(np.count_nonzero(~self.dots.success))
        failures = "all failures" if plotted == self.failures else f"{plotted} of {self.failures} failures"
        return f"the first {FIRST} of {self.trials} trials; scatter plots also show {failures}"


def select_trials(rows: TrialTable, draws: list[str], metrics: list[str]) -> PlottedSample:
    """Return the sample of a variant's trials for figures, with these draws and metrics."""
    names = ["trial", "status", "success", *(f"metric.{name}" for name in metrics), *(f"draw.{name}" for name in draws)]
    chosen: list[pyarrow.Table] = []
    trials = failures = retained = 0
    for table in rows.tables(names):
        success = numpy_of(table["success"])
        room = min(max(FIRST - trials, 0), len(success))
        failed = room + np.flatnonzero(~success[room:])[: FAILURES - retained]
        chosen += [table.slice(0, room)] if room else []  # even an empty slice would keep its shard in memory
        chosen += [table.take(pyarrow.array(failed))] if failed.size else []
        trials += len(success)
        failures += int(np.count_nonzero(~success))
        retained += failed.size
    return PlottedSample(TrialTable(pyarrow.concat_tables(chosen).combine_chunks()), trials, failures)
