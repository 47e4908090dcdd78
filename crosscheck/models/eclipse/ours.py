"""Light by `mathlib.space.eclipse`."""

import numpy as np

from crosscheck.models.eclipse.case import EARTH_RADIUS, POINTS, SUN, SUN_RADIUS
from crosscheck.table import Table, rows_table
from perilune.fmus_src.mathlib.space import ephemerides
from perilune.fmus_src.mathlib.space.eclipse import illumination
from perilune.fmus_src.mathlib.vectors import vector


def evaluate() -> Table:
    """Return the visible share of the Sun's disk at each point.

    The kernel's Sun is larger than Basilisk's: farther away by as much it has the same disk from each point.
    """
    farther = ephemerides.SUN_RADIUS / SUN_RADIUS
    return rows_table(light=np.array([[light(r, r + farther * (SUN - r))] for r in POINTS]))


def light(position: np.ndarray, sun: np.ndarray) -> float:
    """Return the visible share at a position (m) with the Sun at another (m)."""
    return illumination(vector(*position), vector(*sun), EARTH_RADIUS)
