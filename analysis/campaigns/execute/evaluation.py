"""What flights of one variant come to: metrics, success, records, looked at together where that is possible.

A metric of the end needs a flight's last row only: these rows are collected, and each expression is worked out once for
a task's flights. A metric over time is worked out as soon as its flights are there, since the next ones take their
place.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...runtime.flight.group import FlightGroup
from ..definition.campaign import Campaign
from ..definition.checks import VariantNames
from ..definition.metrics import TIME, evaluate_metric, is_of_the_end, successes
from ..definition.plan import DrawnTrials
from ..definition.reductions import largest
from ..trials import Trials

Traces = dict[str, np.ndarray]


class Judge:
    """Takes flights of a variant, one group behind the other, and gives what they have come to."""

    def __init__(self, campaign: Campaign, names: VariantNames) -> None:
        self._campaign = campaign
        self._names = names
        self._at_end = [metric for metric in campaign.metrics if is_of_the_end(metric)]
        self._over_time = [metric for metric in campaign.metrics if not is_of_the_end(metric)]
        ends = {name for metric in self._at_end for name in metric.names}
        sampled = set(campaign.input_names())
        signals = sorted(ends & set(names.signals))
        self._last_of = sorted({*signals, *campaign.record.final})
        self._draws_at_end = sorted((ends & sampled) - set(names.signals))
        self._draws_over_time = sorted(sampled & {name for metric in self._over_time for name in metric.names})
        self._begin()

    def _begin(self) -> None:
        self._seen: list[_Seen] = []
        self._statuses: list[str] = []
        self._messages: dict[int, str] = {}
        self._traces: dict[int, Traces] = {}

    def add(self, group: FlightGroup, trials: range, sampled: DrawnTrials) -> None:
        """Look at flights of these trials; nothing of them is needed afterwards."""
        signals, draws = group.signals, sampled.columns_of(trials)
        lengths = group.ends - group.starts
        rows = {name: np.repeat(draws[name], lengths) for name in self._draws_over_time}
        values: Mapping[str, np.ndarray | float] = {**self._names.constants, **rows, **signals, TIME: group.time}
        seen = _Seen(
            trial=np.arange(trials.start, trials.stop),
            complete=group.complete,
            end_time=group.last(group.time),
            last={name: group.last(signals[name]) for name in self._last_of},
            draws={name: draws[name] for name in self._draws_at_end},
            metrics={
                metric.name: evaluate_metric(metric, group.time, values, group.ends) for metric in self._over_time
            },
        )
        self._seen.append(seen)
        self._statuses += trial_statuses(group, self._names.statuses)
        for flight in np.flatnonzero(~group.complete).tolist():
            self._messages[trials[flight]] = group.messages[flight]
        self._keep_signals(group, trials, seen)

    def _keep_signals(self, group: FlightGroup, trials: range, seen: _Seen) -> None:
        """Copies of what the campaign keeps of flights over time: sampled signals, or everything of some trials."""
        record = self._campaign.record
        if record.traces == "none" and record.every is None:
            return
        sampled = record.every is not None and (record.trials is None or seen.trial < record.trials)
        everything = ~self._success(seen) if record.traces == "failures" else record.traces == "all"
        everything, sampled = (np.broadcast_to(which, len(trials)) for which in (everything, sampled))
        for flight in np.flatnonzero(everything | sampled).tolist():
            rows = group.rows(flight)
            names: Iterable[str] = group.signals
            if not everything[flight]:
                rows, names = slice(rows.start, rows.stop, record.every), record.signals
            self._traces[trials[flight]] = {"time": group.time[rows].copy()} | {
                name: group.signals[name][rows].copy() for name in names
            }

    def trials(self) -> Trials:
        """What the flights since the last call have come to; there is one or more."""
        seen = _join(self._seen)
        trials = Trials(
            statuses=self._statuses,
            success=self._success(seen),
            metrics=self._columns(seen),
            trial=seen.trial,
            end_time=seen.end_time,
            messages=self._messages,
            final={name: seen.last[name] for name in self._campaign.record.final},
            traces=self._traces,
        )
        self._begin()
        return trials

    def _columns(self, seen: _Seen) -> dict[str, np.ndarray]:
        """All metrics of flights, in the campaign's order."""
        values = {**self._names.constants, **seen.draws, **seen.last, TIME: seen.end_time}
        columns = dict(seen.metrics)
        for metric in self._at_end:
            columns[metric.name] = np.broadcast_to(metric.expression.evaluate(values), seen.complete.shape)
        return {metric.name: np.where(seen.complete, columns[metric.name], np.nan) for metric in self._campaign.metrics}

    def _success(self, seen: _Seen) -> np.ndarray:
        """Which of these flights are successes."""
        return successes(self._campaign.success, self._columns(seen), seen.complete.size) & seen.complete


@dataclass
class _Seen:
    """What is needed of flights once their rows are gone, an entry for each in all columns."""

    trial: np.ndarray
    complete: np.ndarray
    end_time: np.ndarray
    last: dict[str, np.ndarray]  # last values of signals
    draws: dict[str, np.ndarray]
    metrics: dict[str, np.ndarray]  # over time


def _join(groups: Sequence[_Seen]) -> _Seen:
    if len(groups) == 1:
        return groups[0]

    def columns(tables: Sequence[dict[str, np.ndarray]]) -> dict[str, np.ndarray]:
        return {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}

    return _Seen(
        trial=np.concatenate([group.trial for group in groups]),
        complete=np.concatenate([group.complete for group in groups]),
        end_time=np.concatenate([group.end_time for group in groups]),
        last=columns([group.last for group in groups]),
        draws=columns([group.draws for group in groups]),
        metrics=columns([group.metrics for group in groups]),
    )


WORST = re.compile(r"([^\s(),]+) (-?\d+)[,)]")


def trial_statuses(group: FlightGroup, statuses: Iterable[str]) -> list[str]:
    """How each flight ended, with the worst status of every component that reported other than 0.

    For instance ``finished`` or ``finished (guidance.status 2)``.
    """
    texts: list[list[str]] = [[] for _ in group.statuses]
    for name in statuses:
        worst = largest(group.time, group.signals[name], group.ends)
        for flight in np.flatnonzero(worst).tolist():
            texts[flight].append(f"{name} {worst[flight]:.0f}")
    return [
        f"{status} ({', '.join(words)})" if words else status
        for status, words in zip(group.statuses, texts, strict=True)
    ]


def worst_statuses(text: str) -> dict[str, int]:
    """What `trial_statuses` says in its brackets: the worst status other than 0 by the signal that reported it."""
    return {name: int(value) for name, value in WORST.findall(text)}
