"""Drag and solar pressure by Basilisk, on a craft so heavy that a step changes neither velocity nor attitude."""

import numpy as np
from Basilisk.architecture import messaging

from crosscheck.basilisk_side import Flight, to_mrp
from crosscheck.models.surfaces.case import ATTITUDES, DENSITY, PLATES, SUN, VELOCITY
from crosscheck.space.basilisk_bench import planet_state
from crosscheck.space.basilisk_effectors import drag_plates, sunlit_plates
from crosscheck.table import Table, rows_table

HEAVY, STEP = 1e12, 1e-8  # kg and kg m2; s


def fly() -> Table:
    """Return forces (N) and torques (N m) at each attitude, body."""
    drag_force, drag_torque, force, torque = np.array([_loads(q) for q in ATTITUDES]).transpose(1, 0, 2)
    return rows_table(drag=drag_force, drag_torque=drag_torque, pressure=force, pressure_torque=torque)


def _loads(quaternion: np.ndarray) -> list[np.ndarray]:
    flight = Flight(STEP)
    flight.set_inertia((HEAVY * np.eye(3)).tolist(), HEAVY)
    flight.start((0.0, 0.0, 0.0), VELOCITY, to_mrp(quaternion))
    drag, light = drag_plates(PLATES), sunlit_plates(PLATES)
    air = messaging.AtmoPropsMsg().write(messaging.AtmoPropsMsgPayload(neutralDensity=DENSITY))
    sun = planet_state(SUN, "sun")
    drag.atmoDensInMsg.subscribeTo(air)
    light.sunInMsg.subscribeTo(sun)
    for effector in (drag, light):
        flight.craft.addDynamicEffector(effector)
        flight.add(effector, priority=2)
    flight.run(STEP)
    return [
        np.array(each).flatten()
        for each in (
            drag.forceExternal_B,
            drag.torqueExternalPntB_B,
            light.forceExternal_B,
            light.torqueExternalPntB_B,
        )
    ]
