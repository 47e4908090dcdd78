"""Comparison of times returned by FMUs, which accumulate rounding errors differently."""

from __future__ import annotations

OF_A_STEP = 1e-9
OF_A_TIME = 2.0**-50


def tolerance_of(begin: float, end: float) -> float:
    """Return the tolerance (s) within which a time counts as inside a step, or as the end of the step."""
    return OF_A_STEP * (end - begin) + OF_A_TIME * max(abs(begin), abs(end))


def is_within(time: float, begin: float, end: float) -> bool:
    """Return True if a time (s) is inside a step, up to rounding; False for NaN."""
    return begin - tolerance_of(begin, end) <= time <= end + tolerance_of(begin, end)
