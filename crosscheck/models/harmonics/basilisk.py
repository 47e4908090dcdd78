"""Gravity by Basilisk's spherical harmonics."""

import numpy as np

from crosscheck.basilisk_side import column
from crosscheck.models.harmonics.case import DEGREE, POINTS
from crosscheck.space.basilisk_surroundings import harmonics
from crosscheck.table import Table, rows_table


def fly(given: dict) -> Table:
    """Return gravity (m/s2) at each point, planet-fixed."""
    model = harmonics(given["normalised"], given["mu"], given["radius"], DEGREE)
    model.initializeParameters()
    return rows_table(gravity=np.array([np.array(model.computeField(column(r))).flatten() for r in POINTS]))
