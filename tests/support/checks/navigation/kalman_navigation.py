"""Truth of Kalman navigation, of both its blocks."""

import numpy as np

from tests.support.checks.check import STEP, Check
from tests.support.checks.navigation.kalman_filter import (
    DRIFT,
    GATE,
    GOOD,
    LIMIT,
    LOCKED_OUT,
    NOISE,
    REJECTED,
    SENSORS,
    SIGMAS,
    WALK,
    Filter,
)
from tests.support.checks.navigation.lunar_flight import CENTRE, MOON_RADIUS, MU, ROWS, STREAMS, TIME, truth_of_flight

FREE = (0, 1, 2, 3, 4, 27, 28)  # rows
WITHOUT_INCREMENT = (6, 13, 14, 16, 21, 26)
TAKEN_IN = {"altitude": (0, 4, 9, 13, 17, 21, 26), "velocity": (2, 9, 14, 19, 29), "position": (0, 6, 9, 18, 25, 30)}
WRONG = {  # by sensor and row: how much a sample is wrong by
    ("altitude", 13): 100.0,
    ("altitude", 17): 105.0,
    ("altitude", 21): 98.0,
    ("velocity", 19): [0.0, 9.0, 0.0],
    ("position", 18): [500.0, 0.0, -300.0],
}


def mean_forces(increments, new, free):
    """Return the specific force of each step from the gain until its end: measured, or as before since the last
    sample."""
    gained, anchor, slope = [np.zeros(3)], (0.0, np.zeros(3)), np.zeros(3)
    for row, end in enumerate(TIME[1:]):
        if free[row]:
            anchor, slope = (end, gained[-1]), np.zeros(3)
        elif new[row] and row > 0:  # that of the start is no increment
            slope = increments[row] / (end - anchor[0])
            anchor = (end, anchor[1] + increments[row])
        gained.append(anchor[1] + slope * (end - anchor[0]))
    return np.diff(gained, axis=0) / STEP


def kalman_navigation():
    """Free flight at first and once more, thrust with increments that are missing; samples that the gate rejects.

    One or two scalars of three are rejected, and the altitude until it is locked out and then believed.
    """
    random = np.random.default_rng(37)
    # a sample of the first row is taken at the start, of the others at the end of their step
    position, velocity = truth_of_flight(np.where(TIME > 0.0, TIME + STEP, 0.0))
    free = np.isin(np.arange(ROWS), FREE)
    new = ~np.isin(np.arange(ROWS), WITHOUT_INCREMENT)
    since = np.where(np.roll(new, 1), 1, np.where(np.roll(new, 2), 2, 3))[:, None] * STEP
    increments = since * (np.array([3.0, -0.5, 2.6]) + random.normal(0.0, 0.1, (ROWS, 3)))
    true = {
        "altitude": np.linalg.norm(position - CENTRE, axis=1) - MOON_RADIUS,
        "velocity": velocity,
        "position": position,
    }
    deviations = {"altitude": 8.0, "velocity": 0.3, "position": 20.0}
    measured = {name: true[name] + random.normal(0.0, deviations[name], true[name].shape) for name in SENSORS}
    for (name, row), error in WRONG.items():
        measured[name][row] += error
    kalman = Filter(position, velocity)
    rows = []

    def process_scalar(row):
        for name in SENSORS:
            if row in TAKEN_IN[name]:
                kalman.measure(name, measured[name][row])

    process_scalar(0)
    rows.append(kalman.outputs())
    for row, force in enumerate(mean_forces(increments, new, free)):
        kalman.samples += int(new[row] and row > 0)
        kalman.advance(force, free[row])
        if row > 0:
            process_scalar(row)
        rows.append(kalman.outputs())
    outputs = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    assert set(outputs["status"]) == {GOOD, REJECTED, LOCKED_OUT}
    assert kalman.grown
    assert kalman.rejected == 6  # two altitudes, two of a position, one of a velocity; a good altitude after wrong ones
    return Check(
        truth="matrices by numpy, the scalars of a sensor at once; exact random numbers",
        step=STEP,
        inputs={
            "position": position,
            "velocity": velocity,
            "velocity_increment": increments,
            "inertial_count": np.cumsum(new),
            **{f"measured_{name}": measured[name] for name in SENSORS},
            **{f"{name}_count": np.cumsum(np.isin(np.arange(ROWS), TAKEN_IN[name])) for name in SENSORS},
            "free_flight": free,
        },
        outputs=outputs,
        tolerances={
            **dict.fromkeys(outputs, (1e-12, 1e-11)),
            "estimated_position": (1e-9, 0.0),
            "estimated_velocity": (1e-11, 0.0),
            "estimated_bias": (1e-13, 0.0),
            **{name: (1e-10, 1e-11) for name in outputs if name.endswith("innovation_square")},
            **dict.fromkeys(("rejected_count", "sample_count", "status"), (0.0, 0.0)),
        },
        parameters={
            "moon_radius": MOON_RADIUS,
            "gravitational_parameter": MU,
            **SIGMAS,
            "velocity_random_walk": WALK,
            "bias_random_walk": DRIFT,
            **{f"{name}_relative_sigma": relative for name, (relative, _) in NOISE.items()},
            **{f"{name}_sigma": constant for name, (_, constant) in NOISE.items()},
            "gravity_gradient": True,
            "innovation_gate": GATE,
            "rejection_limit": LIMIT,
            "reacquire": True,
            **STREAMS,
        },
    )
