"""The trials that figures are drawn of: all of a campaign, or of a long one the first, and failures behind them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .trials import Part, TrialColumns, TrialRows

FIRST = 100_000  # trials of a variant
FAILURES = 20_000  # behind those


@dataclass(frozen=True)
class PlottedSample:
    """``first`` are the first trials of a variant, ``dots`` the same and failures behind them; of ``trials`` in all.

    ``failures`` is how many failures there are in all. Both have statuses, metrics and draws; ``numbers`` are those of
    the trials of ``dots``.
    """

    first: TrialColumns
    dots: TrialColumns
    numbers: np.ndarray
    trials: int
    failures: int

    @property
    def note(self) -> str:
        """What is left out, in words; nothing where nothing is."""
        if self.trials == len(self.first.success):
            return ""
        seen = int(np.count_nonzero(~self.dots.success))
        failures = "all failures" if seen == self.failures else f"{seen} of {self.failures} failures"
        return f"the first {FIRST} of {self.trials} trials; those over two values {failures}, too"


def select_trials(rows: TrialRows, draws: list[str], metrics: list[str]) -> PlottedSample:
    """What figures show of a variant's trials, with some draws and metrics."""
    names = ["trial", "status", "success", *(f"metric.{name}" for name in metrics), *(f"draw.{name}" for name in draws)]
    first: list[Part] = []
    behind: list[Part] = []
    trials = selected = failures = retained = 0
    for part in rows.parts(*names):
        success = part["success"]
        trials += len(success)
        failures += int(np.count_nonzero(~success))
        room = min(FIRST - selected, len(success))
        if room:
            first.append({name: values[:room] for name, values in part.items()})
            selected += room
        failed = room + np.flatnonzero(~success[room:])[: FAILURES - retained]
        if failed.size:
            behind.append({name: values[failed] for name, values in part.items()})
            retained += failed.size
    numbers = np.concatenate([part["trial"] for part in first + behind])
    return PlottedSample(_columns(first), _columns(first + behind), numbers, trials, failures)


def _columns(parts: list[Part]) -> TrialColumns:
    columns: Mapping[str, np.ndarray] = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}

    def of(kind: str) -> dict[str, np.ndarray]:
        return {name.removeprefix(kind): values for name, values in columns.items() if name.startswith(kind)}

    return TrialColumns(columns["status"].tolist(), columns["success"], of("metric."), draws=of("draw."))
