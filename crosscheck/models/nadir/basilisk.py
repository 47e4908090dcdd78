"""The reference by Basilisk: axes of Hill, which are x outwards, z along the orbit normal."""

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.fswAlgorithms import hillPoint
from Basilisk.utilities import RigidBodyKinematics

from crosscheck.models.nadir.case import POSITIONS, VELOCITIES
from crosscheck.space.basilisk_bench import update_once
from crosscheck.table import Table, rows_table

OURS = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]])  # x along the flight, z down, by axes of Hill


def fly() -> Table:
    """Return the axes, rate (rad/s) and acceleration (rad/s2) in them, for each orbit."""
    axes, rates, accelerations = [], [], []
    for position, velocity in zip(POSITIONS, VELOCITIES, strict=True):
        reference = _reference(position, velocity)
        rows = OURS @ np.array(RigidBodyKinematics.MRP2C(reference.sigma_RN))
        axes.append(rows.ravel())
        rates.append(rows @ np.array(reference.omega_RN_N))
        accelerations.append(rows @ np.array(reference.domega_RN_N))
    return rows_table(axes=np.array(axes), rate=np.array(rates), acceleration=np.array(accelerations))


def _reference(position: np.ndarray, velocity: np.ndarray) -> object:
    guidance = hillPoint.hillPoint()
    orbit = messaging.NavTransMsg().write(
        messaging.NavTransMsgPayload(r_BN_N=position.tolist(), v_BN_N=velocity.tolist())
    )
    guidance.transNavInMsg.subscribeTo(orbit)
    update_once(guidance)
    return guidance.attRefOutMsg.read()
