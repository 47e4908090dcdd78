"""Drag and solar pressure by Basilisk, on a craft so heavy that a step does not change its velocity."""

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import dragDynamicEffector, radiationPressure

from crosscheck.basilisk_side import Flight
from crosscheck.models.sphere.case import AREA, DENSITY, DRAG, REFLECTIVITY, SUNS, VELOCITIES
from crosscheck.space.basilisk_bench import planet_state
from crosscheck.table import Table, rows_table

HEAVY, STEP = 1e12, 1e-8  # kg, s


def fly() -> Table:
    """Return the forces (N); body axes are the inertial ones."""
    forces = [_forces(velocity, sun) for velocity, sun in zip(VELOCITIES, SUNS, strict=True)]
    drag, pressure = np.array(forces).transpose(1, 0, 2)
    return rows_table(drag=drag, pressure=pressure)


def _forces(velocity: np.ndarray, sun: np.ndarray) -> list[np.ndarray]:
    flight = Flight(STEP)
    flight.set_inertia((HEAVY * np.eye(3)).tolist(), HEAVY)
    flight.start((0.0, 0.0, 0.0), velocity)
    drag, light = dragDynamicEffector.DragDynamicEffector(), radiationPressure.RadiationPressure()
    drag.coreParams.projectedArea, drag.coreParams.dragCoeff = AREA, DRAG
    light.area, light.coefficientReflection = AREA, REFLECTIVITY
    air = messaging.AtmoPropsMsg().write(messaging.AtmoPropsMsgPayload(neutralDensity=DENSITY))
    star = planet_state(sun, "sun")
    drag.atmoDensInMsg.subscribeTo(air)
    light.sunEphmInMsg.subscribeTo(star)
    for effector in (drag, light):
        flight.craft.addDynamicEffector(effector)
        flight.add(effector, priority=2)
    flight.run(STEP)
    return [
        np.array(each.forceExternal_N).flatten() + np.array(each.forceExternal_B).flatten() for each in (drag, light)
    ]
