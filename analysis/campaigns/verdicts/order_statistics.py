"""Exact order statistics of a column that is read in blocks, with memory that its length does not change.

A double's bits, turned so that they order as the numbers do, are sixteen bits four times. Every time the values that
begin as the wanted one are counted by their next sixteen bits, until one is left: radix selection.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

Blocks = Callable[[], Iterable[np.ndarray]]  # a column, from its beginning whenever it is called

HELD = 100_000  # values that are simply sorted
DIGIT = 16  # bits
SIGN = np.uint64(1 << 63)


def order_statistics(column: Blocks, ranks: Sequence[int]) -> list[float]:
    """The values of rank 0, the smallest, and so on; nan left out. Raises IndexError for a rank that there is not."""
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
    """The values of some ranks, by their bits from the highest: what they begin with, and their ranks among such."""
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
    """Doubles as unsigned integers in the same order; both zeros are one number."""
    bits = (values + 0.0).view(np.uint64)
    return np.where(bits & SIGN, ~bits, bits ^ SIGN)
