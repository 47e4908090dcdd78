"""Trajectory over the Moon, shared by truths of navigation, and its dead reckoning."""

import numpy as np

from tests.support.checks.check import STEP

ROWS, SEED, STREAM, MOON_RADIUS, MU = 33, 28, 7, 1.7374e6, 4.9028e12
TIME = STEP * np.arange(ROWS)
UPPER = np.triu_indices(6)
STREAMS = {"seed": SEED, "stream": STREAM}
CENTRE = np.array([0.0, 0.0, -MOON_RADIUS])


def truth_of_flight(time=TIME):
    """Return position and velocity of a parabola."""
    velocity = np.array([-900.0, 50.0, -40.0]) + np.outer(time, [3.0, -0.5, 1.0])
    position = np.array([9.0e4, -5.0e3, 1.2e4]) + np.outer(time, [-900.0, 50.0, -40.0])
    return position + np.outer(time**2 / 2.0, [3.0, -0.5, 1.0]), velocity


def first_knowledge(numbers, position, velocity, position_sigma, velocity_sigma):
    """Return the truth with errors, drawn axis by axis."""
    errors = numbers.normal(3, 2)
    return position[0] + position_sigma * errors[:, 0], velocity[0] + velocity_sigma * errors[:, 1]


def gravity(r):
    return -MU * (r - CENTRE) / np.linalg.norm(r - CENTRE) ** 3


def dead_reckon(r, v, f, before):
    """Return position and velocity a step later, as documented, under mean specific forces f
    and, a step ago, ``before``."""
    ahead = v + STEP * (f + (gravity(r) + gravity(r + STEP * v)) / 2.0)
    return r + STEP * (v + ahead) / 2.0 - STEP**2 / 12.0 * (f - before), ahead
