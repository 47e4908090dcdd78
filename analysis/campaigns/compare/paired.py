"""Two variants on the same trials: what can be said of their difference, and how surely."""

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
    """Outcomes, yes or no, of variants A and B in the same trials.

    ``difference`` is A's rate less B's with its ``interval``; ``p_value`` is that of McNemar's exact
    test: how likely so uneven a split of the trials in which only one says yes is by chance.
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
    """A number of variants A and B in the same trials; ``count`` is of trials where both have a finite one.

    ``smaller``, ``equal`` and ``larger`` count trials by what A's is against B's. ``median`` is that
    of A less B (of an even number the lower of the two in the middle, as all our quantiles); its
    ``interval`` is None where there are too few trials for one. ``p_value`` is that of the sign test, ties
    left out. All None without trials.
    """

    count: int
    smaller: int
    equal: int
    larger: int
    median: float | None
    interval: Interval | None
    p_value: float | None


def compare_rates(a: np.ndarray, b: np.ndarray, confidence: float = CONFIDENCE) -> PairedRates:
    """Compare outcomes ``a`` and ``b`` (booleans, one per trial, one trial or more).

    The interval of the difference is Bonett and Price's (2012, J. Educ. Behav. Stat. 37, 479): Wald's with
    one trial added to each kind of disagreement, which Fagerland, Lydersen and Laake (2014, Stat. Med. 33,
    2850) recommend since it covers as it should in small samples too.
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
    """Compare numbers ``a`` and ``b``, one per trial.

    The median's interval lies between two order statistics of the differences and covers at least
    with ``confidence`` whatever their distribution is.
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
    """Return p-values adjusted for all tests together: those at most 0.05 err in one of 20 families at most.

    Holm (1979, Scand. J. Statist. 6, 65): the smallest times the number n of tests, the next one times n - 1, and so
    on, none smaller than those before it.
    """
    p = np.asarray(p_values, dtype=float)
    order = np.argsort(p)
    adjusted = np.empty(p.size)
    adjusted[order] = np.minimum(1.0, np.maximum.accumulate(p[order] * np.arange(p.size, 0, -1)))
    return adjusted


def _even_split(first: int, second: int) -> float:
    """Return the probability that a fair coin splits so unevenly, either way; 1 where there is nothing to split."""
    return float(binomtest(first, first + second).pvalue) if first + second else 1.0
