"""Reduction of values over the rows of consecutive simulations to one number for each simulation, in C."""

from __future__ import annotations

import ctypes
from typing import NamedTuple

import numpy as np

from ...runtime.loop.library import load_library

REDUCTIONS = ("final", "min", "max", "mean", "rms", "last_outside", "settled", "first")
MAX = REDUCTIONS.index("max")
EVER = (-np.inf, np.inf)  # unlimited window or band


class ReductionRule(NamedTuple):
    """Reduction of rows to a number. Fields that a reduction does not use are ignored. Times are in s."""

    kind: int  # index in REDUCTIONS
    window: tuple[float, float]  # both ends included
    band: tuple[float, float]  # permitted values of `last_outside`
    delay: float  # of `first`


def reduce_rows(
    rule: ReductionRule, times: np.ndarray, values: np.ndarray, condition: np.ndarray, ends: np.ndarray
) -> np.ndarray:
    """Return one number (flights,) for each simulation, whose rows end before its entry in ``ends`` (int64).

    The number is NaN if a simulation has no row in the window. ``times`` (s, increasing within a simulation),
    ``values`` and ``condition`` are float64, one for each row.

    - ``final``, ``min``, ``max``, ``mean``, ``rms``: over all rows in the window, with equal weight; NaN if any value
      is NaN, except for ``final``
    - ``last_outside``: the last time at which the value is outside the band (NaN counts as outside); the first time if
      it never is, inf if it is outside in the last row
    - ``settled``: the time from the start of the window, or of the simulation if later, to the first row from which
      on all values are true; 0 if all values are true, inf if the last value is not; NaN is not true
    - ``first``: the value in the first row at least ``delay`` after the first row in which the condition is true,
      with a tolerance of a millionth of a step; NaN if there is no such row
    """
    reduced = np.empty(ends.size)
    limits = np.array([*rule.window, *rule.band, rule.delay])
    arrays = [limits, *(np.ascontiguousarray(column, dtype=float) for column in (times, values, condition))]
    addresses = [ctypes.c_void_p(array.ctypes.data) for array in (*arrays, ends)]
    reduce = load_library().perilune_reduce
    reduce(ctypes.c_int64(rule.kind), *addresses, ctypes.c_int64(ends.size), ctypes.c_void_p(reduced.ctypes.data))
    return reduced


def largest(times: np.ndarray, values: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """Return the largest value of each simulation (flights,); 0 for a simulation without rows."""
    return np.nan_to_num(reduce_rows(ReductionRule(MAX, EVER, EVER, 0.0), times, values, values, ends))
