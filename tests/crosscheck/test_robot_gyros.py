"""Perilune's side of the cross-check of gyros.

Truth: conservation of the angular momentum of body and gyros, from the closed form of the gimbal angles and scipy's
Rotation.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from crosscheck.case import ATTITUDE, RATE
from crosscheck.cases.robot_gyros import case
from crosscheck.cases.robot_gyros.ours import simulate


def test_angular_momentum_of_body_and_gyros_stays(fmus):
    """1e-12 of 39 N m s, while the body's changes by 25."""
    table = simulate(case.CASE.step)
    rate, quaternion = (np.stack([table[name] for name in names], axis=1) for _, names in (RATE, ATTITUDE))
    body = np.array(case.INERTIA) * rate
    a, b, c, d = np.array(case.GIMBAL_ANGLES)[:, None] + np.outer(case.GIMBAL_RATES, table["time"])
    gyros = np.array([np.cos([a, b, c, d]).sum(axis=0), np.sin(a) + np.sin(b), np.sin(c) + np.sin(d)])
    total = body + case.ROTOR_MOMENTUM * gyros.T
    inertial = Rotation.from_quat(quaternion, scalar_first=True).apply(total)
    assert np.abs(inertial - inertial[0]).max() < 1e-12 * np.linalg.norm(inertial[0])
    assert np.ptp(np.linalg.norm(body, axis=1)) > 20.0
