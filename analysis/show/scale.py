"""Scale of a column: the bins in which its numbers are counted. web/show/scale.ts draws the matching axes."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..documents.interactive.columns import knee_of

BINS = 4096  # bins of a scale; a filter begins and ends at edges of bins
BARS = 64  # bars of a histogram, with equally many bins each
SHIFT = 6  # the index of a bin shifted right by this is the index of its bar
NAN, ABOVE, BELOW = (BINS + kind * (BINS // BARS) for kind in range(3))  # codes of non-finite numbers
CODES = BARS + 3  # number of bars and codes of non-finite numbers
SAMPLED = 100_000  # numbers sampled to choose between a linear and an asinh scale
TINIEST = 1e-12  # least knee of an asinh scale relative to the greatest magnitude
WHOLE = 1e9  # width of a range of whole numbers up to which bins are aligned with them
CHUNK = 1 << 18  # numbers binned at a time


@dataclass(frozen=True)
class ColumnScale:
    """Scale from ``low`` to ``high``, both finite: linear, or with a ``knee`` linear in asinh(x / knee).

    With a knee it is nearly linear below the knee, and logarithmic above it.
    """

    low: float
    high: float
    knee: float = 0.0

    @cached_property
    def edges(self) -> np.ndarray:
        """The edges of the bins, (BINS + 1,), non-decreasing: bin i contains edges[i] <= number < edges[i + 1]."""
        if self.knee:
            ends = np.linspace(math.asinh(self.low / self.knee), math.asinh(self.high / self.knee), BINS + 1)
            edges = self.knee * np.sinh(ends)
        else:
            edges = np.linspace(self.low, self.high, BINS + 1)
        edges[0], edges[-1] = self.low, self.high
        return np.maximum.accumulate(np.minimum(edges, self.high))

    def bin(self, numbers: np.ndarray) -> np.ndarray:
        """Return the bin of each number, uint16 (rows,); `NAN`, `ABOVE` or `BELOW` for non-finite numbers."""
        codes = np.empty(numbers.size, dtype=np.uint16)
        for first in range(0, numbers.size, CHUNK):
            chunk = numbers[first : first + CHUNK]
            bins = np.searchsorted(self.edges[1:-1], chunk, side="right")
            infinite = ~np.isfinite(chunk)
            if infinite.any():
                bins[infinite] = np.where(np.isnan(chunk), NAN, np.where(chunk > 0.0, ABOVE, BELOW))[infinite]
            codes[first : first + CHUNK] = bins
        return codes


def make_scale(numbers: np.ndarray) -> ColumnScale | None:
    """Return a scale that spans the finite numbers of a column (rows,); None if it contains none.

    All numbers are below the high end, which only the greatest double may equal.
    """
    finite = numbers[np.isfinite(numbers)]
    if not finite.size:
        return None
    low, high = float(finite.min()), float(finite.max())
    if low == high:  # a nonzero range around the only number
        pad = 1e-3 * abs(low) or 1.0
        return ColumnScale(max(low - pad, -sys.float_info.max), min(high + pad, sys.float_info.max))
    greatest = max(abs(low), abs(high))
    above = min(math.nextafter(high, math.inf), sys.float_info.max)
    knee = knee_of(finite[:: max(1, finite.size // SAMPLED)], greatest)
    if knee or not math.isfinite(2.0 * (high - low)):
        return ColumnScale(low, above, max(knee or greatest, TINIEST * greatest))
    if high - low < WHOLE and not np.any(finite % 1.0):
        return _whole_scale(low, high)
    return ColumnScale(low, above)


def _whole_scale(low: float, high: float) -> ColumnScale:
    """Return a scale for whole numbers: equally many numbers per bar, or bars per number."""
    count = high - low + 1.0
    step = math.ceil(count / BARS) if count > BARS else 1.0 / (BARS // count)
    return ColumnScale(low - 0.5, low - 0.5 + BARS * step)
