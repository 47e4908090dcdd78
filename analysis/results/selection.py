"""The value of a rank among numbers too many to hold, exactly: their bits are counted from the first to the last."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

import numpy as np

DIGIT, WORD = 16, 64  # bits that are counted in one reading, and of a number
KEPT = 1_000_000  # numbers that are held, 8 MB, once all others are known to lie below or above

Readings = Callable[[], Iterable[np.ndarray]]


def quantile(read: Readings, share: float) -> float:
    """The least of some numbers that ``share`` of them does not exceed; nan where there is none.

    ``read`` gives the numbers in parts, each time anew: it is called at most five times, and memory does not grow with
    them. The inverse of the empirical distribution function (Hyndman and Fan 1996, definition 1) of all but nan.
    Raises ValueError unless 0 <= share <= 1.
    """
    if not 0.0 <= share <= 1.0:
        raise ValueError(f"the share {share!r} is not between 0 and 1")
    rank, prefix = 0, np.uint64(0)
    for known in range(0, WORD, DIGIT):
        counts = np.zeros(1 << DIGIT, dtype=np.int64)
        for keys in _keys(read, prefix, known):
            digits = (keys >> np.uint64(WORD - DIGIT - known)) & np.uint64((1 << DIGIT) - 1)
            counts += np.bincount(digits.astype(np.int64), minlength=1 << DIGIT)
        if known == 0:
            total = int(counts.sum())
            if not total:
                return math.nan
            rank = max(math.ceil(total * share - 1.0), 0)
        below = np.cumsum(counts)
        digit = int(np.searchsorted(below, rank, side="right"))
        rank -= int(below[digit] - counts[digit])
        prefix = np.uint64((int(prefix) << DIGIT) | digit)
        if known + DIGIT < WORD and counts[digit] <= KEPT:
            held = np.concatenate(list(_keys(read, prefix, known + DIGIT)))
            return _number(np.partition(held, rank)[rank])
    return _number(prefix)


def _keys(read: Readings, prefix: np.uint64, known: int) -> Iterable[np.ndarray]:
    """Whole numbers that are ordered as the doubles are, of those whose first ``known`` bits are ``prefix``."""
    sign = np.uint64(1 << (WORD - 1))
    for values in read():
        bits = (values[~np.isnan(values)] + 0.0).view(np.uint64)  # -0 becomes 0
        keys = np.where(bits & sign, ~bits, bits | sign)
        yield keys if known == 0 else keys[keys >> np.uint64(WORD - known) == prefix]


def _number(key: np.uint64) -> float:
    sign = np.uint64(1 << (WORD - 1))
    bits = key & ~sign if key & sign else ~key
    return float(np.array(bits, dtype=np.uint64).view(np.float64))
