"""Statistical comparison of two variants on the same trials: difference, interval and significance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import binomtest, norm, quantile_test

from ..summary import CONFIDENCE
from ..verdicts.order_statistics import quantiles

Interval = tuple[float, float]


@dataclass(frozen=True)
class PairedRates:
    """Counts of true and false outcomes of variants A and B in the same trials.

    ``difference`` is A's rate minus B's rate, with its ``interval``. ``p_value`` is the p-value of McNemar's exact
    test: the probability that the trials in which A and B differ are split at least as unevenly, if both directions
    were equally likely.
    """

    both: int
    only_a: int
    only_b: int
    neither: int
    difference: float
    interval: Interval
    p_value: float


@dataclass(frozen=True)
class PairedValues:
    """Comparison of a metric of variants A and B over the ``count`` trials in which both values are finite.

    ``smaller``, ``equal`` and ``larger`` are the numbers of trials in which A's value is smaller than, equal to or
    larger than B's. ``median`` is the median of A minus B (for an even number of trials, the lower of the two middle
    values). ``interval`` is the median's confidence interval, or None with too few trials. ``p_value`` is the p-value
    of the sign test without ties. All three are None if there are no trials.
    """

    count: int
    smaller: int
    equal: int
    larger: int
    median: float | None
    interval: Interval | None
    p_value: float | None


def compare_rates(a: np.ndarray, b: np.ndarray, confidence: float = CONFIDENCE) -> PairedRates:
    """Compare outcomes ``a`` and ``b`` (booleans [trial], at least one trial).

    The interval of the difference is the one by Bonett and Price (2012, J. Educ. Behav. Stat. 37, 479): Wald's interval
    with one trial added to each kind of disagreement. Fagerland, Lydersen and Laake (2014, Stat. Med. 33, 2850)
    recommend it for its coverage in small samples.
    """
    a, b = np.asarray(a, dtype=bool), np.asarray(b, dtype=bool)
    only_a, only_b = int(np.sum(a & ~b)), int(np.sum(~a & b))
    first, second = (only_a + 1) / (a.size + 2), (only_b + 1) / (a.size + 2)
    spread = np.sqrt((first + second - (first - second) ** 2) / (a.size + 2))
    reach = float(norm.ppf(0.5 + confidence / 2) * spread)
    middle = first - second
    return PairedRates(
        both=int(np.sum(a & b)),
        only_a=only_a,
        only_b=only_b,
        neither=int(np.sum(~a & ~b)),
        difference=(only_a - only_b) / a.size,
        interval=(max(-1.0, middle - reach), min(1.0, middle + reach)),
        p_value=_even_split(only_a, only_b),
    )


def compare_values(a: np.ndarray, b: np.ndarray, confidence: float = CONFIDENCE) -> PairedValues:
    """Compare values ``a`` and ``b`` [trial] of a metric.

    The ends of the median's interval are two order statistics of the differences. It covers the true median with at
    least ``confidence`` for any distribution.
    """
    finite = np.isfinite(a) & np.isfinite(b)
    difference = np.asarray(a, dtype=float)[finite] - np.asarray(b, dtype=float)[finite]
    smaller, larger = int(np.sum(difference < 0.0)), int(np.sum(difference > 0.0))
    if not difference.size:
        return PairedValues(0, 0, 0, 0, None, None, None)
    interval = quantile_test(difference, p=0.5).confidence_interval(confidence)
    low, high = float(interval.low), float(interval.high)
    return PairedValues(
        count=int(difference.size),
        smaller=smaller,
        equal=int(difference.size) - smaller - larger,
        larger=larger,
        median=float(quantiles(difference, [0.5])[0]),
        interval=(low, high) if np.isfinite(low) and np.isfinite(high) else None,
        p_value=_even_split(smaller, larger),
    )


def holm_adjusted(p_values: Sequence[float]) -> np.ndarray:
    """Return p-values adjusted for multiple tests.

    If values up to 0.05 are significant, the family-wise error rate is at most 5 %. Holm (1979, Scand. J. Statist. 6,
    65): the smallest of n values is multiplied by n, the next by n - 1, and so on; no adjusted value is smaller than
    the adjusted value before it.
    """
    p = np.asarray(p_values, dtype=float)
    order = np.argsort(p)
    adjusted = np.empty(p.size)
    adjusted[order] = np.minimum(1.0, np.maximum.accumulate(p[order] * np.arange(p.size, 0, -1)))
    return adjusted


def _even_split(first: int, second: int) -> float:
    """Return the two-sided p-value of these counts for a fair coin; 1 if both counts are 0."""
    return float(binomtest(first, first + second).pvalue) if first + second else 1.0
