"""Truths of monitors of estimates and plans. Direct outputs follow one row later."""

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.navigation.lunar_flight import ROWS, TIME, UPPER, truth_of_flight

CLOSING_RANGE, CONE = 40.0, 2.15  # the robot is within the cone later only


def estimate_monitor():
    """Compute errors over their covariance by numpy."""
    random = np.random.default_rng(30)
    position, velocity = truth_of_flight()
    sigma = np.array([10.0, 8.0, 6.0, 0.5, 0.4, 0.3])
    factor = sigma[:, None] * (2.0 * np.eye(6) + random.uniform(-0.5, 0.5, (ROWS, 6, 6)))
    covariance = factor @ factor.transpose(0, 2, 1)
    error = random.normal(0.0, 1.0, (ROWS, 6)) * np.array([20.0, 20.0, 20.0, 1.0, 1.0, 1.0])
    ratio = error / np.sqrt(covariance[:, range(6), range(6)])
    square = (error * np.linalg.solve(covariance, error[..., None])[..., 0]).sum(axis=1)
    return Check(
        truth="linear equations by numpy",
        step=STEP,
        inputs={
            "position": position,
            "velocity": velocity,
            "estimated_position": position + error[:, :3],
            "estimated_velocity": velocity + error[:, 3:],
            "estimate_covariance": covariance[:, *UPPER],
        },
        outputs={
            "normalised_error_square": follow(square),
            "position_error_ratio": follow(ratio[:, :3]),
            "velocity_error_ratio": follow(ratio[:, 3:]),
        },
        tolerances={
            "normalised_error_square": (0.0, 1e-11),
            "position_error_ratio": (1e-10, 0.0),
            "velocity_error_ratio": (1e-11, 0.0),
        },
        parameters={},
    )


def rendezvous_monitor():
    """Compute rotation vector and modified Rodrigues parameters by scipy."""
    robot = 5.0 * np.sin(0.4 * TIME[:, None] + np.array([0.0, 1.0, 2.0]))
    target = np.array([40.0, 10.0, -5.0]) + np.outer(TIME, [0.3, -0.2, 0.1])
    drift = np.array([-0.6, 0.3, 0.9]) + 0.1 * np.sin(0.5 * TIME[:, None] + np.array([0.0, 1.0, 2.0]))
    planned_position = target - robot + 0.3 * np.cos(TIME[:, None] + np.array([0.0, 1.0, 2.0]))
    attitude = Rotation.from_rotvec(np.sin(0.3 * TIME[:, None] + np.array([0.2, 1.2, 2.2])))
    planned = attitude * Rotation.from_rotvec(0.1 * np.cos(TIME[:, None] + np.array([1.0, 2.0, 3.0])))
    error = (planned.inv() * attitude).as_rotvec()
    distance = np.linalg.norm(target - robot, axis=1)
    # the rotation from one direction to the other
    cone = np.array(
        [Rotation.align_vectors([-v], [r])[0].magnitude() for v, r in zip(drift, robot - target, strict=True)]
    )
    first = int(np.argmax(distance <= CLOSING_RANGE))
    assert 0 < first < ROWS - 1
    closing = np.where(np.arange(ROWS) < first, 0, 1 if cone[first] <= CONE else 2)
    outputs = {
        "position_error": planned_position - (target - robot),
        "range": distance,
        "range_error": distance - np.linalg.norm(planned_position, axis=1),
        "attitude_error": error,
        "attitude_error_angle": np.linalg.norm(error, axis=1),
        "rodrigues": attitude.as_mrp(),
        "cone_angle": cone,
        "closing_start": closing,
    }
    return Check(
        truth="rotations by scipy",
        step=STEP,
        inputs={
            "robot_position": robot,
            "target_position": target,
            "target_velocity": drift,
            "quaternion": attitude.as_quat(scalar_first=True),
            "planned_relative_position": planned_position,
            "planned_quaternion": planned.as_quat(scalar_first=True),
        },
        outputs={name: follow(rows) for name, rows in outputs.items()},
        tolerances={**dict.fromkeys(outputs, (1e-13, 0.0)), "cone_angle": (1e-12, 0.0), "closing_start": (0.0, 0.0)},
        parameters={"closing_range": CLOSING_RANGE, "cone_half_angle": CONE},
    )


TRUTHS = {"estimate_monitor": estimate_monitor, "rendezvous_monitor": rendezvous_monitor}
