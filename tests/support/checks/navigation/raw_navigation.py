"""Truth of raw navigation."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.mrg32k3a import Numbers
from tests.support.checks.navigation.lunar_flight import (
    CENTRE,
    MOON_RADIUS,
    MU,
    ROWS,
    SEED,
    STREAM,
    STREAMS,
    TIME,
    dead_reckon,
    first_knowledge,
    truth_of_flight,
)


def raw_navigation():
    """Compute dead reckoning as documented, with an altitude, a velocity and a position put in."""
    position, velocity = truth_of_flight()
    increment = STEP * (np.array([3.0, -0.5, 2.6]) + 0.3 * np.sin(TIME[:, None] + np.array([0.0, 1.0, 2.0])))
    altitude_row, velocity_row, position_row = 8, 16, 24
    fixes = {"altitude": 11900.0, "velocity": [-880.0, 48.0, -30.0], "position": [8.8e4, -4.8e3, 1.19e4]}
    r, v = first_knowledge(Numbers(SEED, STREAM), position, velocity, 40.0, 0.8)
    states, before = [(r, v)], np.zeros(3)
    for row in range(ROWS - 1):
        f = increment[row] / STEP if row > 0 else np.zeros(3)  # the sample of the start is not an increment
        r, v = dead_reckon(r, v, f, before)
        before = f
        if row == altitude_row:
            r = CENTRE + (MOON_RADIUS + fixes["altitude"]) * (r - CENTRE) / np.linalg.norm(r - CENTRE)
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
