"""Pairs of variants on the same trials: differences of rates and metrics, and their tables."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, Literal, TypeVar

from ....campaigns.compare.campaign_comparison import CampaignComparison, name_of
from ....campaigns.compare.paired import PairedRates, PairedValues
from ....campaigns.definition.campaign import Metric
from ...cell import (
    Cell,
    DisplayedNumber,
    Faint,
    Head,
    Interval,
    LegendEntry,
    Lines,
    Percentage,
    Phrase,
    Quantity,
    Row,
    RowHeading,
    Strong,
)
from ...common.colours import Look
from ...common.quantities import MINUS, display_unit
from ...model import Table

T = TypeVar("T", PairedRates, PairedValues)


@dataclass(frozen=True)
class PairRow(Generic[T]):
    """Variants A and B, with the estimate of their difference."""

    a: str
    b: str
    estimate: T

    @property
    def is_significant(self) -> bool:
        """True if the confidence interval of the difference excludes 0."""
        interval = self.estimate.interval
        return interval is not None and not interval[0] <= 0.0 <= interval[1]


@dataclass(frozen=True)
class PairGroup(Generic[T]):
    """All pairs for one rate or metric: pairs with the reference first, then the others."""

    name: str
    unit: str
    first: list[PairRow[T]]
    others: list[PairRow[T]]


def rate_pairs(comparison: CampaignComparison) -> list[PairGroup[PairedRates]]:
    """Return a group of pairs per rate."""
    groups = []
    for rate in comparison.rates:
        rows = [PairRow(*pair, comparison.compare_rates(pair, rate)) for pair in comparison.pairs]
        groups.append(_group(comparison, name_of(rate), "1", rows))
    return groups


def metric_pairs(
    comparison: CampaignComparison, metrics: Sequence[Metric], *, successful: bool
) -> list[PairGroup[PairedValues]]:
    """Return a group of pairs per metric, over the trials in which both succeed, or over all trials."""
    groups = []
    for metric in metrics:
        pairs = [(pair, comparison.pair_values(pair, metric.name, successful=successful)) for pair in comparison.pairs]
        groups.append(_group(comparison, metric.name, metric.unit, [PairRow(*pair, values) for pair, values in pairs]))
    return groups


def _group(comparison: CampaignComparison, name: str, unit: str, rows: list[PairRow[T]]) -> PairGroup[T]:
    first = [row for row in rows if comparison.against_reference((row.a, row.b))]
    return PairGroup(name, unit, first, [row for row in rows if row not in first])


RATE_HEADS = (f"A {MINUS} B", "difference, points", "95 % interval", "p", "both", "only A", "only B", "neither")
METRIC_HEADS = (f"A {MINUS} B", "median", "95 % interval", "p", "A < B, %", "A = B, %", "A > B, %", "trials")
LEAST_P = 1e-4  # smaller p-values are displayed as less than this
DECIMALS = 1  # decimals of fractions of trials (%)
Styles = Mapping[str, Look]
Part = Literal["first", "others"]  # pairs with the reference, and others


def rate_pair_table(groups: Sequence[PairGroup[PairedRates]], part: Part, styles: Styles) -> Table:
    """Return a block of rows for each rate: the difference of every pair, and counts of trials by both outcomes."""

    def numbers(estimate: PairedRates, _: str) -> list[Cell]:
        counts = (estimate.both, estimate.only_a, estimate.only_b, estimate.neither)
        return [
            points(estimate.difference),
            Interval(*map(points, estimate.interval)),
            p_value(estimate.p_value),
            *counts,
        ]

    return _table(RATE_HEADS, groups, part, styles, numbers)


def metric_pair_table(groups: Sequence[PairGroup[PairedValues]], part: Part, styles: Styles) -> Table:
    """Return a block of rows for each metric: median difference of every pair, fractions of trials by its sign."""

    def numbers(estimate: PairedValues, unit: str) -> list[Cell]:
        interval = None
        if estimate.interval is not None:
            interval = Interval(*(Quantity(end, unit, is_bare=True) for end in estimate.interval))
        count = estimate.count
        signs = (estimate.smaller, estimate.equal, estimate.larger)
        fractions = [Percentage(each / count, DECIMALS) if count else None for each in signs]
        return [Quantity(estimate.median, unit, is_bare=True), interval, p_value(estimate.p_value), *fractions, count]

    return _table(METRIC_HEADS, groups, part, styles, numbers)


def _table(
    heads: Sequence[str],
    groups: Sequence[PairGroup[T]],
    part: Part,
    styles: Styles,
    numbers: Callable[[T, str], list[Cell]],
) -> Table:
    body: list[Sequence[Cell] | Row | RowHeading] = []
    for group in groups:
        rows = group.first if part == "first" else group.others
        if rows:
            unit = display_unit(group.unit)
            body.append(RowHeading([Strong(group.name), f", {unit}" if unit else ""]))
        for row in rows:
            difference, interval, *others = numbers(row.estimate, group.unit)
            body.append(
                (_pair_cell(row, styles), difference, Strong(interval) if row.is_significant else interval, *others)
            )
    return Table([heads[0], *(Head(head, column="numbers") for head in heads[1:])], body, style="tight")


def points(difference: float) -> DisplayedNumber:
    """Return the difference of two rates in percentage points, with a sign unless it is 0."""
    text = f"{100.0 * difference:+.2f}" if difference else "0.00"
    return DisplayedNumber(text.replace("-", MINUS), difference)


def p_value(probability: float | None) -> DisplayedNumber | None:
    """Return the p-value of a test as a cell; None if there is none."""
    if probability is None:
        return None
    return DisplayedNumber(f"{probability:.4f}" if probability >= LEAST_P else f"< {LEAST_P:.4f}", probability)


def _pair_cell(row: PairRow[T], styles: Styles) -> Lines:
    a, b = (LegendEntry(styles[label], [label]) for label in (row.a, row.b))
    return Lines([a, Faint(Phrase([f"{MINUS} ", b]))], is_line_on_paper=True)
