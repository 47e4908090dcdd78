"""Which draws go with which metrics: Spearman's rank correlations over trials."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import scipy

FEWEST = 3  # trials with a finite value


def rank_correlations(
    draws: Mapping[str, np.ndarray], metrics: Mapping[str, np.ndarray]
) -> dict[str, dict[str, float | None]]:
    """Spearman's rho of every metric with every draw, by metric and draw; all columns are (trials,).

    Over the trials in which the metric is not nan: infinite values are the largest ranks. None where either has one
    value only, or fewer than `FEWEST` trials have one. Chance alone gives about 1 / sqrt(trials).
    """
    return {metric: {name: _rho(draw, values) for name, draw in draws.items()} for metric, values in metrics.items()}


def _rho(draw: np.ndarray, values: np.ndarray) -> float | None:
    known = ~np.isnan(values)
    draw, values = draw[known], values[known]
    if values.size < FEWEST or np.all(draw == draw[0]) or np.all(values == values[0]):
        return None
    return float(scipy.stats.spearmanr(draw, values).statistic)
