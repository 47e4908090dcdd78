"""Duration of least propellant of a point-mass problem: a bracket from coarse solutions, and a search within it."""

from __future__ import annotations

import numpy as np
from scipy.optimize import minimize_scalar

from .convex_form import PointMassPath, solve_fixed_time
from .path import PlanError
from .point_mass import PointMassProblem

BOUND_INTERVALS = 240  # default intervals of a bound
COARSE = 40  # intervals of the bracket's coarse solutions
GROWTH = 1.3  # factor between its durations
FIRST, LAST = -8, 11  # times from 1/8 to 18 times the natural one
ACCURACY = 1e-2  # s; the propellant is flat there


def least_propellant(problem: PointMassProblem, intervals: int, accuracy: float = ACCURACY) -> PointMassPath:
    """Return the path of least propellant over all durations, searched to an ``accuracy`` (s). Raises `PlanError`."""
    first, last = _bracket(problem)

    paths: dict[float, PointMassPath] = {}

    def propellant(duration: float) -> float:
        nearest = min(paths, key=lambda other: abs(other - duration), default=None)
        path = solve_fixed_time(problem, duration, intervals, None if nearest is None else paths[nearest])
        if path is None:
            return 1.0
        paths[duration] = path
        return path.propellant_fraction

    best = minimize_scalar(propellant, bounds=(first, last), method="bounded", options={"xatol": accuracy})
    if best.x not in paths:
        raise PlanError(
            f"bound: the optimisation found no solution with {intervals} intervals and a duration near {best.x:.2f} s"
        )
    return paths[best.x]


def _bracket(problem: PointMassProblem) -> tuple[float, float]:
    """Return durations (s) below and above the best duration, from coarse solutions at increasing durations."""
    times = problem.natural_time * GROWTH ** np.arange(FIRST, LAST + 1)
    best, minimum = None, 1.0
    for index, time in enumerate(times):
        path = solve_fixed_time(problem, float(time), COARSE)
        fraction = 1.0 if path is None else path.propellant_fraction
        if fraction < minimum:
            best, minimum = index, fraction
        elif best is not None:
            return float(times[max(0, best - 1)]), float(time)
    raise PlanError(
        f"bound: the vehicle cannot reach the target within any duration from {times[0]:.3g} s to {times[-1]:.3g} s"
    )
