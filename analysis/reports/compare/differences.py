"""Sentences on the pairs of variants that differ significantly in what success and requirements judge."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from markupsafe import Markup

from ...campaigns.compare.comparison import SUCCESS, Comparison
from ...campaigns.compare.paired import PairedRates, PairedValues, holm_adjusted
from ..common.page import exact, with_exact
from ..common.quantities import MINUS, display_unit
from .tables import PairGroup, PairRow

LEVEL = 0.05


class Difference(NamedTuple):
    """A quantity in which variant ``a`` differs from ``b``, in words, and the p-value of its test."""

    a: str
    b: str
    words: Markup
    p_value: float


class Sentence(NamedTuple):
    """Variants A and B, and in words all that differs significantly between them."""

    a: str
    b: str
    differences: list[Markup]


class Sentences(NamedTuple):
    """A sentence for each pair that differs, pairs against the reference apart; ``tested`` names what was compared."""

    first: list[Sentence]
    others: list[Sentence]
    tested: list[str]


def significant_differences(
    comparison: Comparison, rates: Iterable[PairGroup[PairedRates]], metrics: Iterable[PairGroup[PairedValues]]
) -> Sentences:
    """Return what differs at the 5 % level in all of the tests together, `holm_adjusted`."""
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
    words = Markup("{} {} points ({} to {})").format(name, *map(_points, (estimate.difference, *estimate.interval)))
    return Difference(row.a, row.b, words, estimate.p_value)


def _points(rate: float) -> Markup:
    return with_exact(repr(rate), f"{100 * rate:+.2f}".replace("-", MINUS))


def _metric_words(name: str, unit: str, row: PairRow[PairedValues]) -> Difference | None:
    """The difference of a metric; None where too few trials have it for an interval."""
    estimate = row.estimate
    if estimate.median is None or estimate.interval is None or estimate.p_value is None:
        return None
    numbers = [_signed(number, unit) for number in (estimate.median, *estimate.interval)]
    words = Markup("{} {} {} ({} to {})").format(name, numbers[0], display_unit(unit), *numbers[1:])
    return Difference(row.a, row.b, words, estimate.p_value)


def _signed(number: float, unit: str) -> Markup:
    return Markup("{}{}").format("+" if number > 0.0 else "", exact(number, unit))
