"""Truth of a satellite with reaction wheels: the equations of motion as published, in angular velocity and speeds."""

import numpy as np

from tests.support.checks.check import STEP, Check
from tests.support.checks.plants.motion import fly
from tests.support.checks.vectors import unit


def wheel_satellite():
    """Integrate wheels in a skewed array with friction on both sides of its band, one weak motor, torques of both
    kinds.

    (I - sum Js g g') w' = -w x (I w + sum Js W g) - sum us g + L, W' = us/Js - g.w'.
    """
    inertia, spin, rows = np.array([[12.0, -0.7, 0.3], [-0.7, 9.0, 0.5], [0.3, 0.5, 7.0]]), 0.4, 33
    axes = np.array([[1.0, 0.2, 0.5], [-0.3, 1.2, 0.4], [-0.9, -0.2, 0.6], [0.1, -1.0, 0.8]])
    g = unit(axes)
    factor, limit = np.array([1.0, 0.9, 1.1, 0.3]), 0.3
    viscous, coulomb, band = 0.004, 0.02, 20.0
    fixed, inertial = np.array([0.02, -0.01, 0.03]), np.array([-0.05, 0.04, 0.02])
    commands = np.repeat(np.random.default_rng(44).uniform(-0.4, 0.4, (5, 4)), 8, axis=0)[:rows]
    assert (np.abs(commands) > limit).any()
    motors = factor * np.clip(commands, -limit, limit)
    start = np.array([0.5, 0.1, -0.7, 0.5, 0.08, -0.05, 0.11, 5.0, -30.0, 12.0, -25.0])
    start[:4] = unit(start[:4])
    matrix = inertia - spin * g.T @ g

    def rates_of(row):
        def slope(t, y):
            q, w, speeds = y[:4], y[4:7], y[7:]
            torque = motors[row] - viscous * speeds - coulomb * np.clip(speeds / band, -1.0, 1.0)
            twice = 2.0 * np.cross(q[1:], inertial)  # body components of a vector: q* v q
            external = fixed + inertial - q[0] * twice + np.cross(q[1:], twice)
            total = inertia @ w + spin * speeds @ g
            w_rate = np.linalg.solve(matrix, external - np.cross(w, total) - torque @ g)
            q_rate = 0.5 * np.array([-q[1:] @ w, *(q[0] * w + np.cross(q[1:], w))])
            return np.concatenate([q_rate, w_rate, torque / spin - g @ w_rate])

        return slope

    y = fly(rates_of, start, rows, atol=1e-13)
    speeds = y[:, 7:]
    assert (np.abs(speeds) < band).any()
    assert (np.abs(speeds) > band).any()
    beyond = (np.abs(commands) > limit).any(axis=1)
    return Check(
        truth="Schaub and Junkins's equations by DOP853 at 1e-13",
        step=STEP,
        inputs={"motor_torques": commands},
        outputs={
            "quaternion": y[:, :4],
            "angular_velocity": y[:, 4:7],
            "wheel_speeds": speeds,
            "wheel_momentum": spin * speeds @ g,
            "applied_torques": np.vstack([np.zeros(4), motors[:-1]]),
            "status": np.concatenate([[0], beyond[:-1]]),
        },
        tolerances={
            "quaternion": (1e-9, 0.0),
            "angular_velocity": (1e-9, 0.0),
            "wheel_speeds": (1e-7, 0.0),
            "wheel_momentum": (1e-7, 0.0),
            "applied_torques": (1e-15, 0.0),
            "status": (0.0, 0.0),
        },
        parameters={
            "inertia": inertia,
            "wheel_axes": axes,
            "wheel_inertia": spin,
            "motor_torque_limit": limit,
            "torque_factor": factor,
            "viscous_friction": viscous,
            "coulomb_friction": coulomb,
            "coulomb_band": band,
            "body_torque": fixed,
            "inertial_torque": inertial,
            "initial_quaternion": start[:4],
            "initial_angular_velocity": start[4:7],
            "initial_wheel_speeds": start[7:],
            "internal_step": 0.0078125,
        },
    )


TRUTHS = {"wheel_satellite": wheel_satellite}
