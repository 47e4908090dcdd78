"""Rows of the comparison's tables: pairs of contenders on the same trials, and what was drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

from ...campaigns.compare.comparison import Comparison, name_of
from ...campaigns.compare.paired import PairedRates, PairedValues
from ...campaigns.spec.campaign import Metric

T = TypeVar("T", PairedRates, PairedValues)


@dataclass(frozen=True)
class PairRow(Generic[T]):
    """Contenders A and B, and what their trials tell."""

    a: str
    b: str
    found: T

    @property
    def is_sure(self) -> bool:
        """Whether the interval of the difference does not contain 0."""
        interval = self.found.interval
        return interval is not None and not interval[0] <= 0.0 <= interval[1]


@dataclass(frozen=True)
class PairGroup(Generic[T]):
    """All pairs of one rate or metric: those against the reference, and the others."""

    name: str
    unit: str
    first: list[PairRow[T]]
    others: list[PairRow[T]]


def rate_pairs(comparison: Comparison) -> list[PairGroup[PairedRates]]:
    """A group per rate."""
    return [
        _group(
            comparison,
            name_of(rate),
            "1",
            [PairRow(*pair, comparison.paired_rates(pair, rate)) for pair in comparison.pairs],
        )
        for rate in comparison.rates
    ]


def metric_pairs(
    comparison: Comparison, metrics: Sequence[Metric], *, successful: bool
) -> list[PairGroup[PairedValues]]:
    """A group per metric, over the trials in which both succeed or over all."""
    return [
        _group(
            comparison,
            metric.name,
            metric.unit,
            [
                PairRow(*pair, comparison.paired_values(pair, metric.name, successful=successful))
                for pair in comparison.pairs
            ],
        )
        for metric in metrics
    ]


def _group(comparison: Comparison, name: str, unit: str, rows: list[PairRow[T]]) -> PairGroup[T]:
    first = [row for row in rows if comparison.against_reference((row.a, row.b))]
    return PairGroup(name, unit, first, [row for row in rows if row not in first])


def draw_ranges(comparison: Comparison) -> list[tuple[str, float, float, float]]:
    """Name, least, mean and largest value of everything drawn or derived; the same in all batches."""
    columns = comparison.first.draws
    return [(name, float(values.min()), float(values.mean()), float(values.max())) for name, values in columns.items()]
