"""The dipole by Basilisk."""

import numpy as np
from Basilisk.simulation import magneticFieldCenteredDipole

from crosscheck.models.centred_dipole.case import POINTS
from crosscheck.space.basilisk_bench import craft_state, planet_state, update_once
from crosscheck.table import Table, rows_table


def fly(given: dict) -> Table:
    """Return the flux density (T) at each point; the planet's axes are the inertial ones."""
    field = magneticFieldCenteredDipole.MagneticFieldCenteredDipole()
    field.g10, field.g11, field.h11, field.planetRadius = (given[name] for name in ("g10", "g11", "h11", "radius"))
    planet, crafts = planet_state(), [craft_state(r) for r in POINTS]
    field.planetPosInMsg.subscribeTo(planet)
    for craft in crafts:
        field.addSpacecraftToModel(craft)
    update_once(field)
    return rows_table(field=np.array([message.read().magField_N for message in field.envOutMsgs]))
