"""Sobol' indices: the share of a number's variance that each draw causes, alone and with other draws.

Source: Saltelli et al. (2010), with two independent tables of draws, A and B, and for each draw a copy of A with this
column of B.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy

CONFIDENCE = 0.95
RESAMPLES = 999


@dataclass(frozen=True, eq=False)
class Indices:
    """First-order and total indices (numbers, inputs) with their 95 % intervals (2, numbers, inputs), low and high.

    The first-order index is the share of the variance that an input causes by itself; the total index is the share that
    remains if all other inputs are fixed.
    """

    first: np.ndarray
    total: np.ndarray
    first_interval: np.ndarray
    total_interval: np.ndarray


def saltelli_points(base: int, dimensions: int, random: np.random.Generator) -> np.ndarray:
    """Return points of the unit cube (base * (dimensions + 2), dimensions): A, B, and A with each column of B.

    ``base`` is a power of two. A and B are halves of a scrambled Sobol' sequence with twice as many dimensions.
    """
    both = scipy.stats.qmc.Sobol(2 * dimensions, scramble=True, bits=64, rng=random).random(base)
    first, second = both[:, :dimensions], both[:, dimensions:]
    mixed = np.tile(first, (dimensions, 1, 1))
    places = np.arange(dimensions)
    mixed[places, :, places] = second.T
    return np.concatenate([first, second, *mixed])


def with_noise(points: np.ndarray, base: int) -> tuple[np.ndarray, np.ndarray]:
    """Return points and streams with noise as an additional input: `saltelli_points`, and A with the streams of B.

    Points have the shape (base * (dimensions + 3), dimensions), streams (base * (dimensions + 3),). A stream is the
    number of a noise realisation: row i of A has i, row i of B has base + i, and every mixed table has the streams of
    A, except the last, which has the streams of B.
    """
    first = np.arange(base)
    mixes = len(points) // base - 2
    return np.concatenate([points, points[:base]]), np.concatenate(
        [first, first + base, *[first] * mixes, first + base]
    )


def indices(values: np.ndarray, base: int, random: np.random.Generator) -> Indices:
    """Compute the indices of ``numbers`` (numbers, base * (inputs + 2)) at points of `saltelli_points` or `with_noise`.

    Numbers must be finite and not constant. The intervals are percentiles of a bootstrap over the rows.
    """
    pages = values.reshape(len(values), -1, base)  # numbers, A B AB..., rows

    def statistic(rows: np.ndarray) -> np.ndarray:
        part = pages[:, :, rows]
        if part.shape[:2] == (1, 3):  # scipy rejects one number of one input: pass it twice and use the first result
            part = np.repeat(part, 2, axis=0)
        parts = {"f_A": part[:, 0], "f_B": part[:, 1], "f_AB": part[:, 2:].swapaxes(0, 1)}
        sobol = scipy.stats.sobol_indices(func=parts, n=base)
        shape = (len(part), -1)  # restores the axis of a single number
        return np.stack([order.reshape(shape)[: len(pages)] for order in (sobol.first_order, sobol.total_order)])

    whole = statistic(np.arange(base))
    spread = scipy.stats.bootstrap(
        (np.arange(base),),
        statistic,
        n_resamples=RESAMPLES,
        vectorized=False,
        method="percentile",
        confidence_level=CONFIDENCE,
        rng=random,
    ).confidence_interval
    ends = np.stack([spread.low, spread.high])
    return Indices(whole[0], whole[1], ends[:, 0], ends[:, 1])


FEWEST = 3  # trials with a finite value


def rank_correlations(
    draws: Mapping[str, np.ndarray], metrics: Mapping[str, np.ndarray]
) -> dict[str, dict[str, float | None]]:
    """Return Spearman's rho of every metric with every draw, by metric and draw; all columns are (trials,).

    Only trials in which the metric is not nan count; infinite values have the largest ranks. A correlation is None if
    metric or draw has a single value, or fewer than `FEWEST` trials count. Its standard error is about 1 /
    sqrt(trials).
    """
    return {metric: {name: _rho(draw, values) for name, draw in draws.items()} for metric, values in metrics.items()}


def _rho(draw: np.ndarray, values: np.ndarray) -> float | None:
    known = ~np.isnan(values)
    draw, values = draw[known], values[known]
    if values.size < FEWEST or np.all(draw == draw[0]) or np.all(values == values[0]):
        return None
    return float(scipy.stats.spearmanr(draw, values).statistic)
