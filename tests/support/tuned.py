"""Other values of parameters, within bounds."""

from __future__ import annotations


def another(value: float | int | bool, low: float | None, high: float | None) -> float | int | bool:
    """Return another value of the same type within bounds; the same one where there is none."""
    if isinstance(value, bool):
        return not value
    real = [1.1 * value + 0.01, 0.9 * value - 0.01, 0.5 * value]
    options = [value + 1, value - 1] if isinstance(value, int) else real
    return next((each for each in options if (low is None or each >= low) and (high is None or each <= high)), value)
