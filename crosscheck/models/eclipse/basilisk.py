"""Light by Basilisk."""

import numpy as np
from Basilisk.simulation import eclipse

from crosscheck.models.eclipse.case import POINTS, SUN
from crosscheck.space.basilisk_bench import craft_state, planet_state, update_once
from crosscheck.table import Table, rows_table


def fly() -> Table:
    """Return the visible share of the Sun's disk at each point."""
    model = eclipse.Eclipse()
    sun, earth, crafts = planet_state(SUN, "sun"), planet_state(), [craft_state(r) for r in POINTS]
    model.sunInMsg.subscribeTo(sun)
    model.addPlanetToModel(earth)
    for craft in crafts:
        model.addSpacecraftToModel(craft)
    update_once(model)
    return rows_table(light=np.array([[message.read().shadowFactor] for message in model.eclipseOutMsgs]))
