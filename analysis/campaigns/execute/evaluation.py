"""Evaluation of the trials of one variant: metrics, success and records, for several simulations at once.

Metrics that need only the last row are evaluated once for all simulations of a task, on their collected last rows.
Metrics over time are evaluated immediately, since the next simulations overwrite the rows.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

import numpy as np

from ...runtime.flight.group import FlightGroup
from ..definition.campaign import Campaign
from ..definition.checks import VariantNames
from ..definition.metrics import TIME, evaluate_metric, is_of_the_end, successes
from ..definition.plan import TrialSamples
from ..definition.reductions import largest
from ..trials import TrialTable

Columns = Mapping[str, np.ndarray]  # columns by name as in tables of trials, with an entry for each simulation
COMPLETE = "complete"  # name of the column that is true for completed simulations


class MetricEvaluator:
    """Evaluator of metrics, success and records of a variant's simulations, which are added group by group."""

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
        self._groups: list[Columns] = []
        self._texts: dict[str, list[str]] = {"status": [], "message": []}
        self._traces: dict[int, dict[str, np.ndarray]] = {}

    def add(self, group: FlightGroup, trials: range, sampled: TrialSamples) -> None:
        """Evaluate the simulations of these trials; their rows are not needed afterwards."""
        signals, draws = group.signals, sampled.columns_of(trials)
        lengths = group.ends - group.starts
        rows = {name: np.repeat(draws[name], lengths) for name in self._draws_over_time}
        values: Mapping[str, np.ndarray | float] = {**self._names.constants, **rows, **signals, TIME: group.time}
        columns = {
            "trial": np.arange(trials.start, trials.stop),
            COMPLETE: group.complete,
            "end_time": group.last(group.time),
            **{f"final.{name}": group.last(signals[name]) for name in self._last_of},
            **{f"draw.{name}": draws[name] for name in self._draws_at_end},
            **{
                f"metric.{metric.name}": evaluate_metric(metric, group.time, values, group.ends)
                for metric in self._over_time
            },
        }
        self._groups.append(columns)
        self._texts["status"] += trial_statuses(group, self._names.statuses)
        texts = zip(group.messages, group.complete.tolist(), strict=True)
        self._texts["message"] += ["" if complete else message for message, complete in texts]
        self._keep_signals(group, trials, columns)

    def _keep_signals(self, group: FlightGroup, trials: range, columns: Columns) -> None:
        """Copy the time histories that are stored: sampled signals, or all signals of some trials."""
        record = self._campaign.record
        if record.traces == "none" and record.every is None:
            return
        sampled = record.every is not None and (record.trials is None or columns["trial"] < record.trials)
        everything = (
            ~self._success(columns, self._metrics(columns)) if record.traces == "failures" else record.traces == "all"
        )
        everything, sampled = (np.broadcast_to(which, len(trials)) for which in (everything, sampled))
        for flight in np.flatnonzero(everything | sampled).tolist():
            rows = group.rows(flight)
            names: Iterable[str] = group.signals
            if not everything[flight]:
                rows, names = slice(rows.start, rows.stop, record.every), record.signals
            self._traces[trials[flight]] = {"time": group.time[rows].copy()} | {
                name: group.signals[name][rows].copy() for name in names
            }

    def trials(self) -> TrialTable:
        """Return the table of the simulations added since the last call; there must be at least one."""
        columns = {name: np.concatenate([group[name] for group in self._groups]) for name in self._groups[0]}
        metrics = self._metrics(columns)
        trials = TrialTable.of(
            {
                "trial": columns["trial"],
                "status": self._texts["status"],
                "success": self._success(columns, metrics),
                "message": self._texts["message"],
                "end_time": columns["end_time"],
                **{f"final.{name}": columns[f"final.{name}"] for name in self._campaign.record.final},
                **{f"metric.{name}": values for name, values in metrics.items()},
            },
            self._traces,
        )
        self._begin()
        return trials

    def _metrics(self, columns: Columns) -> dict[str, np.ndarray]:
        """Return all metrics in the campaign's order, (simulations,) each; nan for a simulation that failed."""
        values = {
            **self._names.constants,
            **{name: columns[f"draw.{name}"] for name in self._draws_at_end},
            **{name: columns[f"final.{name}"] for name in self._last_of},
            TIME: columns["end_time"],
        }
        complete, metrics = columns[COMPLETE], dict[str, np.ndarray]()
        for metric in self._campaign.metrics:
            column = columns.get(f"metric.{metric.name}")
            if column is None:
                column = np.broadcast_to(metric.expression.evaluate(values), complete.shape)
            metrics[metric.name] = np.where(complete, column, np.nan)
        return metrics

    def _success(self, columns: Columns, metrics: Mapping[str, np.ndarray]) -> np.ndarray:
        """Return True for each simulation that is a success (simulations,)."""
        complete = columns[COMPLETE]
        return successes(self._campaign.success, metrics, complete.size) & complete


WORST = re.compile(r"([^\s(),]+) (-?\d+)[,)]")


def trial_statuses(group: FlightGroup, statuses: Iterable[str]) -> list[str]:
    """Return the status of each simulation, with the worst nonzero status of every component.

    Examples are ``finished`` and ``finished (guidance.status 2)``.
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
    """Return the worst component statuses in a text from `trial_statuses`, by signal."""
    return {name: int(value) for name, value in WORST.findall(text)}
