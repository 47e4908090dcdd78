"""The dipole by `mathlib.space.magnetic_field`, to degree 1."""

import numpy as np

from crosscheck.models.centred_dipole.case import POINTS
from crosscheck.table import Table, rows_table
from perilune.fmus_src.mathlib.space import magnetic_field
from perilune.fmus_src.mathlib.vectors import vector

TESLA = 1e-9  # of a nT


def handed_over() -> dict:
    """Return the coefficients (T) of degree 1 at 2025.0, and their radius (m)."""
    g10, _, g11, h11 = magnetic_field.FIELD[:4]
    return {"g10": TESLA * g10, "g11": TESLA * g11, "h11": TESLA * h11, "radius": magnetic_field.RADIUS}


def evaluate() -> Table:
    """Return the flux density (T) at each point, planet-fixed."""
    cs = magnetic_field.igrf14(magnetic_field.START)
    return rows_table(field=np.array([magnetic_field.magnetic_field(vector(*r), cs, 1).elements() for r in POINTS]))
