"""The flight in Basilisk."""

import math

import numpy as np
from Basilisk.simulation import exponentialAtmosphere, zeroWindModel

from crosscheck.basilisk_side import column
from crosscheck.cases.leo_plates import case
from crosscheck.cases.leo_plates.case import CASE, DENSITY, HEIGHT, PLATES, RADIUS, SCALE_HEIGHT
from crosscheck.space.basilisk_ahead import Ahead
from crosscheck.space.basilisk_bench import planet_state
from crosscheck.space.basilisk_effectors import begin_in_gradient, drag_plates, sunlit_plates
from crosscheck.space.basilisk_surroundings import Surroundings
from crosscheck.table import Table


def fly(step: float, given: dict) -> Table:
    """Simulate: the craft is updated first, then the air of its next step and the Sun."""
    flight = begin_in_gradient(case, step)
    ahead, surroundings = Ahead(flight.craft, step, case.MU), Surroundings(given, step)
    flight.add(ahead, priority=0)
    flight.add(surroundings, priority=0)
    air = exponentialAtmosphere.ExponentialAtmosphere()
    air.planetRadius, air.scaleHeight = RADIUS, SCALE_HEIGHT
    air.baseDensity = DENSITY * math.exp(HEIGHT / SCALE_HEIGHT)
    wind = zeroWindModel.ZeroWindModel()
    earth = planet_state()
    wind.planetPosInMsg.subscribeTo(earth)
    axes, rates = (np.array(given[name][0]) for name in ("axes", "axes_rate"))
    wind.setPlanetOmega_N(column((rates[0] @ axes[1]) * axes[2]))  # the meridian moves east at the Earth's rate
    drag, light = drag_plates(PLATES), sunlit_plates(PLATES)
    for model in (air, wind):
        model.addSpacecraftToModel(ahead.states)
        flight.add(model)
    drag.atmoDensInMsg.subscribeTo(air.envOutMsgs[0])
    drag.windVelInMsg.subscribeTo(wind.envOutMsgs[0])
    light.sunInMsg.subscribeTo(surroundings.messages["sun"])
    for effector in (drag, light):
        flight.craft.addDynamicEffector(effector)
        flight.add(effector, priority=-2)
    flight.run(CASE.duration)
    return flight.table()
