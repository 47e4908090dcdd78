"""Truth of the robot's attitude filter: all axes at once by filterpy, rotations by scipy."""

import numpy as np
from scipy.spatial.transform import Rotation

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


def sine_error(planned, actual):
    """Return axis times sine of the angle from one attitude to another."""
    rotation = (planned.inv() * actual).as_rotvec()
    angle = np.linalg.norm(rotation)
    return np.sinc(angle / np.pi) * rotation


def attitude_filter():
    """Check a turning robot with gyros and jets that start and stop; samples of either sign, one not finite.

    Between samples Euler's equations give the mean angular velocity of a step to first order in it, and the total
    momentum turns back into the body's axes, as the block's docstring says. The covariance is that of errors in body
    axes, which it takes not to turn.
    """
    random = np.random.default_rng(34)
    inertia = np.array([812.0, 587.0, 910.0])
    sigma, rate_sigma, noise = 2e-4, 3e-4, 1e-7
    disturbance_sigma, disturbance_noise, torque_error = 1e-4, 1e-8, 0.05
    true = Rotation.from_rotvec(np.array([0.3, -0.2, 0.9]) + np.outer(TIME, [0.02, -0.05, 0.03]))
    planned = true * Rotation.from_rotvec(0.02 * np.sin(0.5 * TIME[:, None] + PHASES))
    planned_rate = np.array([0.02, -0.05, 0.03]) + 2e-3 * np.cos(0.5 * TIME[:, None] + PHASES)
    measured = (true * Rotation.from_rotvec(random.normal(0.0, sigma, (ROWS, 3)))).as_quat(scalar_first=True)
    measured *= random.choice([-1.0, 1.0], (ROWS, 1))
    gyros = 30.0 * np.sin(0.3 * TIME[:, None] + PHASES)
    force = np.where((TIME % 1.5 < 0.75)[:, None], 0.4 * np.cos(TIME[:, None] + PHASES), 0.0)
    torque = np.cross([0.9, -0.6, 0.5], force)
    count = 1 + np.arange(ROWS) // 2
    new = np.diff(count, prepend=0) > 0
    assert new[NOT_FINITE]
    finite = measured.copy()
    measured[NOT_FINITE, 2] = np.nan
    attitude, w, disturbance = Rotation.from_quat(measured[0], scalar_first=True), planned_rate[0], np.zeros(3)
    kalman = chain_filter([sigma, rate_sigma, disturbance_sigma], sigma)
    quaternion, square, used, status = measured[0], 0.0, 1, 0
    rows = []

    def note(row):
        offset = planned[row].inv() * attitude
        sigmas = np.sqrt(kalman.P[[0, 3], [0, 3]])
        errors = [sine_error(planned[row], attitude), w - offset.inv().apply(planned_rate[row])]
        rows.append([*errors, quaternion, disturbance, *sigmas, square, used, status])

    note(0)
    for row in range(ROWS - 1):
        before = max(row - 1, 0)
        gyro_torque = (gyros[row] - gyros[before]) / STEP
        total = inertia * w + gyros[before]
        applied = torque[row] + inertia * disturbance
        acceleration = (applied - gyro_torque - np.cross(w, total)) / inertia
        turn = Rotation.from_rotvec(STEP * (w + STEP / 2.0 * acceleration))
        total = turn.inv().apply(total + STEP / 2.0 * applied) + STEP / 2.0 * applied
        w, attitude = (total - gyros[row]) / inertia, attitude * turn
        jump = force[row] - (force[row - 1] if row > 0 else 0.0)  # before the start there was no force
        kalman.P[6:, 6:] += (torque_error / inertia.mean()) ** 2 * (jump @ jump) * np.eye(3)
        predict(kalman, [0.0, noise, disturbance_noise])
        if new[row] and row == NOT_FINITE:
            status = 1
        elif new[row] and row > 0:
            observed = Rotation.from_quat(finite[row], scalar_first=True)
            kalman.update((attitude.inv() * observed).as_rotvec())
            change = kalman.x.reshape(3, 3)
            attitude, w, disturbance = (
                attitude * Rotation.from_rotvec(change[0]),
                w + change[1],
                disturbance + change[2],
            )
            kalman.x = np.zeros(9)
            square, used, status = innovation_square(kalman), used + 1, 0
        ahead = attitude.as_quat(scalar_first=True)
        quaternion = ahead * np.sign(ahead @ quaternion)  # of the sign of the first sample, without jumps
        note(row)
    names = (
        "attitude_error",
        "rate_error",
        "quaternion",
        "disturbance",
        "attitude_error_sigma",
        "rate_error_sigma",
        "innovation_square",
        "samples_taken",
        "status",
    )
    outputs = {name: np.array(values) for name, values in zip(names, zip(*rows, strict=True), strict=True)}
    return Check(
        truth="filterpy, all axes at once; noise by matrix exponential, rotations by scipy",
        step=STEP,
        inputs={
            "measured_quaternion": measured,
            "sample_count": count,
            "planned_quaternion": planned.as_quat(scalar_first=True),
            "planned_angular_velocity": planned_rate,
            "gyro_momentum": gyros,
            "jet_torque": torque,
            "jet_force": force,
        },
        outputs=outputs,
        tolerances={
            **dict.fromkeys(outputs, (1e-14, 1e-12)),
            "quaternion": (1e-14, 0.0),
            "innovation_square": (0.0, 1e-9),
            "samples_taken": (0.0, 0.0),
            "status": (0.0, 0.0),
        },
        parameters={
            "inertia": inertia,
            "attitude_sigma": sigma,
            "first_rate_sigma": rate_sigma,
            "process_noise": noise,
            "first_disturbance_sigma": disturbance_sigma,
            "disturbance_noise": disturbance_noise,
            "jet_torque_error": torque_error,
            "sample_period": STEP,
        },
    )
