"""The heads' currents by Basilisk."""

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import coarseSunSensor

from crosscheck.basilisk_side import column
from crosscheck.models.sun_heads.case import (
    ATTITUDES,
    DISTANCE,
    FIELD_OF_VIEW,
    LIGHT,
    NORMALS,
    SUN_DIRECTION,
)
from crosscheck.space.basilisk_bench import craft_state, planet_state, update_once
from crosscheck.table import Table, rows_table


def fly() -> Table:
    """Return the currents, of full scale, at each attitude."""
    return rows_table(currents=np.array([_currents(*each) for each in zip(ATTITUDES, LIGHT, strict=True)]))


def _currents(quaternion: np.ndarray, light: float) -> list[float]:
    sun, craft = planet_state(DISTANCE * SUN_DIRECTION, "sun"), craft_state(quaternion=quaternion)
    shadow = messaging.EclipseMsg().write(messaging.EclipseMsgPayload(shadowFactor=light))
    heads = []
    for normal in NORMALS:
        head = coarseSunSensor.CoarseSunSensor()
        head.nHat_B, head.fov = column(normal), FIELD_OF_VIEW
        head.sunInMsg.subscribeTo(sun)
        head.stateInMsg.subscribeTo(craft)
        head.sunEclipseInMsg.subscribeTo(shadow)
        heads.append(head)
    update_once(*heads)
    return [head.sensedValue for head in heads]
