"""Values over the rows of flights, one flight behind another, reduced to one number for each: compiled.

Sums go from the first row to the last, so that a mean is the same however many flights are looked at together.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any, NamedTuple

import numpy as np

REDUCTIONS = ("final", "min", "max", "mean", "rms", "last_outside", "settled", "first")
FINAL, MIN, MAX, MEAN, RMS, LAST_OUTSIDE, SETTLED, FIRST = range(len(REDUCTIONS))
EVER = (-np.inf, np.inf)  # a window, or a band
ROUNDING = 1e-6  # of a step, that times, start + n h, may miss


class Rule(NamedTuple):
    """How rows become a number; entries that a reduction has no use for are not looked at. Times in s."""

    kind: int  # place in REDUCTIONS
    window: tuple[float, float]  # both ends included
    band: tuple[float, float]  # within which values have settled
    delay: float  # of `first`


def _reduce(rule, times, values, condition, ends):  # type: ignore[no-untyped-def]
    """One number for each flight; of a flight without rows in the window NaN."""
    reduced = np.full(ends.size, np.nan)
    start = 0
    for flight in range(ends.size):
        first, end = start, ends[flight]
        start = end
        if first == end:
            continue
        rounding = ROUNDING * (times[first + 1] - times[first]) if end - first > 1 else 0.0
        beginning = max(rule.window[0], times[first])
        while first < end and not times[first] >= rule.window[0] - rounding:
            first += 1
        while end > first and not times[end - 1] <= rule.window[1] + rounding:
            end -= 1
        if first == end:
            continue
        if rule.kind == FINAL:
            reduced[flight] = values[end - 1]
        elif rule.kind == MIN or rule.kind == MAX:
            extreme = values[first]
            for row in range(first, end):
                value = values[row]
                if value < extreme if rule.kind == MIN else value > extreme:
                    extreme = value
                if np.isnan(value):
                    extreme = value
                    break
            reduced[flight] = extreme
        elif rule.kind == MEAN:
            total = 0.0
            for row in range(first, end):
                total += values[row]
            reduced[flight] = total / (end - first)
        elif rule.kind == RMS:
            total = 0.0
            for row in range(first, end):
                total += values[row] * values[row]
            reduced[flight] = np.sqrt(total / (end - first))
        elif rule.kind == LAST_OUTSIDE:
            row = end - 1
            while row >= first and rule.band[0] <= values[row] <= rule.band[1]:
                row -= 1
            reduced[flight] = np.inf if row == end - 1 else times[max(row, first)]
        elif rule.kind == SETTLED:
            row = end - 1
            while row >= first and values[row] != 0.0 and not np.isnan(values[row]):
                row -= 1
            reduced[flight] = np.inf if row == end - 1 else 0.0 if row < first else times[row + 1] - beginning
        else:
            row = first
            while row < end and (condition[row] == 0.0 or np.isnan(condition[row])):
                row += 1
            if row < end:
                rounding = ROUNDING * (times[first + 1] - times[first]) if end - first > 1 else 0.0
                due = times[row] + rule.delay - rounding
                while row > first and times[row - 1] >= due:
                    row -= 1
                while row < end and times[row] < due:
                    row += 1
                if row < end:
                    reduced[flight] = values[row]
    return reduced


@cache
def _compiled() -> Any:
    from ...common.compiler import compile_cached  # imports numba, a third of a second

    return compile_cached(_reduce, nogil=True)


def reduce_rows(
    rule: Rule, times: np.ndarray, values: np.ndarray, condition: np.ndarray, ends: np.ndarray
) -> np.ndarray:
    """A number (flights,) for each flight, whose rows end before ``ends`` (int64).

    NaN where a flight has no row in the window. ``times`` (s, growing within a flight), ``values`` and ``condition``
    are float64, one per row.

    - ``final``, ``min``, ``max``, ``mean``, ``rms``: all rows alike; a NaN makes those but the first NaN.
    - ``last_outside``: the last time at which the values are outside the band, NaN being outside: the first time when
      they never are, inf when they still are in the last row.
    - ``settled``: the time from the window's start, or the flight's if that is later, to the first row from which on
      the values are true to the last row; 0 when all are, inf when the last is not. NaN is not true.
    - ``first``: the value in the first row ``delay`` or more behind the first one in which the condition is true; NaN
      when there is none. A millionth of a step may be missing to the delay.
    """
    reduce: Callable[..., np.ndarray] = _compiled()
    return reduce(rule, times, values, condition, ends)


def largest(times: np.ndarray, values: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """The largest value of each flight (flights,), 0 for one without rows."""
    return np.nan_to_num(reduce_rows(Rule(MAX, EVER, EVER, 0.0), times, values, values, ends))
