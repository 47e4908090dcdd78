"""Magnetic field by `mathlib.space.magnetic_field`."""

import numpy as np

from crosscheck.models.magnetic_field.case import DEGREE, POINTS
from crosscheck.table import Table, rows_table
from perilune.fmus_src.mathlib.space import magnetic_field
from perilune.fmus_src.mathlib.vectors import vector


def handed_over() -> dict:
    """Return Schmidt's coefficients g, h (nT) of orders 0 to n for each degree n from 1 on, at 2025.0."""
    return {"schmidt": list(magnetic_field.FIELD)}


def evaluate() -> Table:
    """Return the flux density (T) at each point, planet-fixed."""
    cs = magnetic_field.igrf14(magnetic_field.START)
    fields = [magnetic_field.magnetic_field(vector(*r), cs, DEGREE).elements() for r in POINTS]
    return rows_table(field=np.array(fields))
