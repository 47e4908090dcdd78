"""Transfers of degree 7: scipy's polynomial, which the derivatives at both ends determine.

Adopted from the block: propellant of a transfer by the trapezoidal rule with 41 samples, thrust of a cycle by Simpson's
rule, the durations tried in a capture, and the penalty for exceeded limits.
"""

import numpy as np
from scipy.integrate import cumulative_trapezoid, simpson
from scipy.interpolate import BPoly

from tests.support.checks.guidance.hover.vehicle import EXHAUST, MAXIMUM, PLANNED_MAXIMUM, PLANNED_MINIMUM, SWING
from tests.support.checks.vectors import unit


def product(a, b):
    """Return scalar products of rows, in a column."""
    return np.sum(a * b, axis=-1, keepdims=True)


class Transfer:
    """From position, velocity, acceleration and jerk to rest at ``goal``, against ``lift`` (m/s2), its weight."""

    def __init__(self, start, goal, duration, lift):
        ends = [list(start), [goal, np.zeros(3), np.zeros(3), np.zeros(3)]]
        self.position = BPoly.from_derivatives([0.0, duration], ends)
        self.velocity, self.acceleration, self.jerk, self.snap = (self.position.derivative(n) for n in (1, 2, 3, 4))
        self.duration, self.lift = duration, lift

    def motion(self, t):
        """Return position (m) and velocity (m/s)."""
        return self.position(t), self.velocity(t)

    def thrust(self, t):
        """Return thrust over mass (m/s2)."""
        return self.acceleration(t) + self.lift

    def direction(self, t):
        """Return the thrust axis and its derivative (1/s)."""
        f, axis = self.thrust(t), unit(self.thrust(t))
        return axis, (np.eye(3) - np.outer(axis, axis)) @ self.jerk(t) / np.linalg.norm(f)

    def impulse(self, begin, end):
        """Return thrust over mass, integrated (m/s)."""
        t = np.linspace(begin, end, 3)
        return simpson(np.linalg.norm(self.thrust(t), axis=1), x=t)

    def expense(self, mass):
        """Return thrust over mass, integrated (m/s), and the largest relative excess over a limit."""
        t = np.linspace(0.0, self.duration, 41)
        f, jerk = self.thrust(t), self.jerk(t)
        square = product(f, f)
        size = np.sqrt(square[:, 0])
        spent = cumulative_trapezoid(size, t, initial=0.0)
        force = mass * np.exp(-spent / EXHAUST) * size / MAXIMUM
        # the derivative of f x f'/|f|^2
        swing = np.cross(f, self.snap(t)) / square - 2.0 * product(f, jerk) / square**2 * np.cross(f, jerk)
        excesses = force / PLANNED_MAXIMUM, 2.0 - force / PLANNED_MINIMUM, np.linalg.norm(swing, axis=1)[1:] / SWING
        return spent[-1], max(0.0, *(values.max() - 1.0 for values in excesses))


def slow_transfer(start, goal, up, lift, limits):
    """Return a transfer from rest to rest within a speed (m/s) and an acceleration (m/s2), those of 140 s^3 (1 -
    s)^3."""
    speed, acceleration = limits
    height = (goal - start) @ up
    longer = max(abs(height), np.linalg.norm(goal - start - height * up))
    duration = max(2.1875 * longer / speed, np.sqrt(7.5132 * longer / acceleration), 10.0)
    return Transfer([start, np.zeros(3), np.zeros(3), np.zeros(3)], goal, duration, lift)


def capture(start, goal, lift, mass):
    """Return the cheapest of 150 durations."""
    transfers = [Transfer(start, goal, duration, lift) for duration in 8.0 * 1.02 ** np.arange(150)]
    prices = [np.dot([1.0, 1000.0], transfer.expense(mass)) for transfer in transfers]
    return transfers[int(np.argmin(prices))]
