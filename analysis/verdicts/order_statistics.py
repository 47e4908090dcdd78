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
            return [_select(column, rank) for rank in ranks]
    ordered = np.sort(np.concatenate([np.empty(0), *held]))
    return [float(ordered[rank]) for rank in ranks]


def _select(column: Blocks, rank: int) -> float:
    """The value of a rank, by its bits from the highest."""
    found, left = np.uint64(0), rank
    for place in range(64 - DIGIT, -1, -DIGIT):
        counts = np.zeros(1 << DIGIT, dtype=np.int64)
        for values in column():
            keys = _ordered(values[~np.isnan(values)])
            above = np.uint64(place + DIGIT)
            mine = keys if place == 64 - DIGIT else keys[keys >> above == found >> above]
            digits = (mine >> np.uint64(place)) & np.uint64((1 << DIGIT) - 1)
            counts += np.bincount(digits.astype(np.int64), minlength=1 << DIGIT)
        reached = np.cumsum(counts)
        if left >= reached[-1]:
            raise IndexError(f"no value of rank {rank}")
        digit = int(np.searchsorted(reached, left, side="right"))
        left -= int(reached[digit] - counts[digit])
        found |= np.uint64(digit << place)
    bits = found ^ SIGN if found & SIGN else ~found
    return float(np.array(bits, dtype=np.uint64).view(np.float64))


def _ordered(values: np.ndarray) -> np.ndarray:
    """Doubles as unsigned integers in the same order; both zeros are one number."""
    bits = (values + 0.0).view(np.uint64)
    return np.where(bits & SIGN, ~bits, bits ^ SIGN)
