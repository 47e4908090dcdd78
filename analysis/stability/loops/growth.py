"""Steady growth of the effect of a disturbance, which indicates an unstable loop in a simulation."""

from __future__ import annotations

import numpy as np

WINDOWS = 4  # windows of equal length in which a deviation's size is compared
MINIMUM = 0.05  # least growth of the logarithm from window to window
STEADY = 0.05  # spread of this growth over its mean; it is 0.3 for a power of time over the fifth to the eighth window
HUGE = 1e100  # deviation that counts as an overflow, whether or not it has grown steadily before


def steady_growth(deviation: np.ndarray) -> float | None:
    """Return the factor per sample by which a deviation (n,) has grown over its last three quarters.

    None if it has not grown, or if the growth of successive quarters differs.
    """
    width = len(deviation) // WINDOWS
    if width < 1 or not np.all(np.isfinite(deviation)):
        return None
    sizes = np.abs(deviation[len(deviation) - WINDOWS * width :]).reshape(WINDOWS, width).max(axis=1)
    if sizes.min() <= 0.0:
        return None
    steps = np.diff(np.log(sizes))
    if steps.min() < MINIMUM or np.ptp(steps) > STEADY * steps.mean():
        return None
    return float(np.exp(steps.mean() / width))


def growth_to_overflow(deviation: np.ndarray) -> float | None:
    """Return the factor per sample by which a deviation (n,) grew until an overflow; None if it hardly changed."""
    finite = deviation[np.isfinite(deviation)]
    rate = steady_growth(finite)
    if rate is not None or not finite.size:
        return rate
    sizes = np.abs(finite)
    changed = np.flatnonzero(sizes > 0.0)
    if not changed.size or sizes.max() < HUGE:
        return None
    first, last = int(changed[0]), int(np.argmax(sizes))
    return float(np.exp((np.log(sizes[last]) - np.log(sizes[first])) / max(last - first, 1)))
