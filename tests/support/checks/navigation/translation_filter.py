"""Truth of the robot's translation filter: all axes at once by filterpy, attitude by scipy."""

import numpy as np
from scipy.spatial.transform import Rotation, Slerp

from tests.support.checks.check import STEP, Check
from tests.support.checks.navigation.chains import (
    NOT_FINITE,
    PHASES,
    ROWS,
    TIME,
    chain_filter,
    innovation_square,
    predict,
)


def translation_filter():
    """Check from far to near, under jets that push while the robot turns; one sample is not finite."""
    random = np.random.default_rng(33)
    mass, far, near, near_range = 950.0, 0.03, 0.012, 60.0
    noise, force_error, error_time, velocity_sigma = 1e-7, 0.05, 8.0, 0.05
    planned_position = np.array([40.0, 30.0, 45.0]) - np.outer(TIME, [1.0, 1.5, 0.5])
    planned_velocity = np.array([0.5, 1.0, 0.2]) + np.outer(TIME, [2e-3, -1e-3, 5e-4])
    measured = planned_position + 0.05 * np.sin(TIME[:, None] + PHASES) + random.normal(0.0, 0.02, (ROWS, 3))
    attitude = Rotation.from_rotvec(np.array([0.4, -1.1, 0.7]) + 0.8 * np.sin(0.4 * TIME[:, None] + PHASES))
    quaternion = attitude.as_quat(scalar_first=True)
    quaternion *= np.sign(quaternion @ quaternion[0])[:, None]  # without jumps of the sign
    force = np.where((TIME % 2.0 < 1.0)[:, None], 3.0 * np.cos(TIME[:, None] + PHASES), 0.0)
    count = 1 + np.arange(ROWS) // 3
    new = np.diff(count, prepend=0) > 0
    assert new[NOT_FINITE]
    measured[NOT_FINITE, 1] = np.nan
    distance = np.linalg.norm(measured, axis=1)
    assert (distance[new] < near_range).any()
    assert (distance[new] > near_range).any()
    kalman = chain_filter([far, velocity_sigma], far)
    kalman.B = np.kron([[STEP / 2.0], [1.0]], np.eye(3))
    kalman.x[:3] = planned_position[0] - measured[0]
    states, covariances, squares, used, statuses = [kalman.x], [kalman.P], [0.0], [1], [0]
    for row in range(ROWS - 1):
        before = max(row - 1, 0)
        middle = Slerp([0.0, 1.0], Rotation.concatenate([attitude[before], attitude[row]]))(0.5)
        acceleration = middle.apply(force[row]) / mass
        density = noise + (force_error * np.linalg.norm(acceleration)) ** 2 * error_time
        predict(kalman, [0.0, density], acceleration * STEP - (planned_velocity[row] - planned_velocity[before]))
        square, count_used, status = squares[-1], used[-1], statuses[-1]
        if new[row] and row == NOT_FINITE:
            status = 1
        elif new[row] and row > 0:
            sigma = near if distance[row] < near_range else far
            kalman.update(planned_position[row] - measured[row], R=sigma**2 * np.eye(3))
            square, count_used, status = innovation_square(kalman), count_used + 1, 0
        states.append(kalman.x)
        covariances.append(kalman.P)
        squares.append(square)
        used.append(count_used)
        statuses.append(status)
    x, p = np.array(states), np.array(covariances)
    outputs = {
        "position_error": x[:, :3],
        "velocity_error": x[:, 3:],
        "position_error_sigma": np.sqrt(p[:, 0, 0]),
        "velocity_error_sigma": np.sqrt(p[:, 3, 3]),
        "innovation_square": np.array(squares),
        "samples_taken": np.array(used),
        "status": np.array(statuses),
    }
    return Check(
        truth="filterpy, all axes at once; noise by matrix exponential, attitude by scipy",
        step=STEP,
        inputs={
            "relative_position": measured,
            "sample_count": count,
            "planned_relative_position": planned_position,
            "planned_velocity": planned_velocity,
            "translation_count": np.arange(ROWS) // 16,
            "quaternion": quaternion,
            "allocated_force": force,
        },
        outputs=outputs,
        tolerances={
            **dict.fromkeys(outputs, (1e-13, 0.0)),
            "innovation_square": (0.0, 1e-10),
            "samples_taken": (0.0, 0.0),
            "status": (0.0, 0.0),
        },
        parameters={
            "mass": mass,
            "far_sigma": far,
            "near_sigma": near,
            "near_range": near_range,
            "first_velocity_sigma": velocity_sigma,
            "process_noise": noise,
            "force_error": force_error,
            "force_error_time": error_time,
            "sample_period": STEP,
        },
    )
