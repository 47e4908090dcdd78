"""Truths of disturbances: closed forms, and the theory of linear systems driven by white noise."""

import numpy as np
from scipy.linalg import solve_continuous_lyapunov

from tests.support.checks.check import STEP, Check
from tests.support.checks.mrg32k3a import Numbers
from tests.support.checks.white_noise import discretise


def air_disturbance():
    """Compute half a cosine of wind, and a density that changes at a row."""
    wind, gust = np.array([10.0, -4.0, 2.0]), np.array([30.0, 8.0, -16.0])
    begin, duration, change = 1.3, 2.9, 2.5
    time = STEP * np.arange(49)
    fraction = np.where((time > begin) & (time < begin + duration), np.sin(np.pi * (time - begin) / duration) ** 2, 0.0)
    return Check(
        truth="closed form",
        step=STEP,
        inputs={},
        outputs={"air_velocity": wind + fraction[:, None] * gust, "density_factor": np.where(time < change, 0.9, 1.2)},
        tolerances={"air_velocity": (1e-12, 0.0), "density_factor": (0.0, 0.0)},
        parameters={
            "wind": wind,
            "gust": gust,
            "gust_time": begin,
            "gust_duration": duration,
            "density": 0.9,
            "density_time": change,
            "later_density": 1.2,
        },
    )


def jet_health():
    """Return constant factors."""
    factors = np.array([1.0, 0.5, 0.0, 1.1, 0.9, 1.0])
    return Check(
        truth="closed form",
        step=STEP,
        inputs={},
        outputs={"jet_factor": np.tile(factors, (13, 1))},
        tolerances={"jet_factor": (0.0, 0.0)},
        parameters={"factors": factors},
    )


def forming_filter():
    """Compute the matrix exponential, van Loan's covariance of a step's noise and Lyapunov's of the start.

    Each step takes two numbers, the first for the disturbance, by the lower Cholesky factor.
    """
    damping, w, intensity, rows, seed, stream = 0.3, 2.0, 0.7, 49, 28, 7
    a, noise = np.array([[0.0, 1.0], [-w * w, -2.0 * damping * w]]), np.diag([0.0, intensity * w**4])
    f, step_covariance = discretise(a, noise)
    start, step = (np.linalg.cholesky(c) for c in (solve_continuous_lyapunov(a, -noise), step_covariance))
    first, *later = Numbers(seed, stream).normal(rows, 2)
    states = [start @ first]
    for numbers in later:
        states.append(f @ states[-1] + step @ numbers)
    disturbance, rate = np.transpose(states)
    return Check(
        truth="matrix exponentials by scipy, exact random numbers",
        step=STEP,
        inputs={},
        outputs={"disturbance": disturbance, "disturbance_rate": rate},
        tolerances={"disturbance": (1e-12, 0.0), "disturbance_rate": (1e-12, 0.0)},
        parameters={
            "damping": damping,
            "natural_frequency": w,
            "intensity": intensity,
            "seed": np.array(seed),
            "stream": np.array(stream),
        },
    )


TRUTHS = {"air_disturbance": air_disturbance, "forming_filter": forming_filter, "jet_health": jet_health}
