"""Drag and solar pressure by `mathlib.space.surfaces`."""

import numpy as np

from crosscheck.models.sphere.case import (
    AREA,
    ASTRONOMICAL_UNIT,
    DENSITY,
    DRAG,
    REFLECTIVITY,
    SUNS,
    VELOCITIES,
)
from crosscheck.table import Table, rows_table
from perilune.fmus_src.mathlib.space import ephemerides, surfaces
from perilune.fmus_src.mathlib.vectors import vector


def evaluate() -> Table:
    """Return the forces (N), inertial; pressure as with Basilisk's astronomical unit."""
    stronger = (ASTRONOMICAL_UNIT / ephemerides.ASTRONOMICAL_UNIT) ** 2
    drag, pressure = [], []
    for velocity, sun in zip(VELOCITIES, SUNS, strict=True):
        distance = float(np.linalg.norm(sun))
        strength = stronger * surfaces.pressure_at(distance, 1.0)
        drag.append(surfaces.sphere_drag(AREA, DRAG, DENSITY, vector(*velocity)).elements())
        pressure.append(surfaces.sphere_pressure(AREA, REFLECTIVITY, strength, vector(*(sun / distance))).elements())
    return rows_table(drag=np.array(drag), pressure=np.array(pressure))
