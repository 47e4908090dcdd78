"""Summary of a campaign: success rates with intervals, statistics of metrics, verdicts, by variant and group."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import scipy

from ...common.to_json import optional, to_json
from .definition.campaign import TrialGroup
from .definition.requirements import Requirement
from .requirement_verdicts import RequirementVerdict, requirement_verdict
from .statistics import IN_MEMORY, QUANTILES, MetricStatistics, statistics
from .trials import Member, TrialTable

CONFIDENCE = 0.95
Interval = tuple[float, float]


@dataclass(frozen=True)
class Rate:
    """Fraction ``rate`` = ``count`` / ``trials`` of trials with an outcome, with its `success_interval`."""

    count: int
    trials: int
    rate: float
    interval: Interval


@dataclass(frozen=True, kw_only=True)
class VariantSummary:
    """Summary of the trials of a variant, or of a group of them that share the ``value`` of the grouping draw.

    ``statuses`` counts trials by status. ``metrics`` are statistics over successful trials, ``metrics_all`` over all
    trials. A variant has ``groups`` by label, and verdicts on ``requirements`` by name if the campaign declares any. In
    a comparison it has ``rates`` by name.
    """

    value: float | None = optional()
    trials: int
    success_rate: float
    success_interval: Interval
    confidence: float
    statuses: Mapping[str, int]
    metrics_over: str
    metrics: Mapping[str, MetricStatistics]
    metrics_all: Mapping[str, MetricStatistics]
    groups: Mapping[str, VariantSummary] = optional({})
    requirements: Mapping[str, RequirementVerdict] = optional({})
    rates: Mapping[str, Rate] = optional({})


Summary = Mapping[str, VariantSummary]  # by variant


def success_interval(successes: int, trials: int, confidence: float = 0.95) -> Interval:
    """Return the interval (low, high) of the probability of success after ``successes`` in independent ``trials``.

    Clopper and Pearson's exact interval covers the true rate, whatever its value, with at least ``confidence``.
    Wilson's interval is shorter but covers less than stated near 0 and 1, and guidance is assessed by rates near 1.
    Raises ValueError unless 0 <= successes <= trials, trials >= 1.
    """
    if not (trials >= 1 and 0 <= successes <= trials):
        raise ValueError(f"{successes} successes of {trials} trials")
    failures, tail = trials - successes, 0.5 * (1.0 - confidence)
    low = float(scipy.special.betaincinv(successes, failures + 1, tail)) if successes else 0.0
    high = float(scipy.special.betaincinv(successes + 1, failures, 1.0 - tail)) if failures else 1.0
    return low, high


def success_rate(yes: np.ndarray) -> Rate:
    """Return the rate of true ``outcomes`` (booleans [trial], at least one trial)."""
    count = int(np.count_nonzero(yes))
    return Rate(count, yes.size, count / yes.size, success_interval(count, yes.size, CONFIDENCE))


def _summary(trials: TrialTable, members: Sequence[Member] = ()) -> VariantSummary:
    count, successes = 0, 0
    statuses: Counter[str] = Counter()
    for part in trials.parts("success", "status", members=members):
        count += len(part["success"])
        successes += int(np.count_nonzero(part["success"]))
        statuses.update(part["status"].tolist())
    metrics = trials.units("metric.")
    succeeded: Member = ("success", lambda success: success == 1.0)

    def all_of(*which: Member) -> dict[str, MetricStatistics]:
        return {name: statistics(trials.blocks(f"metric.{name}", which), unit) for name, unit in metrics.items()}

    return VariantSummary(
        trials=count,
        success_rate=successes / count,
        success_interval=success_interval(successes, count, CONFIDENCE),
        confidence=CONFIDENCE,
        statuses=dict(sorted(statuses.items())),
        metrics_over="successful trials",
        metrics=all_of(*members, succeeded),
        metrics_all=all_of(*members),
    )


def summarise(
    variants: Mapping[str, TrialTable],
    groups: Sequence[TrialGroup] = (),
    by: str = "",
    *,
    requirements: Sequence[Requirement] = (),
    until_decided: bool = False,
) -> Summary:
    """Return the summary of all variants by name, with the metrics and units of the tables' columns.

    Every variant has at least one trial. ``groups`` are the groups of trials by values of the draw ``by``. Verdicts are
    from `requirement_verdict`.
    """
    summary = {}
    for name, rows in variants.items():
        metrics = [column for column in rows.names if column.startswith("metric.")]
        columns = ["success", "status", *metrics, *([f"draw.{by}"] if groups else [])]
        trials = rows.in_memory(columns, IN_MEMORY)
        summary[name] = replace(
            _summary(trials),
            groups={
                group.label: replace(_summary(trials, [(f"draw.{by}", group.has)]), value=group.value)
                for group in groups
            },
            requirements={
                requirement.name: requirement_verdict(requirement, rows, until_decided) for requirement in requirements
            },
        )
    return summary


class SummaryRow(NamedTuple):
    """Row of a summary's tables: a variant, or a group of its trials by label."""

    variant: str
    group: str | None
    entry: VariantSummary


def summary_rows(summary: Summary) -> list[SummaryRow]:
    """Return the rows of every variant, each followed by its groups."""
    rows = []
    for name, variant in summary.items():
        rows.append(SummaryRow(name, None, variant))
        rows += [SummaryRow(name, label, entry) for label, entry in variant.groups.items()]
    return rows


def requirement_values(summary: Summary) -> dict[str, float]:
    """Return every number of a summary under a dotted name, for use in expressions.

    Names are ``variant.success_rate``, ``variant.success_interval[1]`` (low) and ``[2]`` (high),
    ``variant.metrics.NAME.mean``, ``variant.groups["LABEL"].success_rate`` and so on; missing numbers are nan.
    """
    values: dict[str, float] = {}

    def walk(prefix: str, entry: object) -> None:
        if isinstance(entry, Mapping):
            for key, inner in entry.items():
                walk(f"{prefix}.{key}", inner)
        elif isinstance(entry, list):
            for index, inner in enumerate(entry):
                walk(f"{prefix}[{index + 1}]", inner)
        elif entry is None or isinstance(entry, float | int):
            values[prefix] = float("nan") if entry is None else float(entry)
        elif entry in ("inf", "-inf") and prefix.rpartition(".")[2] in QUANTILES:
            values[prefix] = math.inf if entry == "inf" else -math.inf

    for name, variant in summary.items():
        walk(name, to_json(replace(variant, groups={})))
        for label, group in variant.groups.items():
            walk(f'{name}.groups["{label}"]', to_json(group))
    return values
