"""The rounding that times (s) of FMUs may have, which add them up in their own ways."""

from __future__ import annotations

OF_A_STEP = 1e-9
OF_A_TIME = 2.0**-50


def allowance(begin: float, end: float) -> float:
    """Return by how much (s) a time may lie outside a step, or lack of its end, and still count as in it or as it."""
    return OF_A_STEP * (end - begin) + OF_A_TIME * max(abs(begin), abs(end))
