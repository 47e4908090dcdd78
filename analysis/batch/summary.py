"""What came of a campaign: rates with their intervals, metrics over trials, of variants and of groups of trials."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from scipy.stats import binomtest

from ..campaign.campaign import Metric
from ..campaign.groups import Group
from .statistics import INFINITE, QUANTILES, statistics

CONFIDENCE = 0.95


def success_interval(successes: int, trials: int, confidence: float = 0.95) -> tuple[float, float]:
    """Interval (low, high) of the probability of success after ``successes`` in ``trials`` independent trials.

    Clopper and Pearson's exact interval: it covers the true rate with at least ``confidence``
    whatever that rate is. Wilson's is shorter but covers less than it says near 0 and 1, and
    rates near 1 are what guidance is judged by. Raises ValueError unless 0 <= successes <= trials, trials >= 1.
    """
    interval = binomtest(successes, trials).proportion_ci(confidence, method="exact")
    return float(interval.low), float(interval.high)


@dataclass(frozen=True)
class TrialColumns:
    """The trials of one variant, one entry per trial: status, success and every metric by name."""

    statuses: Sequence[str]
    success: np.ndarray
    metrics: Mapping[str, np.ndarray]

    def among(self, trials: np.ndarray) -> TrialColumns:
        """Some of the trials, by their places in the columns."""
        return TrialColumns(
            [self.statuses[trial] for trial in trials],
            np.asarray(self.success)[trials],
            {name: np.asarray(column)[trials] for name, column in self.metrics.items()},
        )


def summarise_variant(trials: TrialColumns, metrics: Iterable[Metric]) -> dict[str, Any]:
    """The summary of one variant; ``metrics`` are over successful trials, ``metrics_all`` over all."""
    success = np.asarray(trials.success, dtype=bool)
    columns = {metric.name: (np.asarray(trials.metrics[metric.name], dtype=float), metric.unit) for metric in metrics}
    successes = int(success.sum())
    return {
        "trials": len(success),
        "success_rate": successes / len(success),
        "success_interval": list(success_interval(successes, len(success), CONFIDENCE)),
        "confidence": CONFIDENCE,
        "statuses": dict(sorted(Counter(trials.statuses).items())),
        "metrics_over": "successful trials",
        "metrics": {name: statistics(column[success], unit) for name, (column, unit) in columns.items()},
        "metrics_all": {name: statistics(column, unit) for name, (column, unit) in columns.items()},
    }


def summarise(
    variants: Mapping[str, TrialColumns], metrics: Sequence[Metric], groups: Sequence[Group] = ()
) -> dict[str, Any]:
    """The summaries of all variants by name. Every variant has one trial or more.

    With ``groups`` a variant has ``groups`` too, by their labels: the same over the trials of each, and its ``value``.
    """
    found = {name: summarise_variant(trials, metrics) for name, trials in variants.items()}
    if groups:
        for name, trials in variants.items():
            found[name]["groups"] = {
                group.label: {"value": group.value, **summarise_variant(trials.among(group.trials), metrics)}
                for group in groups
            }
    return found


class SummaryRow(NamedTuple):
    """A row of a summary's tables: a variant, or one group of its trials by its label, and what there is to say."""

    variant: str
    group: str | None
    entry: dict[str, Any]


def summary_rows(summary: Mapping[str, Any]) -> list[SummaryRow]:
    """Every variant, each followed by its groups."""
    rows = []
    for name, variant in summary.items():
        rows.append(SummaryRow(name, None, variant))
        rows += [SummaryRow(name, label, entry) for label, entry in variant.get("groups", {}).items()]
    return rows


def requirement_values(summary: Mapping[str, Any]) -> dict[str, float]:
    """Every number of a summary under a dotted name, for requirements as expressions.

    ``variant.success_rate``, ``variant.success_interval[1]`` (low) and ``[2]`` (high),
    ``variant.metrics.NAME.mean``, ``variant.groups["LABEL"].success_rate`` and so on; numbers that could not be
    had are nan.
    """
    values: dict[str, float] = {}

    def walk(prefix: str, entry: Any) -> None:
        if isinstance(entry, Mapping):
            for key, inner in entry.items():
                walk(f"{prefix}.{key}" if prefix else key, inner)
        elif isinstance(entry, list):
            for index, inner in enumerate(entry):
                walk(f"{prefix}[{index + 1}]", inner)
        elif not isinstance(entry, str):
            values[prefix] = float("nan") if entry is None else float(entry)
        elif entry in INFINITE and prefix.endswith(tuple(f".{key}" for key in QUANTILES)):
            values[prefix] = float(entry)

    for name, variant in summary.items():
        walk(name, {key: entry for key, entry in variant.items() if key != "groups"})
        for label, group in variant.get("groups", {}).items():
            walk(f'{name}.groups["{label}"]', group)
    return values
