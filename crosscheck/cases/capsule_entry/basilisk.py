"""The entry in Basilisk: drag in an exponential atmosphere that rotates with the Earth."""

import math

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import dragDynamicEffector, exponentialAtmosphere, zeroWindModel

from crosscheck.basilisk_side import Flight, column, to_mrp
from crosscheck.cases.capsule_entry.case import (
    ANGULAR_VELOCITY,
    AREA,
    ARM,
    ATTITUDE_ANGLES,
    CASE,
    DENSITIES,
    DENSITY_FACTOR,
    DRAG_COEFFICIENT,
    EARTH_RADIUS,
    EARTH_RATE,
    FLIGHT_PATH_ANGLE,
    HEADING,
    HEIGHT,
    HEIGHTS,
    INERTIA,
    LATITUDE,
    LONGITUDE,
    MASS,
    MU,
    SPEED,
)
from crosscheck.cases.capsule_entry.frames import to_inertial
from crosscheck.space.basilisk_ahead import Ahead
from crosscheck.table import Table

SCALE_HEIGHT = (HEIGHTS[1] - HEIGHTS[0]) / math.log(DENSITIES[0] / DENSITIES[1])  # m


def fly(step: float) -> Table:
    """Simulate: the craft is updated first, then the air of its next step, then the drag's."""
    flight = Flight(step)
    flight.attract(MU)
    flight.set_inertia([list(row) for row in INERTIA], MASS)
    start = ((EARTH_RADIUS + HEIGHT, LONGITUDE, LATITUDE), (SPEED, FLIGHT_PATH_ANGLE, HEADING), ATTITUDE_ANGLES)
    position, velocity, quaternion = to_inertial(np.zeros(1), *(np.array(column(each)) for each in start))
    flight.start(position[:, 0], velocity[:, 0], to_mrp(quaternion[:, 0]), ANGULAR_VELOCITY)
    ahead = Ahead(flight.craft, step, MU)
    flight.add(ahead, priority=0)
    air = exponentialAtmosphere.ExponentialAtmosphere()
    air.planetRadius, air.scaleHeight = EARTH_RADIUS, SCALE_HEIGHT
    air.baseDensity = DENSITY_FACTOR * DENSITIES[0] * math.exp(HEIGHTS[0] / SCALE_HEIGHT)
    air.addSpacecraftToModel(ahead.states)
    flight.add(air)
    wind = zeroWindModel.ZeroWindModel()
    earth = messaging.SpicePlanetStateMsg().write(messaging.SpicePlanetStateMsgPayload())
    wind.planetPosInMsg.subscribeTo(earth)
    wind.setPlanetOmega_N(column((0.0, 0.0, EARTH_RATE)))
    wind.addSpacecraftToModel(ahead.states)
    flight.add(wind)
    drag = dragDynamicEffector.DragDynamicEffector()
    drag.coreParams.projectedArea, drag.coreParams.dragCoeff = AREA, DRAG_COEFFICIENT
    drag.coreParams.comOffset = column(ARM)
    drag.atmoDensInMsg.subscribeTo(air.envOutMsgs[0])
    drag.windVelInMsg.subscribeTo(wind.envOutMsgs[0])
    flight.craft.addDynamicEffector(drag)
    flight.add(drag, priority=-2)
    flight.run(CASE.duration)
    return flight.table()
