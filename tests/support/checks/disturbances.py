"""Truths of disturbances: closed forms."""

import numpy as np

from tests.support.checks.check import STEP, Check


def air_disturbance():
    """Half a cosine of wind, and a density that changes at a row."""
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
    """The factors are constant."""
    factors = np.array([1.0, 0.5, 0.0, 1.1, 0.9, 1.0])
    return Check(
        truth="closed form",
        step=STEP,
        inputs={},
        outputs={"jet_factor": np.tile(factors, (9, 1))},
        tolerances={"jet_factor": (0.0, 0.0)},
        parameters={"factors": factors},
    )


TRUTHS = {"air_disturbance": air_disturbance, "jet_health": jet_health}
