"""The gyros' samples by Basilisk."""

import numpy as np
from Basilisk.simulation import imuSensor

from crosscheck.basilisk_side import column
from crosscheck.models.gyros.case import BIAS, PITCH, RANGE, RATES, ROLL, SCALE, YAW
from crosscheck.space.basilisk_bench import craft_state, update_once
from crosscheck.table import Table, rows_table


def fly() -> Table:
    """Return a sample (rad/s) of each rate, the second one: the first is 0 in Basilisk."""
    return rows_table(rate=np.array([_sample(rate) for rate in RATES]))


def _sample(rate: np.ndarray) -> list[float]:
    sensor = imuSensor.ImuSensor()
    sensor.setBodyToPlatformDCM(YAW, PITCH, ROLL)
    sensor.senRotBias, sensor.gyroScale = column(BIAS), column(SCALE)
    sensor.senRotMax = RANGE
    craft = craft_state(rate=rate)
    sensor.scStateInMsg.subscribeTo(craft)
    update_once(sensor, until=1.0)
    return sensor.sensorOutMsg.read().AngVelPlatform
