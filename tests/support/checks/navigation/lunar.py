"""Truths of lunar navigation with navigation errors. Direct outputs follow one row later."""

import numpy as np
from filterpy.kalman import KalmanFilter

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.mrg32k3a import Numbers
from tests.support.checks.navigation.lunar_flight import (
    ROWS,
    SEED,
    STREAM,
    STREAMS,
    TIME,
    UPPER,
    first_knowledge,
    truth_of_flight,
)


def coloured_navigation():
    """Sum Gauss-Markov errors from all their past, and add white ones."""
    position, velocity = truth_of_flight()
    sigma, lag, white = np.repeat([30.0, 0.4], 3), 2.5, 0.4
    numbers = Numbers(SEED, STREAM).normal(ROWS, 2, 6)
    ages = np.subtract.outer(TIME, TIME)
    weights = np.where(ages >= 0.0, np.exp(-np.abs(ages) / lag), 0.0)
    weights[:, 1:] *= np.sqrt(1.0 - np.exp(-2.0 * STEP / lag))
    error = sigma * (weights @ numbers[:, 0] + white * numbers[:, 1])
    whole = sigma * np.sqrt(1.0 + white**2)
    outputs = {
        "estimated_position": follow(position) + error[:, :3],
        "estimated_velocity": follow(velocity) + error[:, 3:],
        "position_estimate_sigma": np.tile(whole[:3], (ROWS, 1)),
        "velocity_estimate_sigma": np.tile(whole[3:], (ROWS, 1)),
        "estimate_covariance": np.tile(np.diag(whole**2)[UPPER], (ROWS, 1)),
        "sample_count": 1 + np.arange(ROWS),
    }
    return Check(
        truth="weighted sum of exact random numbers",
        step=STEP,
        inputs={"position": position, "velocity": velocity},
        outputs=outputs,
        tolerances={
            **dict.fromkeys(outputs, (1e-12, 0.0)),
            "estimated_position": (1e-10, 0.0),
            "sample_count": (0.0, 0.0),
        },
        parameters={
            "position_sigma": sigma[0],
            "velocity_sigma": sigma[3],
            "correlation_time": lag,
            "white_share": white,
            **STREAMS,
        },
    )


def noisy_navigation():
    """Compute a filter of filterpy that takes in three components at once."""
    position, velocity = truth_of_flight()
    force = np.array([3.0, -0.5, 2.6]) + 0.3 * np.sin(TIME[:, None] + np.array([0.0, 1.0, 2.0]))
    first, sigmas, periods, noise, gravity = (40.0, 0.8), (5.0, 0.1), (4, 2), 1e-3, 1.6
    numbers = Numbers(SEED, STREAM)
    kalman = KalmanFilter(dim_x=6, dim_z=3)
    kalman.x = np.concatenate(first_knowledge(numbers, position, velocity, *first))
    kalman.P = np.diag(np.repeat(np.square(first), 3))
    kalman.F = np.kron([[1.0, STEP], [0.0, 1.0]], np.eye(3))
    kalman.Q = noise * np.kron([[STEP**3 / 3.0, STEP**2 / 2.0], [STEP**2 / 2.0, STEP]], np.eye(3))
    kalman.B = np.kron([[STEP**2 / 2.0], [STEP]], np.eye(3))
    states, covariances, squares, counts = [kalman.x], [kalman.P], [0.0], [0]
    for row in range(ROWS - 1):
        kalman.predict(u=force[row] - np.array([0.0, 0.0, gravity]))
        square, count = squares[-1], counts[-1]
        for kind, true in enumerate((position, velocity)):
            if (row + 1) % periods[kind] == 0:
                measured = true[row] + sigmas[kind] * numbers.normal(3)
                kalman.update(measured, R=sigmas[kind] ** 2 * np.eye(3), H=np.kron(np.eye(2)[kind], np.eye(3)))
                square, count = kalman.y[2] ** 2 / kalman.S[2, 2], count + 1
        states.append(kalman.x)
        covariances.append(kalman.P)
        squares.append(square)
        counts.append(count)
    x, p = np.array(states), np.array(covariances)
    sigma = np.sqrt(p[:, range(6), range(6)])
    outputs = {
        "estimated_position": x[:, :3],
        "estimated_velocity": x[:, 3:],
        "position_estimate_sigma": sigma[:, :3],
        "velocity_estimate_sigma": sigma[:, 3:],
        "estimate_covariance": p[:, *UPPER],
        "innovation_square": np.array(squares),
        "sample_count": np.array(counts),
    }
    return Check(
        truth="filterpy, three components at once; exact random numbers",
        step=STEP,
        inputs={"position": position, "velocity": velocity, "specific_force": force},
        outputs=outputs,
        tolerances={
            **dict.fromkeys(outputs, (1e-12, 1e-12)),
            "estimated_position": (1e-10, 0.0),
            "sample_count": (0.0, 0.0),
        },
        parameters={
            "gravity": gravity,
            "first_position_sigma": first[0],
            "first_velocity_sigma": first[1],
            "position_sigma": sigmas[0],
            "velocity_sigma": sigmas[1],
            "position_period": periods[0] * STEP,
            "velocity_period": periods[1] * STEP,
            "process_noise": noise,
            **STREAMS,
        },
    )


TRUTHS = {"coloured_navigation": coloured_navigation, "noisy_navigation": noisy_navigation}
