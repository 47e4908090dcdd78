"""The magnetometer's samples by Basilisk."""

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import magnetometer

from crosscheck.basilisk_side import column
from crosscheck.models.magnetometer.case import BIAS, FIELDS, PITCH, RANGE, ROLL, SCALE, YAW
from crosscheck.space.basilisk_bench import craft_state, update_once
from crosscheck.table import Table, rows_table


def fly() -> Table:
    """Return a sample (T) of each field; body axes are the inertial ones."""
    return rows_table(field=np.array([_sample(field) for field in FIELDS]))


def _sample(field: np.ndarray) -> list[float]:
    sensor = magnetometer.Magnetometer()
    sensor.setBodyToSensorDCM(YAW, PITCH, ROLL)
    sensor.senBias, sensor.scaleFactor = column(BIAS), SCALE
    sensor.maxOutput, sensor.minOutput = RANGE, -RANGE
    craft = craft_state()
    around = messaging.MagneticFieldMsg().write(messaging.MagneticFieldMsgPayload(magField_N=field.tolist()))
    sensor.stateInMsg.subscribeTo(craft)
    sensor.magInMsg.subscribeTo(around)
    update_once(sensor)
    return sensor.tamDataOutMsg.read().tam_S
