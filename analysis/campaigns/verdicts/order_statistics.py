"""Exact order statistics of a column read in blocks; quantiles and tolerance bounds from them.

Memory does not grow with the column. The bits of a double, mapped to an unsigned integer of the same order, are
processed in four groups of sixteen bits. In each pass, values with the prefix found so far are counted by their next
sixteen bits, until a single value is left: radix selection.

The p-quantile of n values, in tables, figures and verdicts, is their order statistic k = ceil(p n), the least value
that a fraction p of all values does not exceed: the inverse of the empirical distribution function (Hyndman and Fan
1996, The American Statistician 50, definition 1; numpy's "inverted_cdf"). nan does not count, infinite values do.

A one-sided tolerance bound is a value that a share of all simulations does not exceed, for any distribution. The
share's quantile is exceeded as often as a requirement with this share may fail. The (k + 1)-th worst simulation is
below that quantile only if at most k simulations exceed it, so k is the number of failures with which the requirement
is met (S. S. Wilks, Annals of Mathematical Statistics 12, 1941; Hanson and Beard, NASA/TP-2010-216447).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence

import numpy as np

Blocks = Callable[[], Iterable[np.ndarray]]  # returns the blocks of a column, from its beginning on every call

HELD = 100_000  # most values that are sorted instead
DIGIT = 16  # bits counted in a pass
SIGN = np.uint64(1 << 63)


def order_statistics(column: Blocks, ranks: Sequence[int]) -> list[float]:
    """Return the values of these ranks, from 0 for the smallest, without nan. Raises IndexError for a missing rank."""
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
    """Return the values of ranks among the values with a common prefix of high bits."""
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
                raise IndexError(f"no value has rank {ranks[index]}")
            digit = int(np.searchsorted(reached, left[index], side="right"))
            left[index] -= int(reached[digit] - counts[start][digit])
            below[index] = start << DIGIT | digit
    bits = np.array(below, dtype=np.uint64)
    return np.where(bits & SIGN, bits ^ SIGN, ~bits).view(np.float64).tolist()


def _order_bits(values: np.ndarray) -> np.ndarray:
    """Return doubles as unsigned integers of the same order; both zeros yield the same integer."""
    bits = (values + 0.0).view(np.uint64)
    return np.where(bits & SIGN, ~bits, bits ^ SIGN)


ROUNDING = 2.0**-51  # relative error of p n as doubles: 0.07 x 100 is 7.000000000000001, yet the 7th of 100 is meant


def quantile_rank(fraction: float, count: int) -> int:
    """Return the rank, from 0, of the ``fraction``-quantile of ``count`` values.

    Raises ValueError unless 0 <= fraction <= 1. ``count`` must be at least 1.
    """
    return int(_ranks(fraction, np.array(count)))


def quantiles(values: np.ndarray, fractions: Sequence[float]) -> np.ndarray:
    """Return quantiles over the first axis of an array, a row for each fraction; nan if all values are nan.

    The result has the shape of ``values``, with ``len(fractions)`` as its first length. Raises ValueError as
    `quantile_rank` does.
    """
    if not len(values):
        return np.full((len(fractions), *values.shape[1:]), np.nan)
    ordered = np.sort(values, axis=0)  # nan last
    known = np.count_nonzero(~np.isnan(values), axis=0)
    ranks = np.stack([_ranks(fraction, known) for fraction in fractions])
    return np.take_along_axis(ordered, ranks, axis=0)


def column_quantiles(column: Blocks, known: int, fractions: Sequence[float]) -> list[float]:
    """Return quantiles of a column read in blocks; nan if the number ``known`` of values other than nan is 0.

    Memory does not grow with the column. Raises ValueError as `quantile_rank` does.
    """
    ranks = [quantile_rank(fraction, known) for fraction in fractions]
    return order_statistics(column, ranks) if known else [math.nan] * len(ranks)


def _ranks(fraction: float, counts: np.ndarray) -> np.ndarray:
    if not 0.0 <= fraction <= 1.0:
        raise ValueError(f"the fraction {fraction!r} is not between 0 and 1")
    return np.maximum(np.ceil(fraction * counts * (1.0 - ROUNDING)).astype(int) - 1, 0)


def tolerance_bound(column: Blocks, flights: int, permitted: int, upper: bool) -> float | None:
    """Return the (``permitted`` + 1)-th largest, or smallest, of the first ``flights`` values of a metric.

    ``permitted`` is the number of failures with which these simulations meet a requirement of the bound's share and
    confidence. If it is negative, there are too few simulations, and None is returned. Non-finite values count as
    worst: the bound is infinite if the share cannot be reached without them.
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
