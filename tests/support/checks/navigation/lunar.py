"""Truths of lunar navigation with errors. Direct outputs follow one row later."""

import numpy as np
from filterpy.kalman import KalmanFilter

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.mrg32k3a import Numbers

ROWS, SEED, STREAM, MOON_RADIUS, MU = 33, 28, 7, 1.7374e6, 4.9028e12
TIME = STEP * np.arange(ROWS)
UPPER = np.triu_indices(6)
STREAMS = {"seed": SEED, "stream": STREAM}


def truth_of_flight():
    """Position and velocity of a parabola."""
    velocity = np.array([-900.0, 50.0, -40.0]) + np.outer(TIME, [3.0, -0.5, 1.0])
    position = np.array([9.0e4, -5.0e3, 1.2e4]) + np.outer(TIME, [-900.0, 50.0, -40.0])
    return position + np.outer(TIME**2 / 2.0, [3.0, -0.5, 1.0]), velocity


def coloured_navigation():
    """Gauss-Markov errors, summed from all their past, and white ones."""
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


def first_knowledge(numbers, position, velocity, position_sigma, velocity_sigma):
    """Truth with errors, drawn axis by axis."""
    errors = numbers.normal(3, 2)
    return position[0] + position_sigma * errors[:, 0], velocity[0] + velocity_sigma * errors[:, 1]


def noisy_navigation():
    """A filter of filterpy that takes in three components at once."""
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


def raw_navigation():
    """Dead reckoning as documented, with an altitude, a velocity and a position put in."""
    position, velocity = truth_of_flight()
    increment = STEP * (np.array([3.0, -0.5, 2.6]) + 0.3 * np.sin(TIME[:, None] + np.array([0.0, 1.0, 2.0])))
    altitude_row, velocity_row, position_row = 8, 16, 24
    fixes = {"altitude": 11900.0, "velocity": [-880.0, 48.0, -30.0], "position": [8.8e4, -4.8e3, 1.19e4]}
    centre = np.array([0.0, 0.0, -MOON_RADIUS])

    def gravity(r):
        return -MU * (r - centre) / np.linalg.norm(r - centre) ** 3

    r, v = first_knowledge(Numbers(SEED, STREAM), position, velocity, 40.0, 0.8)
    states, before = [(r, v)], np.zeros(3)
    for row in range(ROWS - 1):
        f = increment[row] / STEP if row > 0 else np.zeros(3)  # the sample of the start is not an increment
        ahead = v + STEP * (f + (gravity(r) + gravity(r + STEP * v)) / 2.0)
        r, v, before = r + STEP * (v + ahead) / 2.0 - STEP**2 / 12.0 * (f - before), ahead, f
        if row == altitude_row:
            r = centre + (MOON_RADIUS + fixes["altitude"]) * (r - centre) / np.linalg.norm(r - centre)
        elif row == velocity_row:
            v = np.array(fixes["velocity"])
        elif row == position_row:
            r = np.array(fixes["position"])
        states.append((r, v))
    y, rows = np.array(states), np.arange(ROWS)
    counts = np.array([rows >= row for row in (altitude_row, velocity_row, position_row)]).astype(float)
    outputs = {
        "estimated_position": y[:, 0],
        "estimated_velocity": y[:, 1],
        "position_estimate_sigma": np.zeros((ROWS, 3)),
        "velocity_estimate_sigma": np.zeros((ROWS, 3)),
        "sample_count": follow(rows + counts.sum(axis=0)),
    }
    return Check(
        truth="the documented equations by numpy; exact random numbers",
        step=STEP,
        inputs={
            "position": position,
            "velocity": velocity,
            "velocity_increment": increment,
            "inertial_count": rows,
            "measured_altitude": np.full(ROWS, fixes["altitude"]),
            "altitude_count": counts[0],
            "measured_velocity": np.tile(fixes["velocity"], (ROWS, 1)),
            "velocity_count": counts[1],
            "measured_position": np.tile(fixes["position"], (ROWS, 1)),
            "position_count": counts[2],
        },
        outputs=outputs,
        tolerances={
            **dict.fromkeys(outputs, (0.0, 0.0)),
            "estimated_position": (1e-8, 0.0),
            "estimated_velocity": (1e-11, 0.0),
        },
        parameters={
            "moon_radius": MOON_RADIUS,
            "gravitational_parameter": MU,
            "first_position_sigma": 40.0,
            "first_velocity_sigma": 0.8,
            **STREAMS,
        },
    )


TRUTHS = {
    "coloured_navigation": coloured_navigation,
    "noisy_navigation": noisy_navigation,
    "raw_navigation": raw_navigation,
}
