"""Exact order statistics of a column that is read in blocks, quantiles and tolerance bounds by them.

Memory does not grow with the column. A double's bits, turned so that they order as the numbers do, are sixteen bits
four times. Every time the values that begin as the sought one are counted by their next sixteen bits, until one is
left: radix selection.

The p-quantile of n values, in tables, figures and verdicts, is their order statistic k = ceil(p n), the least value
that a fraction p of all does not exceed: the inverse of the empirical distribution function (Hyndman and Fan 1996, The
American Statistician 50, definition 1; numpy's "inverted_cdf"). Values that are nan do not count, infinite ones do.

A one-sided tolerance bound is what a share of all flights does not exceed, whatever they follow. The value that the
share does not exceed is exceeded by a flight as often as a requirement with this share may fail. A bound that is the (k
+ 1)-th worst of the flights is below that value only if k flights or fewer exceed it, so k are the failures with which
the requirement is met (S. S. Wilks, Annals of Mathematical Statistics 12, 1941; Hanson and Beard, NASA/TP-2010-216447).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np

Blocks = Callable[[], Iterable[np.ndarray]]  # a column, from its beginning whenever it is called

HELD = 100_000  # values that are simply sorted
DIGIT = 16  # bits
SIGN = np.uint64(1 << 63)


def order_statistics(column: Blocks, ranks: Sequence[int]) -> list[float]:
    """Return the values of rank 0, the smallest, and so on; nan left out. Raises IndexError for a missing rank."""
    held: list[np.ndarray] = []
    size = 0
    for values in column():
        held.append(values[~np.isnan(values)])
        size += held[-1].size
        if size > HELD:
            del held[:]
            return _select(column, ranks)
    ordered = np.sort(np.concatenate([np.empty(0), *held]))
    return [float(ordered[rank]) for rank in ranks]


def _select(column: Blocks, ranks: Sequence[int]) -> list[float]:
    """Return the values of some ranks, by their bits from the highest: their prefix, and their ranks among such."""
    below, left = [0] * len(ranks), list(ranks)
    for place in range(64 - DIGIT, -1, -DIGIT):
        counts = {start: np.zeros(1 << DIGIT, dtype=np.int64) for start in below}
        for values in column():
            keys = _order_bits(values[~np.isnan(values)]) >> np.uint64(place)
            digits = (keys & np.uint64((1 << DIGIT) - 1)).astype(np.int64)
            starts = None if len(counts) == 1 and 0 in counts else keys >> np.uint64(DIGIT)
            for start, count in counts.items():
                mine = digits if starts is None else digits[starts == start]
                count += np.bincount(mine, minlength=1 << DIGIT) if mine.size else 0
        for index, start in enumerate(below):
            reached = np.cumsum(counts[start])
            if left[index] >= reached[-1]:
                raise IndexError(f"no value of rank {ranks[index]}")
            digit = int(np.searchsorted(reached, left[index], side="right"))
            left[index] -= int(reached[digit] - counts[start][digit])
            below[index] = start << DIGIT | digit
    bits = np.array(below, dtype=np.uint64)
    return np.where(bits & SIGN, bits ^ SIGN, ~bits).view(np.float64).tolist()


def _order_bits(values: np.ndarray) -> np.ndarray:
    """Return doubles as unsigned integers in the same order; both zeros are one number."""
    bits = (values + 0.0).view(np.uint64)
    return np.where(bits & SIGN, ~bits, bits ^ SIGN)


ROUNDING = 2.0**-51  # relative error of p n as doubles: 0.07 x 100 is 7.000000000000001, yet the 7th of 100 is meant


def quantile_rank(fraction: float, count: int) -> int:
    """Return the rank, from 0, of the ``fraction``-quantile of ``count`` values. Raises ValueError unless 0 <= fraction
    <= 1.

    ``count`` must be 1 or more.
    """
    return int(_ranks(fraction, np.array(count)))


def quantiles(values: np.ndarray, fractions: Sequence[float]) -> np.ndarray:
    """Return quantiles over the first axis of an array, fractions by rows; nan where all values are nan.

    Shape: that of ``values`` with ``len(fractions)`` in place of its first length. Raises as `quantile_rank`.
    """
    if not len(values):
        return np.full((len(fractions), *values.shape[1:]), np.nan)
    ordered = np.sort(values, axis=0)  # nan last
    known = np.count_nonzero(~np.isnan(values), axis=0)
    ranks = np.stack([_ranks(fraction, known) for fraction in fractions])
    return np.take_along_axis(ordered, ranks, axis=0)


def column_quantiles(column: Blocks, known: int, fractions: Sequence[float]) -> list[float]:
    """Return quantiles of a column that is read in blocks, ``known`` of whose values are not nan; nan where there is
    none.

    Memory does not grow with the column. Raises as `quantile_rank`.
    """
    ranks = [quantile_rank(fraction, known) for fraction in fractions]
    return order_statistics(column, ranks) if known else [math.nan] * len(ranks)


def _ranks(fraction: float, counts: np.ndarray) -> np.ndarray:
    if not 0.0 <= fraction <= 1.0:
        raise ValueError(f"the fraction {fraction!r} is not between 0 and 1")
    return np.maximum(np.ceil(fraction * counts * (1.0 - ROUNDING)).astype(int) - 1, 0)


def tolerance_bound(column: Blocks, flights: int, permitted: int, upper: bool) -> float | None:
    """Return the bound from the first ``flights`` values of a metric: their (``permitted`` + 1)-th largest, or
    smallest.

    ``permitted`` are the failures with which that many flights meet a requirement of the bound's share and confidence;
    where it is negative the flights are too few and there is no bound, None. What is not finite counts as worst: the
    bound is then infinite if the share cannot be had without it.
    """
    if permitted < 0:
        return None
    worst = np.inf if upper else -np.inf

    def count_permitted() -> Iterator[np.ndarray]:
        left = flights
        for values in column():
            yield np.where(np.isfinite(values), values, worst)[:left]
            left = max(0, left - len(values))

    (bound,) = order_statistics(count_permitted, [flights - 1 - permitted if upper else permitted])
    return bound
