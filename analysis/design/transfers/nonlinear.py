"""Minimisation of smooth functions of a few variables under equality constraints, by SQP.

Source: Kraft 1988, SLSQP, in scipy.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from scipy.optimize import minimize

SETTLED = 1e-8  # tolerance of each scaled condition
PRECISION = 1e-10  # change of the function between two iterations
ITERATIONS = 500

Function = Callable[[np.ndarray], float]
Conditions = Callable[[np.ndarray], np.ndarray]


def minimise(
    cost: Function, conditions: Conditions, guess: Sequence[float], lowest: Sequence[float]
) -> np.ndarray | None:
    """Return the point near a guess that minimises ``cost`` where all ``conditions`` are 0, None if none is found.

    ``cost`` and ``conditions`` are of the order of 1 to 100; ``lowest`` contains lower bounds, -inf for none.
    """
    solution = minimize(
        cost,
        np.asarray(guess, dtype=float),
        method="SLSQP",
        bounds=[(low, None) for low in lowest],
        constraints=[{"type": "eq", "fun": conditions}],
        options={"ftol": PRECISION, "maxiter": ITERATIONS},
    )
    point = np.asarray(solution.x)
    reached = bool(np.all(np.isfinite(point))) and float(np.abs(conditions(point)).max()) <= SETTLED
    return point if solution.success and reached else None
