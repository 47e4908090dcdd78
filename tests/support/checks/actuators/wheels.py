"""Truths of wheel allocations: numpy's pseudo-inverse and null space, and linear programmes."""

import numpy as np
from scipy.linalg import null_space
from scipy.optimize import linprog

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.vectors import unit

ROWS, LIMIT, SPIN, GAIN, SPEED = 33, 0.3, 0.05, 0.4, 40.0
AXES = np.array([[1.0, 0.2, 0.5], [-0.3, 1.2, 0.4], [-0.9, -0.2, 0.6], [0.1, -1.0, 0.8]])


def smallest_maximum(u, n):
    """Return u + s n with the smallest largest size, over s: a linear programme in s and the size."""
    rows = np.block([[n[:, None], -np.ones((4, 1))], [-n[:, None], -np.ones((4, 1))]])
    solution = linprog([0.0, 1.0], A_ub=rows, b_ub=np.concatenate([-u, u]), bounds=[(None, None), (0.0, None)])
    return u + solution.x[0] * n


def check_allocation(truth, distribute):
    """Return the check of an allocation; distribute: torques by the pseudo-inverse, speeds,
    null vector -> torques, change."""
    random = np.random.default_rng(45)
    required, speeds = random.normal(0.0, 0.25, (ROWS, 3)), random.normal(0.0, 60.0, (ROWS, 4))
    required[20] = 1e102
    a = unit(AXES).T
    n = null_space(a)[:, 0]
    n = n * np.sign(n[0])
    motors, statuses = np.zeros((ROWS, 4)), np.zeros(ROWS)
    for row in range(ROWS):
        if np.abs(required[row]).max() > 1e100:
            statuses[row] = 2
            continue
        u, change = distribute(-np.linalg.pinv(a) @ required[row], speeds[row], n)
        largest = np.abs(u).max()
        if largest > LIMIT:
            motors[row], statuses[row] = LIMIT / largest * u, 1
        else:
            amount = GAIN * SPIN * n @ change
            left = np.min((LIMIT - np.sign(amount * n) * u) / np.abs(n))
            motors[row] = u + np.clip(amount, -left, left) * n
    assert set(statuses) == {0, 1, 2}
    return Check(
        truth=truth,
        step=STEP,
        inputs={"torque_command": required, "wheel_speeds": speeds},
        outputs={
            "motor_torques": follow(motors),
            "allocated_torque": follow(-motors @ a.T),
            "status": follow(statuses),
        },
        tolerances={"motor_torques": (1e-12, 0.0), "allocated_torque": (1e-12, 0.0), "status": (0.0, 0.0)},
        parameters={
            "wheel_axes": AXES,
            "wheel_inertia": SPIN,
            "motor_torque_limit": LIMIT,
            "null_gain": GAIN,
            "null_speed": SPEED,
            "sample_period": STEP,
        },
    )


def wheel_allocation_pseudo_inverse():
    """Minimise squares; null motion to a speed."""
    return check_allocation(
        "pseudo-inverse by numpy, null space by scipy",
        lambda u, speeds, n: (u, 2.0 * SPEED * n - speeds),
    )


def wheel_allocation_minimax():
    """Minimise the maximum of torques, and of speeds with the same momentum."""
    return check_allocation(
        "linear programmes by scipy (HiGHS)",
        lambda u, speeds, n: (smallest_maximum(u, n), smallest_maximum(speeds, n) - speeds),
    )


TRUTHS = {
    "wheel_allocation_minimax": wheel_allocation_minimax,
    "wheel_allocation_pseudo_inverse": wheel_allocation_pseudo_inverse,
}
