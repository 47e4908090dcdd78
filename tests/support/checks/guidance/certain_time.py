"""Time to go of the guidances with a solution for every start, from polynomials by numpy.

Adopted from the block: conditions of the change from least effort to braking, and of the end.
"""

import numpy as np
from numpy.polynomial import Polynomial

from tests.support.checks.guidance.terminal import STEP
from tests.support.flights.linear_thrust import (
    balance_polynomial,
    balance_roots,
    impulse_and_miss,
    polynomials,
    positive_roots,
)

AGREEMENT, ENDING, CHASE = 0.05, 5.0, 1.5


def effort_slope(position, velocity):
    """Return T^4 times the derivative by T of the integral of |a0 + a1 t|^2, which is N/T^3 with a polynomial N."""
    effort = Polynomial([0.0])
    for impulse, miss in zip(*polynomials(position, velocity), strict=True):
        p, q = impulse - 3.0 * miss, impulse - 2.0 * miss
        effort = effort + 4.0 * p * p - 12.0 * p * q + 12.0 * q * q
    return effort.deriv() * Polynomial([0.0, 1.0]) - 3.0 * effort


def effort_times(position, velocity):
    """Return times of least effort, the first of which counts."""
    slope = effort_slope(position, velocity)
    if not slope.coef[:3].any():
        return []
    return [root for root in positive_roots(slope, 4) if slope.deriv()(root) > 0.0]


def certain_time(position, velocity, memory):
    """Return time-to-go (s), 0 where it is up, and True if it is that of least effort."""
    balance = balance_polynomial(position, velocity, 3)
    falling = (
        [] if balance.coef[0] == 0.0 else [T for T in balance_roots(position, velocity, 3) if balance.deriv()(T) < 0.0]
    )
    time = falling[0] if falling else 0.0
    started, before = "left" in memory, memory.get("effort", True)
    effort = False
    if not started or before or time == 0.0:
        shortest = (effort_times(position, velocity) or [0.0])[0]
        suits = time > 0.0 and np.dot(*impulse_and_miss(position, velocity, time)) > 0.0
        brakes = suits and effort_slope(position, velocity)(time) <= 0.0
        close = abs(time - shortest) < AGREEMENT * shortest
        memory["braking"] = memory.get("braking", False) or (suits and close) if started else brakes
        effort = not (memory["braking"] and suits and (brakes or close))
        if effort:
            expected = memory.get("left", np.inf) - STEP
            time = 0.0 if expected < ENDING and shortest > CHASE * expected else shortest
    memory["effort"] = effort
    if started or time > 0.0:
        memory["left"] = time
    return time, effort


def mean_size(a0, a1, time, last_burn):
    """Return |a0 + a1 t| of the mean over the burn of a command."""
    return np.linalg.norm(a0 + 0.5 * (time if time <= last_burn else STEP) * a1)


def turning(a0, a1):
    """Return the direction of a0 + a1 t at t = 0, and its derivative."""
    size = np.linalg.norm(a0)
    direction = a0 / size
    return direction, (a1 - (a1 @ direction) * direction) / size
