"""Truths of control blocks of an entry capsule."""

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow

INERTIA = np.array([[1400.0, -40.0, 0.0], [-40.0, 1250.0, 0.0], [0.0, 0.0, 1200.0]])
ROWS = 33


def signals():
    """Return bank, angular velocity and reference of all signs."""
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
    """Return no torque, whatever is measured."""
    return Check(
        truth="closed form",
        step=STEP,
        inputs=signals(),
        outputs={"torque_command": np.zeros((ROWS, 3)), "status": np.zeros(ROWS)},
        tolerances={"torque_command": (0.0, 0.0), "status": (0.0, 0.0)},
        parameters={"sample_period": STEP},
    )


def robust_control():
    """Compute the angular velocity in axes along the velocity, a law for each, and the turn back."""
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


def output_feedback():
    """Apply one matrix over bank and rates against the reference, its gains interpolated by numpy; the turn by scipy.

    The dynamic pressure goes from below the first pressure to above the last, the bank once around.
    """
    trim, dead_zone, pitch, error_limit = -0.3, 0.2, 900.0, 0.3
    pressures, level = np.array([400.0, 1100.0, 5000.0]), np.array([90.0, 70.0, 80.0])
    gains = np.random.default_rng(286).uniform(-900.0, 300.0, (3, 6)) * np.array([0.4, 1.0, 1.0, 0.4, 1.0, 1.0])
    inputs = signals()
    inputs["measured_bank"] = 4.0 * np.linspace(-1.0, 1.0, ROWS) ** 3
    inputs["dynamic_pressure"] = np.geomspace(200.0, 9000.0, ROWS)
    inputs["error_limit"] = np.full(ROWS, error_limit)
    interpolated = [np.interp(np.log(inputs["dynamic_pressure"]), np.log(pressures), column) for column in gains.T]
    along = Rotation.from_euler("z", trim).inv().apply([1.0, 0.0, 0.0])
    error = np.angle(np.exp(1j * (inputs["measured_bank"] - inputs["reference_bank"])))
    assert 0 < (np.abs(error) > error_limit).sum() < ROWS
    rates = inputs["measured_angular_velocity"] - np.outer(inputs["reference_bank_rate"], along)
    errors = np.column_stack([error.clip(-error_limit, error_limit), rates[:, :2]])
    torque = np.outer(inputs["reference_bank_acceleration"], INERTIA @ along)
    torque[:, :2] += np.einsum("krc,rc->rk", np.reshape(interpolated, (2, 3, ROWS)).transpose(0, 2, 1), errors)
    torque[:, 2] = -pitch * inputs["measured_angular_velocity"][:, 2]
    small = np.abs(torque) < dead_zone * level
    assert (small.any(axis=0) & ~small.all(axis=0)).all()
    return Check(
        truth="matrices and interpolation by numpy, the turn by scipy",
        step=STEP,
        inputs=inputs,
        outputs={"torque_command": follow(np.where(small, 0.0, torque)), "status": np.zeros(ROWS)},
        tolerances={"torque_command": (1e-10, 0.0), "status": (0.0, 0.0)},
        parameters={
            "sample_period": STEP,
            "trim_attack": trim,
            "dead_zone": dead_zone,
            "pitch_damping": pitch,
            "jet_torque": level,
            "pressures": pressures,
            "gains": gains.reshape(6, 3),
        },
    )


TRUTHS = {
    "no_control": no_control,
    "output_feedback": output_feedback,
    "robust_control": robust_control,
}
