"""The one definition of a quantile in tables, figures and verdicts: one of the values, nothing interpolated.

The p-quantile of n values is their order statistic k = ceil(p n), the least value that a fraction p of all does not
exceed: the inverse of the empirical distribution function (Hyndman and Fan 1996, The American Statistician 50,
definition 1; numpy's "inverted_cdf"). Values that are nan do not count, infinite ones do.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from .order_statistics import Blocks, order_statistics

ROUNDING = 2.0**-51  # relative error of p n as doubles: 0.07 x 100 is 7.000000000000001, yet the 7th of 100 is meant


def quantile_rank(fraction: float, count: int) -> int:
    """The rank, from 0, of the ``fraction``-quantile of ``count`` values. Raises ValueError unless 0 <= fraction <= 1.

    ``count`` must be 1 or more.
    """
    return int(_ranks(fraction, np.array(count)))


def quantiles(values: np.ndarray, fractions: Sequence[float]) -> np.ndarray:
    """Quantiles over the first axis of an array, fractions by rows; nan where all values are nan.

    Shape: that of ``values`` with ``len(fractions)`` in place of its first length. Raises as `quantile_rank`.
    """
    if not len(values):
        return np.full((len(fractions), *values.shape[1:]), np.nan)
    ordered = np.sort(values, axis=0)  # nan last
    known = np.count_nonzero(~np.isnan(values), axis=0)
    ranks = np.stack([_ranks(fraction, known) for fraction in fractions])
    return np.take_along_axis(ordered, ranks, axis=0)


def column_quantiles(column: Blocks, known: int, fractions: Sequence[float]) -> list[float]:
    """Quantiles of a column that is read in blocks, ``known`` of whose values are not nan; nan where there is none.

    Memory does not grow with the column. Raises as `quantile_rank`.
    """
    ranks = [quantile_rank(fraction, known) for fraction in fractions]
    return order_statistics(column, ranks) if known else [math.nan] * len(ranks)


def _ranks(fraction: float, counts: np.ndarray) -> np.ndarray:
    if not 0.0 <= fraction <= 1.0:
        raise ValueError(f"the fraction {fraction!r} is not between 0 and 1")
    return np.maximum(np.ceil(fraction * counts * (1.0 - ROUNDING)).astype(int) - 1, 0)
