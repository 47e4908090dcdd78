"""Programme from hover to hover, by root finding on the paper's full equations, integrated by scipy's DOP853.

Adopted from the block: the end times tried in the search for least propellant, the best of which is used in the plan.
They are 1 s and 2.6 s after a first end time, then the points of a golden section of the larger segment of the bracket,
to 1 ms.
"""

import math

import numpy as np
from scipy.optimize import fsolve

from tests.support.flights.hover_equations import flown

UNPLANNED, VERTICAL, WITHOUT_FIRST_BURN, WITH_FIRST_BURN, POLYNOMIAL = range(5)
LATER = 0.2  # s, by which the first end is later than that of the programme without first burn
SETTLED = 1e-3  # s


def times_of(kind, free, end=None):
    """Return t2, t5, w, tp, t7 from the free ones."""
    if kind == VERTICAL:
        return 0.0, free[1], 0.0, free[0], free[1]
    if kind == WITHOUT_FIRST_BURN:
        return free[0], free[1], 0.0, free[2], free[3]
    return *free, end


def solve(kind, guess, vehicle, x, y, end=None):
    """Return times of the programme that ends at rest at (x, y) (m)."""
    conditions = [2, 3] if kind == VERTICAL else [0, 1, 2, 3]

    def miss(free):
        return (flown(times_of(kind, free, end), vehicle)[:4] - [x, 0.0, y, 0.0])[conditions]

    free = fsolve(miss, guess, xtol=1e-13, epsfcn=1e-9, factor=0.1)
    assert np.abs(miss(free)).max() < 1e-8
    return times_of(kind, free, end)


def least_propellant(without, guess, vehicle, x, y):
    """Return the programme with a first burn, ended where it takes least propellant, from the
    one without and a guess of t2 to tp."""
    solutions = {}

    def cost(end):
        near = solutions[min(solutions, key=lambda other: abs(other - end))] if solutions else (*guess, end)
        near = near[0], near[1] + end - near[4], *near[2:4]
        solutions[end] = solve(WITH_FIRST_BURN, near, vehicle, x, y, end)
        return flown(solutions[end], vehicle)[4]

    low, best, high = ends = without[4] + LATER + np.array([0.0, 1.0, 2.6])
    costs = {end: cost(end) for end in ends}
    assert costs[best] < min(costs[low], costs[high])
    while high - low > SETTLED:
        assert abs((best - low) - (high - best)) > 1e-6  # no tie
        longer = low if best - low > high - best else high
        trial = best + (1.5 - math.sqrt(1.25)) * (longer - best)
        costs[trial] = cost(trial)
        ends = sorted([low, best, high, trial])
        k = int(np.argmin([costs[end] for end in ends]))
        low, best, high = ends[k - 1 : k + 2]
    return solutions[best]


class Programme:
    """The motion of a programme in the plane of ``along`` and ``up``, from ``origin``."""

    def __init__(self, times, vehicle, origin, along, up):
        self.times, self.vehicle = times, vehicle
        self.origin, self.along, self.up = origin, along, up

    def state(self, t):
        """Return x, x', y, y', propellant fraction, pitch and its rate."""
        return flown(self.times, self.vehicle, until=t)

    def motion(self, t):
        """Return position (m) and velocity (m/s)."""
        x, vx, y, vy = self.state(t)[:4]
        return self.origin + x * self.along + y * self.up, vx * self.along + vy * self.up

    def direction(self, t):
        """Return the thrust axis and its derivative (1/s)."""
        pitch, rate = self.state(t)[5:]
        cosine, sine = math.cos(pitch), math.sin(pitch)
        return cosine * self.along + sine * self.up, rate * (cosine * self.up - sine * self.along)

    def impulse(self, begin, end):
        """Return thrust over mass, integrated (m/s): the rocket equation."""
        return -self.vehicle[2] * math.log((1.0 - self.state(end)[4]) / (1.0 - self.state(begin)[4]))
