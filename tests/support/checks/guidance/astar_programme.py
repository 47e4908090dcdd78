"""Thrust programme of method A*: lateral and vertical components linear in time, completed by the forward component.

Adopted from the method: the argument of an arcsine is limited to 1, and the cosine of the result in doubles, 6e-17,
divides the forward rate.
"""

import numpy as np
from scipy.integrate import simpson

from tests.support.checks.guidance.terminal import CLAMPED, GOOD, Solution
from tests.support.flights.linear_thrust import linear_thrust


def programme(position, velocity, time, size, cycle):
    """Return the method's thrust of ``size`` (m/s2): its y and z are those of a0 + a1 t.

    Where its angles turn by more than a radian in the ``cycle`` (s), their mean over it by Simpson's rule.
    """
    a0, a1 = linear_thrust(position, velocity, time)
    lateral = a0[1] / size
    cosine = np.cos(np.arcsin(np.clip(lateral, -1.0, 1.0)))
    vertical = a0[2] / (size * cosine)
    angles = np.arcsin(np.clip([lateral, vertical], -1.0, 1.0))
    clamps = int(abs(lateral) > 1.0) + int(abs(vertical) > 1.0)
    y, z, x = np.sin(angles[0]), np.sin(angles[1]) * cosine, np.cos(angles[1]) * cosine
    rate = np.array([-(y * a1[1] + z * a1[2]) / size / x, a1[1] / size, a1[2] / size])
    lateral_rate = rate[1] / cosine
    rates = np.array([lateral_rate, (rate[2] + lateral_rate * np.sin(angles[1]) * y) / x])
    status = CLAMPED if clamps else GOOD
    span = min(time, cycle)
    if np.abs(rates).sum() * span <= 1.0:
        return Solution(time, size, np.array([x, y, z]), rate, status, clamps)
    psi, theta = angles[:, None] + rates[:, None] * span * np.array([0.0, 0.5, 1.0])
    mean = simpson([np.cos(theta) * np.cos(psi), np.sin(psi), np.sin(theta) * np.cos(psi)], dx=0.5)
    return Solution(time, size * np.linalg.norm(mean), mean / np.linalg.norm(mean), np.zeros(3), status, clamps)
