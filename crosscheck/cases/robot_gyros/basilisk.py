"""The gyros' flight in Basilisk, by its variable-speed control moment gyros (VSCMG)."""

import numpy as np
from Basilisk.simulation import vscmgStateEffector

from crosscheck.basilisk_side import Flight, column, to_mrp
from crosscheck.cases.robot_gyros.basilisk_drives import ANGLES, GIMBAL_AXES, RATES, SPIN, WHEEL_SPEED, Drives
from crosscheck.cases.robot_gyros.case import (
    ANGULAR_VELOCITY,
    CASE,
    GYRO_INERTIA,
    INERTIA,
    MASS,
    QUATERNION,
    WHEEL_INERTIA,
)
from crosscheck.table import Table

GYRO_MASS = 10.0  # kg, of each, at the centre of mass
UNLIMITED = ("u_s_max", "u_s_min", "u_g_max", "u_g_min", "Omega_max", "gammaDot_max")
FRICTIONLESS = ("wheelLinearFrictionRatio", "gimbalLinearFrictionRatio")


def fly(step: float) -> Table:
    """Simulate: the hub has the mass and inertia without the gyros'."""
    flight = Flight(step)
    hub = np.diag(INERTIA) - RATES.size * GYRO_INERTIA * np.eye(3)
    flight.set_inertia(hub.tolist(), MASS - RATES.size * GYRO_MASS)
    flight.start((0.0, 0.0, 0.0), (0.0, 0.0, 0.0), to_mrp(QUATERNION), ANGULAR_VELOCITY)
    gyros = vscmgStateEffector.VSCMGStateEffector()
    for axis, angle, rate in zip(GIMBAL_AXES, ANGLES, RATES, strict=True):
        gyros.AddVSCMG(_gyro(axis, angle, rate))
    flight.craft.addStateEffector(gyros)
    drives = Drives(flight.craft, step)
    gyros.cmdsInMsg.subscribeTo(drives.commands)
    flight.add(drives, priority=0)
    flight.add(gyros)
    flight.run(CASE.duration)
    return flight.table()


def _gyro(axis: np.ndarray, angle: float, rate: float) -> object:
    """Return a balanced gyro without limits, with a gimbal axis (body), and a spin axis along x at the angle 0."""
    gyro = vscmgStateEffector.VSCMGConfigMsgPayload()
    gyro.VSCMGModel = vscmgStateEffector.vscmgBalancedWheels
    gyro.gsHat0_B, gyro.gtHat0_B, gyro.ggHat_B = column(SPIN), column(np.cross(axis, SPIN)), column(axis)
    gyro.gamma, gyro.gammaDot, gyro.Omega = angle, rate, WHEEL_SPEED
    gyro.rGB_B, gyro.rGcG_G = column((0.0, 0.0, 0.0)), column((0.0, 0.0, 0.0))
    gyro.massW, gyro.massG = 0.5 * GYRO_MASS, 0.5 * GYRO_MASS
    gyro.IW1, gyro.IW2, gyro.IW3 = WHEEL_INERTIA, 0.5 * WHEEL_INERTIA, 0.5 * WHEEL_INERTIA
    gyro.IG1, gyro.IG2, gyro.IG3 = (GYRO_INERTIA - each for each in (gyro.IW1, gyro.IW2, gyro.IW3))
    for name in (*UNLIMITED, *FRICTIONLESS):
        setattr(gyro, name, -1.0)
    return gyro
