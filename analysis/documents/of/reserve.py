"""Reserves between values and their limits, from which pages determine the tightest limit."""

from __future__ import annotations

import math

TIGHTEST = "tightest"


def relative_reserve(value: float, low: float | None, high: float | None) -> float:
    """Return the distance of a value from its nearer limit, relative to that limit, or to half the width of a range.

    It is negative outside the limits, and infinite for a single limit of 0, which has no scale.
    """
    if math.isnan(value):
        return -math.inf
    below = math.inf if low is None else value - low
    above = math.inf if high is None else high - value
    scale = low if high is None else high if low is None else 0.5 * (high - low)
    distance = min(below, above)
    return distance / abs(scale) if scale else math.copysign(math.inf, distance)
