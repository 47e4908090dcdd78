"""Vehicle of the check and the margins of its plans, agile for short trajectories."""

import numpy as np

from tests.support.checks.navigation.lunar_flight import CENTRE, gravity
from tests.support.checks.vectors import unit

IMPULSE = 300.0  # s
EXHAUST = IMPULSE * 9.80665  # m/s
MAXIMUM, MINIMUM, LAG = 3300.0, 900.0, 0.4  # N, N, s
PLANNED_MAXIMUM, PLANNED_MINIMUM = 0.9, 0.32  # of MAXIMUM
SWING = 0.2  # rad/s2
SLOW = 1.0, 0.3  # m/s, m/s2
STANDBY = 60.0, 0.5  # of transfers where there is no programme


def weight(position):
    """Return size of gravity (m/s2)."""
    return float(np.linalg.norm(gravity(position)))


def vertical(position):
    return unit(position - CENTRE)
