"""Constant thrust with a direction linear in time that meets a position and velocity, independent of the blocks.

The solution is to second order in the turning rate, as in powered explicit guidance: moments of the thrust acceleration
by Gauss-Legendre quadrature, and the conditions solved by scipy.
"""

import numpy as np
from scipy.optimize import root

from tests.support.descent.polynomial_laws import EXHAUST, UP, central

MASS = 940.0
POINTS, WEIGHTS = np.polynomial.legendre.leggauss(60)


def moments(thrust, time, mass=MASS):
    """Integrate a = F/(m - F t/v_e): L, J of a t, H of a t^2; S, Q, P of (T - t) a, (T - t) a t, (T - t) a t^2."""
    t, weight = 0.5 * time * (POINTS + 1.0), 0.5 * time * WEIGHTS
    acceleration = weight * thrust / (mass - thrust * t / EXHAUST)
    left = (time - t) * acceleration
    return {
        "L": acceleration.sum(),
        "J": (acceleration * t).sum(),
        "H": (acceleration * t * t).sum(),
        "S": left.sum(),
        "Q": (left * t).sum(),
        "P": (left * t * t).sum(),
    }


def solve(leg, time, mass=MASS):
    """Solve for time (s), thrust (N), its centre (s), direction then, and turning (1/s);
    ``time`` is the start of the search."""
    position, velocity = np.asarray(leg.position), np.asarray(leg.velocity)

    def gains(t):
        here = there = -leg.gravity * UP
        if leg.round_moon:
            here, there = central(position), central(leg.target)
        return leg.target - position - t * t * (here / 3.0 + there / 6.0), -velocity - 0.5 * t * (here + there)

    def steering(t, thrust):
        way, gain = gains(t)
        direction = gain / np.linalg.norm(gain)
        m = moments(thrust, t, mass)
        centre = m["J"] / m["L"]
        offset = way - t * velocity
        turning = (offset - (offset @ direction) * direction) / (m["Q"] - m["S"] * centre)
        return m, centre, offset, direction, turning

    def conditions(unknown):
        t, thrust = unknown[0] * time, unknown[1] * 4.5 * mass
        m, centre, offset, direction, turning = steering(t, thrust)
        half = 0.5 * turning @ turning
        _, gain = gains(t)
        # the cosine of the angle to the direction at the centre is 1 - half (t - K)^2
        speed = m["L"] - half * (m["H"] - m["J"] * centre) - np.linalg.norm(gain)
        range_error = m["S"] - half * (m["P"] - 2.0 * m["Q"] * centre + m["S"] * centre**2) - offset @ direction
        return [speed / 100.0, range_error / 1e4]

    solution = root(conditions, [1.0, 1.0], tol=1e-13)
    assert solution.success or np.max(np.abs(solution.fun)) < 1e-10
    t, thrust = solution.x[0] * time, solution.x[1] * 4.5 * mass
    _, centre, _, direction, turning = steering(t, thrust)
    return t, thrust, centre, direction, turning
