"""One metric over trials: mean, deviation, root of the mean square, extremes and quantiles."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from .verdicts.order_statistics import Blocks
from .verdicts.quantiles import column_quantiles

QUANTILES = {"p5": 5, "p50": 50, "p95": 95, "p99": 99}  # %
STATISTICS = ("mean", "std", "rms", "min", *QUANTILES, "max")  # as tables show them
HELD = 2**20  # values that are kept in memory, 8 MB
INFINITE = ("inf", "-inf")  # strict JSON has no such numbers


def statistics(column: Blocks, unit: str) -> dict[str, Any]:
    """Statistics of a column over trials, in memory that their number does not change.

    ``count`` is of the finite ones, and so are ``mean``, sample deviation ``std``, ``rms``, ``max`` and ``min``. Sums
    are rounded once, whatever the blocks. Quantiles are over all but nan, infinite ones included, which are then "inf"
    or "-inf": each is that of a trial, see verdicts/quantiles.py. What cannot be had from so few values (the deviation
    from one, everything from none) is None.
    """
    column = _read_once(column)
    count, known, least, most = 0, 0, math.inf, -math.inf
    for values in column():
        finite = values[np.isfinite(values)]
        count += finite.size
        known += int(np.count_nonzero(~np.isnan(values)))
        if finite.size:
            least, most = min(least, float(finite.min())), max(most, float(finite.max()))
    some = count > 0
    mean = _sum(column, lambda values: values) / count if some else 0.0
    squares = _sum(column, lambda values: np.square(values - mean)) if count > 1 else 0.0
    return {
        "count": count,
        "mean": mean if some else None,
        "std": math.sqrt(squares / (count - 1)) if count > 1 else None,
        "max": most if some else None,
        "min": least if some else None,
        "rms": math.sqrt(_sum(column, np.square) / count) if some else None,
        **_quantiles(column, known),
        "unit": unit,
    }


def _read_once(column: Blocks) -> Blocks:
    """The same column, held in memory unless it is a very long one."""
    held: list[np.ndarray] = []
    for values in column():
        held.append(values)
        if sum(map(len, held)) > HELD:
            return column
    return lambda: held


def _sum(column: Blocks, of: Callable[[np.ndarray], np.ndarray]) -> float:
    """The sum of a function of the finite values, rounded once."""
    found = (of(values[np.isfinite(values)]).tolist() for values in column())
    try:
        return math.fsum(itertools.chain.from_iterable(found))
    except OverflowError:
        return math.inf


def _quantiles(column: Blocks, known: int) -> dict[str, float | str | None]:
    if not known:
        return dict.fromkeys(QUANTILES)
    values = column_quantiles(column, known, [percent / 100.0 for percent in QUANTILES.values()])
    return {key: value if math.isfinite(value) else str(value) for key, value in zip(QUANTILES, values, strict=True)}


def quantile(column: Blocks, share: float) -> float:
    """The least value of a column that a ``share`` of them does not exceed, as in `statistics`; nan if there is none.

    Exact, in memory that their number does not change. Raises ValueError unless 0 <= share <= 1.
    """
    known = sum(int(np.count_nonzero(~np.isnan(values))) for values in column())
    return column_quantiles(column, known, [share])[0]
