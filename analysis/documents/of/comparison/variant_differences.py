"""Sentences on pairs of variants with significant differences in success or requirements."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from ....campaigns.compare.campaign_comparison import SUCCESS, CampaignComparison
from ....campaigns.compare.paired import PairedRates, PairedValues, holm_adjusted
from ...cell import DisplayedNumber, Inline
from ...common.quantities import display_unit, in_display_unit, number
from .pairs import PairGroup, PairRow, points

LEVEL = 0.05


class Difference(NamedTuple):
    """A quantity in which variant ``a`` differs from ``b``, in words, with the p-value of its test."""

    a: str
    b: str
    words: Sequence[Inline]
    p_value: float


class Sentence(NamedTuple):
    """Variants A and B, and all significant differences between them in words."""

    a: str
    b: str
    differences: list[Sequence[Inline]]


class Sentences(NamedTuple):
    """Sentences on the pairs that differ, separately for pairs with the reference.

    ``tested`` lists the compared quantities.
    """

    first: list[Sentence]
    others: list[Sentence]
    tested: list[str]


def significant_differences(
    comparison: CampaignComparison, rates: Iterable[PairGroup[PairedRates]], metrics: Iterable[PairGroup[PairedValues]]
) -> Sentences:
    """Return the differences that are significant at 5 % over all tests together, `holm_adjusted`."""
    judged = {SUCCESS, *comparison.judged_names}
    rate_groups = [group for group in rates if group.name in judged]
    metric_groups = [group for group in metrics if group.name in judged]
    tested = [_rate_words(group.name, row) for group in rate_groups for row in (*group.first, *group.others)]
    tested += [
        difference
        for group in metric_groups
        for row in (*group.first, *group.others)
        if (difference := _metric_words(group.name, group.unit, row)) is not None
    ]
    adjusted = holm_adjusted([each.p_value for each in tested])
    sure = [each for each, p_value in zip(tested, adjusted, strict=True) if p_value <= LEVEL]
    sentences = [
        Sentence(a, b, words)
        for a, b in comparison.pairs
        if (words := [each.words for each in sure if (each.a, each.b) == (a, b)])
    ]
    first = [each for each in sentences if comparison.against_reference((each.a, each.b))]
    names = [*(group.name for group in rate_groups), *(group.name for group in metric_groups)]
    return Sentences(first, [each for each in sentences if each not in first], names)


def _rate_words(name: str, row: PairRow[PairedRates]) -> Difference:
    estimate = row.estimate
    rate, low, high = map(points, (estimate.difference, *estimate.interval))
    return Difference(row.a, row.b, [f"{name} ", rate, " points (", low, " to ", high, ")"], estimate.p_value)


def _metric_words(name: str, unit: str, row: PairRow[PairedValues]) -> Difference | None:
    """Return the difference of a metric in words; None if too few trials have it for an interval."""
    estimate = row.estimate
    if estimate.median is None or estimate.interval is None or estimate.p_value is None:
        return None
    median, low, high = (_signed(each, unit) for each in (estimate.median, *estimate.interval))
    words: list[Inline] = [f"{name} ", median, f" {display_unit(unit)} (", low, " to ", high, ")"]
    return Difference(row.a, row.b, words, estimate.p_value)


def _signed(value: float, unit: str) -> DisplayedNumber:
    text = number(in_display_unit(value, unit))
    return DisplayedNumber(f"+{text}" if value > 0.0 else text, value)
