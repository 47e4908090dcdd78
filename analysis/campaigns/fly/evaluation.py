"""What flights of one variant come to: metrics, success, records, looked at together where that is possible.

A metric of the end needs a flight's last row only: these rows are collected, and each expression is worked out once for
a task's flights. A metric over time is worked out as soon as its flight is there, since the next one takes its place.
"""

from __future__ import annotations

import math
import re
from collections import ChainMap
from collections.abc import Iterable

import numpy as np

from ...runtime.flight.results import Flight
from ..spec.campaign import Campaign
from ..spec.checks import VariantNames
from ..spec.metrics import TIME, evaluate_metric, is_of_the_end, successes
from ..spec.plan import DrawnTrials
from ..trials import Trials

Traces = dict[str, np.ndarray]


class Judge:
    """Takes flights of a variant, one after the other, and gives what they have come to."""

    def __init__(self, campaign: Campaign, names: VariantNames) -> None:
        self._campaign = campaign
        self._names = names
        self._at_end = [metric for metric in campaign.metrics if is_of_the_end(metric)]
        self._over_time = [metric for metric in campaign.metrics if not is_of_the_end(metric)]
        ends = {name for metric in self._at_end for name in metric.names}
        sampled = set(campaign.input_names())
        self._signals = sorted(ends & set(names.signals))
        self._last_of = sorted({*self._signals, *campaign.record.final})
        self._drawn = sorted((ends & sampled) - set(names.signals))
        self._needs_draws = any(sampled & metric.names for metric in self._over_time)
        self._begin()

    def _begin(self) -> None:
        self._rows: list[list[float]] = []
        self._metrics: list[list[float]] = []
        self._finals: list[list[float]] = []
        self._trials: list[int] = []
        self._statuses: list[str] = []
        self._end_times: list[float] = []
        self._complete: list[bool] = []
        self._messages: dict[int, str] = {}
        self._traces: dict[int, Traces] = {}

    def add(self, flight: Flight, trial: int, drawn: DrawnTrials) -> None:
        """Look at a flight; nothing of it is needed afterwards."""
        signals, complete = flight.signals, flight.complete
        lasts = {name: _last(signals[name]) for name in self._last_of}
        end = _last(flight.time)
        row = drawn.row(trial) if self._drawn or self._needs_draws else {}
        self._rows.append([end, *(lasts[name] for name in self._signals), *(row[name] for name in self._drawn)])
        values = {**self._names.constants, **row, **signals, TIME: flight.time}
        metrics = [evaluate_metric(metric, flight.time, values) if complete else np.nan for metric in self._over_time]
        self._metrics.append(metrics)
        self._finals.append([lasts[name] for name in self._campaign.record.final])
        self._trials.append(trial)
        self._statuses.append(trial_status(flight, self._names.statuses))
        self._end_times.append(end)
        self._complete.append(complete)
        if not complete:
            self._messages[trial] = flight.message
        traces = self._select_signals(flight, trial)
        if traces is not None:
            self._traces[trial] = traces

    def _select_signals(self, flight: Flight, trial: int) -> Traces | None:
        """Copies of what the campaign keeps over time: sampled signals, or everything of some trials."""
        record = self._campaign.record
        if record.traces == "all" or (record.traces == "failures" and not self._success(len(self._rows) - 1)[-1]):
            return {"time": flight.time.copy()} | {name: values.copy() for name, values in flight.signals.items()}
        if record.every is not None and (record.trials is None or trial < record.trials):
            rows = slice(None, None, record.every)
            return {"time": flight.time[rows].copy()} | {
                name: flight.signals[name][rows].copy() for name in record.signals
            }
        return None

    def trials(self) -> Trials:
        """What the flights since the last call have come to; there is one or more."""
        trials = Trials(
            statuses=self._statuses,
            success=self._success(),
            metrics=self._columns(),
            trial=np.array(self._trials),
            end_time=np.array(self._end_times),
            messages=self._messages,
            final=dict(zip(self._campaign.record.final, np.array(self._finals).T.copy(), strict=True)),
            traces=self._traces,
        )
        self._begin()
        return trials

    def _columns(self, first: int = 0) -> dict[str, np.ndarray]:
        """All metrics of the flights from ``first`` on, in the campaign's order."""
        complete = np.array(self._complete[first:])
        names = [TIME, *self._signals, *self._drawn]
        rows = np.ascontiguousarray(np.array(self._rows[first:]).T)
        values = ChainMap(dict(zip(names, rows, strict=True)), dict(self._names.constants))
        over_time = np.array(self._metrics[first:]).reshape(len(complete), -1).T
        columns = dict(zip((metric.name for metric in self._over_time), over_time.copy(), strict=True))
        for metric in self._at_end:
            column = np.broadcast_to(metric.expression.evaluate(values), complete.shape)
            columns[metric.name] = np.where(complete, column, np.nan)
        return {metric.name: columns[metric.name] for metric in self._campaign.metrics}

    def _success(self, first: int = 0) -> np.ndarray:
        """Which of the flights from ``first`` on are successes."""
        complete = np.array(self._complete[first:])
        return successes(self._campaign.success, self._columns(first), complete.size) & complete


def _last(values: np.ndarray) -> float:
    """The last of values over time, nan where there is none."""
    return values.item(values.size - 1) if values.size else math.nan


WORST = re.compile(r"([^\s(),]+) (-?\d+)[,)]")


def trial_status(result: Flight, statuses: Iterable[str]) -> str:
    """How a trial ended, with the worst status of every component that reported other than 0.

    For instance ``finished`` or ``finished (guidance.status 2)``.
    """
    worst: list[str] = []
    for name in statuses:
        values = result.signals[name]
        status = int(values.max()) if values.size else 0
        if status:
            worst.append(f"{name} {status}")
    return f"{result.status} ({', '.join(worst)})" if worst else result.status


def worst_statuses(text: str) -> dict[str, int]:
    """What `trial_status` says in its brackets: the worst status other than 0 by the signal that reported it."""
    return {name: int(value) for name, value in WORST.findall(text)}
