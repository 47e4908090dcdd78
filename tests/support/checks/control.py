"""Truths of regulators of an entry capsule: their equations as matrices. Direct outputs follow one row later."""

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow

INERTIA = np.array([[1400.0, -40.0, 0.0], [-40.0, 1250.0, 0.0], [0.0, 0.0, 1200.0]])
ROWS = 33


def signals():
    """Bank, angular velocity and reference of all signs."""
    time = STEP * np.arange(ROWS)
    w = np.stack([0.1 * np.sin(2.0 * time), 0.03 * np.cos(3.0 * time), 0.02 * np.sin(4.0 * time + 1.0)], axis=1)
    return {
        "measured_bank": 0.5 * np.sin(1.3 * time) - 0.1,
        "measured_angular_velocity": w,
        "reference_bank": 0.4 * np.cos(0.9 * time),
        "reference_bank_rate": -0.05 * np.sin(0.9 * time),
        "reference_bank_acceleration": -0.03 * np.cos(0.9 * time),
    }


def no_control():
    """No torque, whatever is measured."""
    return Check(
        truth="closed form",
        step=STEP,
        inputs=signals(),
        outputs={"torque_command": np.zeros((ROWS, 3)), "status": np.zeros(ROWS)},
        tolerances={"torque_command": (0.0, 0.0), "status": (0.0, 0.0)},
        parameters={"sample_period": STEP},
    )


def robust_control():
    """Angular velocity in axes along the velocity, a law for each, and the turn back."""
    trim, stiffness, damping, sideslip_damping, pitch, limit = -0.3, 0.2, 0.8, 0.25, 0.35, 0.06
    inputs = signals()
    to_velocity = Rotation.from_euler("z", trim)
    w = to_velocity.apply(inputs["measured_angular_velocity"])
    along = inputs["reference_bank_acceleration"] - damping * (w[:, 0] - inputs["reference_bank_rate"])
    along = along - stiffness * (inputs["measured_bank"] - inputs["reference_bank"])
    assert 0 < (np.abs(along) > limit).sum() < ROWS
    acceleration = np.stack([along.clip(-limit, limit), -sideslip_damping * w[:, 1], -pitch * w[:, 2]], axis=1)
    torque = to_velocity.inv().apply(acceleration) @ INERTIA.T
    return Check(
        truth="rotations by scipy",
        step=STEP,
        inputs=inputs,
        outputs={"torque_command": follow(torque), "status": np.zeros(ROWS)},
        tolerances={"torque_command": (1e-12, 0.0), "status": (0.0, 0.0)},
        parameters={
            "sample_period": STEP,
            "trim_attack": trim,
            "dead_zone": 0.0,
            "bank_stiffness": stiffness,
            "bank_damping": damping,
            "sideslip_damping": sideslip_damping,
            "pitch_damping": pitch,
            "largest_acceleration": limit,
        },
    )


TRUTHS = {"no_control": no_control, "robust_control": robust_control}
