"""Times that FMUs say, which add them up in their own ways."""

from __future__ import annotations

OF_A_STEP = 1e-9
OF_A_TIME = 2.0**-50


def tolerance_of(begin: float, end: float) -> float:
    """Return by how much (s) a time may lie outside of a step, or before its end, and count as in it, or as its end."""
    return OF_A_STEP * (end - begin) + OF_A_TIME * max(abs(begin), abs(end))


def is_within(time: float, begin: float, end: float) -> bool:
    """Return True for a time (s) in a step, up to rounding; not for NaN."""
    return begin - tolerance_of(begin, end) <= time <= end + tolerance_of(begin, end)
