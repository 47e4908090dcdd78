"""Uncertainty of a probability from subset simulation: correlation within chains, and within families of chains."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.stats import beta, binomtest, t

CONFIDENCE = 0.95


class ConfidenceInterval(NamedTuple):
    """Confidence interval, and the coefficient of variation on which it is based."""

    low: float
    high: float
    variation: float


FINE, COARSE = 2.0, 10.0  # the ratio of an interval's ends up to which three and two digits of an estimate are shown


def significant_digits(low: float, high: float) -> int:
    """Return the number of significant digits of an estimate with the interval from ``low`` to ``high``."""
    if high <= FINE * low:
        return 3
    return 2 if high <= COARSE * low else 1


def binomial_interval(failures: int, samples: int, confidence: float) -> ConfidenceInterval:
    """Return Clopper and Pearson's interval for independent samples."""
    ends = binomtest(failures, samples).proportion_ci(confidence, method="exact")
    fraction = failures / samples
    return ConfidenceInterval(
        float(ends.low), float(ends.high), float(np.sqrt((1.0 - fraction) / (fraction * samples)))
    )


def fractional_interval(failures: float, samples: float, confidence: float) -> ConfidenceInterval:
    """Return Clopper and Pearson's interval for effective, not necessarily integer, numbers of failures and samples."""
    outside = (1.0 - confidence) / 2.0
    low = float(beta.ppf(outside, failures, samples - failures + 1.0)) if failures > 0.0 else 0.0
    high = float(beta.ppf(1.0 - outside, failures + 1.0, samples - failures)) if failures < samples else 1.0
    fraction = failures / samples
    return ConfidenceInterval(
        low, high, float(np.sqrt((1.0 - fraction) / (fraction * samples))) if fraction > 0.0 else float("inf")
    )


def equivalent_trials(probability: float, variation: float) -> float | None:
    """Return the number of plain Monte Carlo trials with the same coefficient of variation; None if it is 0."""
    return None if variation == 0.0 else (1.0 - probability) / (probability * variation**2)


def chain_correlation(inside: np.ndarray) -> float:
    """Return the factor gamma of Au and Beck (2001, equation 29) for chains of points inside or outside an event.

    ``inside`` (chains, length) is True for points in the event. If the chains were independent of each other, the
    variance of their mean would be 1 + gamma times that of independent points.
    """
    length = inside.shape[1]
    mean = float(inside.mean())
    if length == 1 or mean in (0.0, 1.0):
        return 0.0
    values = inside.astype(float)
    variance = mean * (1.0 - mean)
    total = 0.0
    for lag in range(1, length):
        covariance = float(np.mean(values[:, :-lag] * values[:, lag:])) - mean**2
        total += (1.0 - lag / length) * covariance / variance
    return max(2.0 * total, -1.0)


def family_interval(probability: float, families: np.ndarray, first: int, confidence: float) -> ConfidenceInterval:
    """Return the interval of a probability estimated by levels; ``families`` are the origins of failed points.

    The failed descendants of each of the ``first`` points of the first level count as one independent draw. The
    relative variance of the mean of these draws is the relative variance of the estimate, including all correlation
    within chains, between chains of one origin and from level to level (the genealogical estimator: Chan and Lai 2013;
    Lee and Whiteley 2018, section 2.3). The interval is log-normal, with Student's t for the degrees of freedom of the
    sum of squares (Satterthwaite).
    """
    _, sizes = np.unique(families, return_counts=True)
    fractions = sizes / sizes.sum()
    squares = fractions**2
    variance = max(float(squares.sum()) - 1.0 / first, 0.0)
    freedom = max(2.0 * float(squares.sum()) ** 2 / float((squares**2).sum()) - 1.0, 1.0)
    deviation = np.sqrt(np.log1p(variance))  # of the logarithm, which is normal
    factor = float(np.exp(t.ppf(0.5 + confidence / 2.0, freedom) * deviation))
    return ConfidenceInterval(probability / factor, min(probability * factor, 1.0), float(np.sqrt(variance)))
