"""Bounds on the propellant of many independent descents, computed in parallel processes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from functools import partial

from ....common.family.pools import process_pool
from .least_time import least_propellant
from .path import PlanError
from .point_mass import PointMassProblem
from .solvers import clarabel

INTERVALS = 80  # default number of intervals of each descent
ACCURACY = 0.1  # s, accuracy of the duration

Bounded = tuple[float, float]


def bound_descent(intervals: int, problem: PointMassProblem) -> Bounded:
    """Return the least propellant as a fraction of the initial mass, and the duration (s); nan if no descent exists."""
    try:
        path = least_propellant(problem, intervals, ACCURACY)
    except PlanError:
        return math.nan, math.nan
    return path.propellant_fraction, float(path.time[-1])


def bound_descents(problems: Sequence[PointMassProblem], intervals: int, workers: int) -> Iterator[Bounded]:
    """Yield `bound_descent` of each problem, in order. Raises InputError for a missing solver."""
    clarabel()
    solve = partial(bound_descent, intervals)
    if workers == 1:
        yield from map(solve, problems)
        return
    with process_pool(min(workers, len(problems)), clarabel) as pool:
        bounds: Iterable[Bounded] = pool.map(solve, problems)
        yield from bounds
