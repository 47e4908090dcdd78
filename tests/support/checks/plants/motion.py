"""Integration by DOP853, shared by truths of plants."""

import numpy as np
from scipy.integrate import solve_ivp

from tests.support.checks.check import STEP

STANDARD_GRAVITY = 9.80665
UP = np.array([0.0, 0.0, 1.0])


def integrate(slope, start, end, y, rtol=1e-13, atol=1e-10):
    """Return the state at ``end`` by DOP853."""
    return solve_ivp(slope, (start, end), y, method="DOP853", rtol=rtol, atol=atol).y[:, -1]


def fly(rates_of, start, rows, **tolerances):
    """Return the state at every row; ``rates_of``: row -> y' as a function of time and state
    while its inputs are held."""
    states = [np.asarray(start, dtype=float)]
    for row in range(rows - 1):
        states.append(integrate(rates_of(row), STEP * row, STEP * (row + 1), states[-1], **tolerances))
    return np.array(states)
