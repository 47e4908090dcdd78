"""The scale of a column: bins between whose edges its numbers are counted. web/show/scale.ts draws axes along it."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from functools import cached_property

import numpy as np

BINS = 4096  # of a scale: a filter begins and ends at their edges
BARS = 64  # of a histogram, each of equally many bins
SHIFT = 6  # bits between the number of a bin and that of its bar
NAN, ABOVE, BELOW = (BINS + kind * (BINS // BARS) for kind in range(3))  # codes of what is not finite
CODES = BARS + 3  # of bars, with what is not finite
DECADES = 1e3  # ratio of the greatest magnitude to the small ones from which a scale is bent
SMALL = 0.05  # the fraction of magnitudes that are small
SAMPLED = 100_000  # numbers that decide whether it is
TINIEST = 1e-12  # knee of a bent scale relative to the greatest magnitude
CHUNK = 1 << 18  # numbers binned at a time


@dataclass(frozen=True)
class Scale:
    """From ``low`` to ``high``, finite; linear, or through asinh: linear below the ``knee``, logarithmic above it."""

    low: float
    high: float
    knee: float = 0.0

    @cached_property
    def edges(self) -> np.ndarray:
        """Ends of the bins (BINS + 1,), not falling: bin i has low <= number < high, the last one its end, too."""
        if self.knee:
            ends = np.linspace(math.asinh(self.low / self.knee), math.asinh(self.high / self.knee), BINS + 1)
            edges = self.knee * np.sinh(ends)
        else:
            edges = np.linspace(self.low, self.high, BINS + 1)
        edges[0], edges[-1] = self.low, self.high
        return np.maximum.accumulate(np.minimum(edges, self.high))

    def bin(self, numbers: np.ndarray) -> np.ndarray:
        """The bin of each number (rows,) as uint16; `NAN`, `ABOVE` or `BELOW` of what is not finite."""
        codes = np.empty(numbers.size, dtype=np.uint16)
        for first in range(0, numbers.size, CHUNK):
            part = numbers[first : first + CHUNK]
            bins = np.searchsorted(self.edges[1:-1], part, side="right")
            infinite = ~np.isfinite(part)
            if infinite.any():
                bins[infinite] = np.where(np.isnan(part), NAN, np.where(part > 0.0, ABOVE, BELOW))[infinite]
            codes[first : first + CHUNK] = bins
        return codes


def make_scale(numbers: np.ndarray) -> Scale | None:
    """The scale on which the finite ones of some numbers (rows,) are; None where none is finite."""
    finite = numbers[np.isfinite(numbers)]
    if not finite.size:
        return None
    low, high = float(finite.min()), float(finite.max())
    if low == high:  # a range about it
        pad = max(1e-3 * abs(low), 1e-3)
        return Scale(max(low - pad, -sys.float_info.max), min(high + pad, sys.float_info.max))
    sizes = np.abs(finite[:: max(1, finite.size // SAMPLED)])
    sizes = sizes[sizes != 0.0]
    greatest = max(abs(low), abs(high))
    rank = int(SMALL * sizes.size)
    small = float(np.partition(sizes, rank)[rank]) if sizes.size else greatest
    if greatest > DECADES * small or not math.isfinite(2.0 * (high - low)):
        return Scale(low, high, max(small, TINIEST * greatest))
    return Scale(low, high)
