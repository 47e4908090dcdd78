"""One-sided tolerance bounds by order statistics: what a share of all flights does not exceed, whatever they follow.

The value that the share does not exceed is exceeded by a flight as often as a requirement with this share may fail. A
bound that is the (k + 1)-th worst of the flights lies below that value only if k flights or fewer exceed it, so k are
the failures with which the requirement is met (S. S. Wilks, Annals of Mathematical Statistics 12, 1941; Hanson and
Beard, NASA/TP-2010-216447).
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .order_statistics import Blocks, order_statistics


def tolerance_bound(column: Blocks, flights: int, permitted: int, upper: bool) -> float | None:
    """The bound from the first ``flights`` values of a metric: their (``permitted`` + 1)-th largest, or smallest.

    ``permitted`` are the failures with which that many flights meet a requirement of the bound's share and
    confidence; where it is negative the flights are too few and there is no bound, None. What is not finite
    counts as worst: the bound is then infinite if the share cannot be had without it.
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
