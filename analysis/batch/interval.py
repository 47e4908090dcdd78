"""The confidence interval of a success rate."""

from __future__ import annotations

from scipy.stats import binomtest


def success_interval(successes: int, trials: int, confidence: float = 0.95) -> tuple[float, float]:
    """Interval (low, high) of the probability of success after ``successes`` in ``trials`` independent trials.

    Clopper and Pearson's exact interval: it covers the true rate with at least ``confidence``
    whatever that rate is. Wilson's is shorter but covers less than it says near 0 and 1, and
    rates near 1 are what guidance is judged by. Raises ValueError unless 0 <= successes <= trials, trials >= 1.
    """
    interval = binomtest(successes, trials).proportion_ci(confidence, method="exact")
    return float(interval.low), float(interval.high)
