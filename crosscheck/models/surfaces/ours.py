"""Drag and solar pressure by `mathlib.space.surfaces`."""

import numpy as np

from crosscheck.models.surfaces.case import ATTITUDES, DENSITY, PLATES, SOLAR_CONSTANT, SUN, VELOCITY
from crosscheck.table import Table, rows_table
from perilune.fmus_src.kernel.matrices import Matrix
from perilune.fmus_src.mathlib.attitude.quaternion import to_body
from perilune.fmus_src.mathlib.space import surfaces
from perilune.fmus_src.mathlib.vectors import vector

LIGHT_SPEED = 299792458.0  # m/s


def evaluate() -> Table:
    """Return forces (N) and torques (N m) at each attitude, body; pressure as with Basilisk's solar constant."""
    plates = Matrix([list(row) for row in PLATES])
    distance = float(np.linalg.norm(SUN))
    pressure = surfaces.pressure_at(distance, 1.0) * SOLAR_CONSTANT / (surfaces.SOLAR_PRESSURE * LIGHT_SPEED)
    loads = []
    for q in ATTITUDES:
        attitude = vector(*q)
        drag = surfaces.plate_drag(plates, DENSITY, to_body(attitude, vector(*VELOCITY)))
        solar = surfaces.plate_pressure(plates, pressure, to_body(attitude, vector(*(SUN / distance))))
        loads.append([each.elements() for each in (drag.force, drag.torque, solar.force, solar.torque)])
    drag_force, drag_torque, force, torque = np.array(loads).transpose(1, 0, 2)
    return rows_table(drag=drag_force, drag_torque=drag_torque, pressure=force, pressure_torque=torque)
