"""Gravity by `mathlib.space.harmonics`."""

import numpy as np

from crosscheck.models.harmonics.case import DEGREE, POINTS
from crosscheck.table import Table, rows_table
from perilune.fmus_src.mathlib.space import earth_gravity
from perilune.fmus_src.mathlib.space.harmonics import gradient
from perilune.fmus_src.mathlib.vectors import vector


def handed_over() -> dict:
    """Return the normalised coefficients from degree 2 on, as the kernel has them, with their parameter and radius."""
    return {
        "normalised": list(earth_gravity.NORMALISED),
        "mu": earth_gravity.GRAVITATIONAL_PARAMETER,
        "radius": earth_gravity.RADIUS,
    }


def evaluate() -> Table:
    """Return gravity (m/s2) at each point, planet-fixed."""
    cs = earth_gravity.earth_gravity()
    mu, radius = earth_gravity.GRAVITATIONAL_PARAMETER, earth_gravity.RADIUS
    return rows_table(gravity=np.array([gradient(vector(*r), mu, radius, cs, DEGREE).elements() for r in POINTS]))
