"""Content of the first table on pages of campaigns: variants, judged by success and requirements."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal, NamedTuple

from ....campaigns.definition.campaign import Metric
from ....campaigns.definition.expressions import Expression
from ....campaigns.metric_limits import MetricLimits, metric_limits
from ....campaigns.requirement_verdicts import RequirementVerdict
from ....campaigns.summary import Interval, Summary, VariantSummary
from ....campaigns.verdicts.acceptance import AcceptanceVerdict

MEDIAN = "p50"
Grade = Literal["pass", "fail", "not-applicable"]
GRADES: dict[AcceptanceVerdict, Grade] = {
    AcceptanceVerdict.MET: "pass",
    AcceptanceVerdict.NOT_MET: "fail",
    AcceptanceVerdict.UNDECIDED: "not-applicable",
}
Worst = Callable[[str, Metric, MetricLimits], tuple[int, float]]


class JudgedMetric(NamedTuple):
    """A metric of success or of a requirement, and the limits (or None) that they impose on this metric alone."""

    metric: Metric
    limits: MetricLimits | None


class MetricCell(NamedTuple):
    """A metric over all trials of a variant: its median and, with limits, its ``worst`` value and the ``trial``."""

    median: float | None
    is_best: bool
    worst: float | None
    trial: int | None


class VerdictRow(NamedTuple):
    """A variant: its summary, whether its success rate ``is_best``, numbers by metric, verdict in words, and grade."""

    variant: str
    entry: VariantSummary
    is_best: bool
    numbers: list[MetricCell]
    verdict: str
    grade: Grade


@dataclass(frozen=True)
class VerdictTable:
    """Judged metrics, rows of variants, and the ``start`` (0 to 1) of the axis of success rates."""

    metrics: list[JudgedMetric]
    rows: list[VerdictRow]
    start: float

    @property
    def has_verdicts(self) -> bool:
        """True if the campaign declares requirements."""
        return any(row.verdict for row in self.rows)


def verdict_table(
    summary: Summary, metrics: Iterable[Metric], expressions: Sequence[Expression], worst: Worst
) -> VerdictTable:
    """Return the table for the metrics that ``expressions`` contain; ``worst`` finds a variant's worst trial."""
    names = set().union(*(expression.names for expression in expressions))
    limits = metric_limits(expressions)
    judged = [JudgedMetric(metric, limits.get(metric.name)) for metric in metrics if metric.name in names]
    columns = [_column(each, summary, worst) for each in judged]
    rates = {name: entry.success_rate for name, entry in summary.items()}
    best = _best(rates, 1)
    rows = [
        VerdictRow(name, entry, name in best, [column[name] for column in columns], *_verdict(entry.requirements))
        for name, entry in summary.items()
    ]
    return VerdictTable(judged, rows, axis_start([entry.success_interval for entry in summary.values()]))


def axis_start(intervals: Iterable[Interval]) -> float:
    """Return the start of the axis of rates: the multiple of 0.1 at or below all intervals, at most 0.9."""
    return min(0.9, math.floor(10.0 * min((low for low, _ in intervals), default=1.0)) / 10.0)


def _column(judged: JudgedMetric, summary: Summary, worst: Worst) -> dict[str, MetricCell]:
    metric, limits = judged
    medians = {name: entry.metrics_all[metric.name].value(MEDIAN) for name, entry in summary.items()}
    best = _best(medians, 0 if limits is None else limits.better)
    trials = {name: (None, None) if limits is None else worst(name, metric, limits) for name in summary}
    return {name: MetricCell(medians[name], name in best, trials[name][1], trials[name][0]) for name in summary}


def _best(numbers: Mapping[str, float | None], better: int) -> set[str]:
    """Return the variants with the best number; empty if all are equal, or if neither direction is better."""
    known = {name: better * number for name, number in numbers.items() if number is not None}
    if not better or len(set(known.values())) < 2:
        return set()
    return {name for name, number in known.items() if number == max(known.values())}


def _verdict(requirements: Mapping[str, RequirementVerdict]) -> tuple[str, Grade]:
    """Return the verdict on all requirements in words, and its grade."""
    by_verdict: dict[AcceptanceVerdict, list[str]] = {}
    for name, each in requirements.items():
        by_verdict.setdefault(each.verdict, []).append(name)
    if not by_verdict or list(by_verdict) == [AcceptanceVerdict.MET]:
        return ("met" if by_verdict else ""), GRADES[AcceptanceVerdict.MET]
    bad = [verdict for verdict in (AcceptanceVerdict.NOT_MET, AcceptanceVerdict.UNDECIDED) if verdict in by_verdict]
    return "; ".join(f"{verdict}: {', '.join(by_verdict[verdict])}" for verdict in bad), GRADES[bad[0]]
