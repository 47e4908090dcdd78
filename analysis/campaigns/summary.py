"""What came of a campaign: rates with their intervals, metrics over trials, of variants and of groups of trials."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import scipy

from .rows import Part, TrialRows, blocks, held
from .spec.campaign import Metric
from .spec.groups import Group
from .statistics import HELD, INFINITE, QUANTILES, statistics

CONFIDENCE = 0.95


def success_interval(successes: int, trials: int, confidence: float = 0.95) -> tuple[float, float]:
    """Interval (low, high) of the probability of success after ``successes`` in ``trials`` independent trials.

    Clopper and Pearson's exact interval: it covers the true rate with at least ``confidence``
    whatever that rate is. Wilson's is shorter but covers less than it says near 0 and 1, and
    rates near 1 are what guidance is judged by. Raises ValueError unless 0 <= successes <= trials, trials >= 1.
    """
    if not (trials >= 1 and 0 <= successes <= trials):
        raise ValueError(f"{successes} successes of {trials} trials")
    failures, tail = trials - successes, 0.5 * (1.0 - confidence)
    low = float(scipy.special.betaincinv(successes, failures + 1, tail)) if successes else 0.0
    high = float(scipy.special.betaincinv(successes + 1, failures, 1.0 - tail)) if failures else 1.0
    return low, high


def _summary(trials: TrialRows, metrics: Sequence[Metric]) -> dict[str, Any]:
    count, successes = 0, 0
    statuses: Counter[str] = Counter()
    for part in trials.parts("success", "status"):
        count += len(part["success"])
        successes += int(np.count_nonzero(part["success"]))
        statuses.update(part["status"].tolist())
    columns = {metric.name: (f"metric.{metric.name}", metric.unit) for metric in metrics}
    return {
        "trials": count,
        "success_rate": successes / count,
        "success_interval": list(success_interval(successes, count, CONFIDENCE)),
        "confidence": CONFIDENCE,
        "statuses": dict(sorted(statuses.items())),
        "metrics_over": "successful trials",
        "metrics": {
            name: statistics(blocks(trials, column, "success"), unit) for name, (column, unit) in columns.items()
        },
        "metrics_all": {name: statistics(blocks(trials, column), unit) for name, (column, unit) in columns.items()},
    }


def summarise(
    variants: Mapping[str, TrialRows], metrics: Sequence[Metric], groups: Sequence[Group] = (), by: str = ""
) -> dict[str, Any]:
    """The summaries of all variants by name. Every variant has one trial or more.

    With ``groups`` a variant has ``groups`` too, by their labels: the same over the trials of each, and its ``value``;
    ``by`` is the draw by whose values they are.
    """
    columns = ["success", *(f"metric.{metric.name}" for metric in metrics), *([f"draw.{by}"] if groups else [])]
    found = {}
    for name, rows in variants.items():
        trials = held(rows, columns, HELD)
        found[name] = _summary(trials, metrics)
        if groups:
            found[name]["groups"] = {
                group.label: {"value": group.value, **_summary(_Members(trials, f"draw.{by}", group), metrics)}
                for group in groups
            }
    return found


@dataclass(frozen=True)
class _Members:
    """The trials of a variant that are in a group."""

    rows: TrialRows
    column: str
    group: Group

    def parts(self, *names: str) -> Iterator[Part]:
        for part in self.rows.parts(*dict.fromkeys((*names, self.column))):
            members = self.group.has(part[self.column])
            yield {name: part[name][members] for name in names}


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
