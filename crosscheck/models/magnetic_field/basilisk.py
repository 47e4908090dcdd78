"""Magnetic field by Basilisk's World Magnetic Model with coefficients of the IGRF."""

import tempfile
from pathlib import Path

import numpy as np

from crosscheck.models.magnetic_field.case import POINTS
from crosscheck.space.basilisk_bench import craft_state, planet_state, update_once
from crosscheck.space.basilisk_field import world_field
from crosscheck.table import Table, rows_table


def fly(given: dict) -> Table:
    """Return the flux density (T) at each point; the planet's axes are the inertial ones."""
    planet, crafts = planet_state(), [craft_state(r) for r in POINTS]
    with tempfile.TemporaryDirectory() as folder:
        field = world_field(given["schmidt"], Path(folder) / "field.COF")
        field.planetPosInMsg.subscribeTo(planet)
        for craft in crafts:
            field.addSpacecraftToModel(craft)
        update_once(field)
    return rows_table(field=np.array([message.read().magField_N for message in field.envOutMsgs]))
