"""Statistics of a metric over trials: mean, standard deviation, root mean square, extremes and quantiles."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .verdicts.order_statistics import Blocks, column_quantiles

QUANTILES = {"p5": 5, "p50": 50, "p95": 95, "p99": 99}  # %
STATISTICS = ("mean", "std", "rms", "min", *QUANTILES, "max")  # in the order of tables
IN_MEMORY = 2**20  # most values of a column that is read into memory at once, 8 MB


@dataclass(frozen=True)
class MetricStatistics:
    """Statistics of a metric over trials, in ``unit``.

    ``mean``, sample standard deviation ``std``, ``max``, ``min`` and ``rms`` are computed from the ``count`` finite
    values. The quantiles ``p5`` to ``p99`` include infinite values but not nan; each is the value of a trial. ``std``
    is None with fewer than two values, and the other statistics are None without any value.
    """

    count: int
    mean: float | None
    std: float | None
    max: float | None
    min: float | None
    rms: float | None
    p5: float | None
    p50: float | None
    p95: float | None
    p99: float | None
    unit: str

    def value(self, name: str) -> float | None:
        number: float | None = getattr(self, name)
        return number


def statistics(column: Blocks, unit: str) -> MetricStatistics:
    """Return the statistics of a column over trials, in bounded memory, with sums that are rounded only once."""
    column = _read_once(column)
    count, known, minimum, maximum = 0, 0, math.inf, -math.inf
    for values in column():
        finite = values[np.isfinite(values)]
        count += finite.size
        known += int(np.count_nonzero(~np.isnan(values)))
        if finite.size:
            minimum, maximum = min(minimum, float(finite.min())), max(maximum, float(finite.max()))
    mean = _sum(column, lambda values: values) / count if count else 0.0
    squares = _sum(column, lambda values: np.square(values - mean)) if count > 1 else 0.0
    quantiles: list[float | None] = [None] * len(QUANTILES)
    if known:
        quantiles = [*column_quantiles(column, known, [percent / 100.0 for percent in QUANTILES.values()])]
    return MetricStatistics(
        count=count,
        mean=mean if count else None,
        std=math.sqrt(squares / (count - 1)) if count > 1 else None,
        max=maximum if count else None,
        min=minimum if count else None,
        rms=math.sqrt(_sum(column, np.square) / count) if count else None,
        **dict(zip(QUANTILES, quantiles, strict=True)),
        unit=unit,
    )


def _read_once(column: Blocks) -> Blocks:
    """Return a column read into memory, or the column itself if it is too long."""
    blocks: list[np.ndarray] = []
    for values in column():
        blocks.append(values)
        if sum(map(len, blocks)) > IN_MEMORY:
            return column
    return lambda: blocks


def _sum(column: Blocks, of: Callable[[np.ndarray], np.ndarray]) -> float:
    """Return the sum of a function over the finite values, rounded only once."""
    terms = (of(values[np.isfinite(values)]).tolist() for values in column())
    try:
        return math.fsum(itertools.chain.from_iterable(terms))
    except OverflowError:
        return math.inf


def quantile(column: Blocks, fraction: float) -> float:
    """Return the smallest value that a ``fraction`` of all values of a column does not exceed; nan for an empty column.

    The result is exact, and memory is bounded. Raises ValueError unless 0 <= fraction <= 1.
    """
    known = sum(int(np.count_nonzero(~np.isnan(values))) for values in column())
    return column_quantiles(column, known, [fraction])[0]
