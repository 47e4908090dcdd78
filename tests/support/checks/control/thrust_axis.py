"""Truth of the control of a thrust axis: rotation vectors by scipy, the rate of the command by a complex step."""

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.vectors import unit

ROWS = 33


def thrust_axis_control():
    """Compute small and large errors, so that each closing rate is the least; no direction at first, no attitude last.

    Half of the rotation between two directions is the one to the bisector, given by a product of quaternions.
    """
    rate_gain, angle_gain, braking, maximum_rate, maximum = 1.2, 0.6, 0.02, 0.15, 0.2
    random = np.random.default_rng(291)
    attitude = unit(random.normal(size=(ROWS, 3)))
    size = np.geomspace(0.003, 2.0, ROWS)[random.permutation(ROWS)]
    direction = 1.5 * unit(attitude + size[:, None] * unit(random.normal(size=(ROWS, 3))))
    turning, w = 0.03 * random.normal(size=(ROWS, 3)), 0.1 * random.normal(size=(ROWS, 3))
    feed, since = 0.02 * random.normal(size=(ROWS, 3)), STEP * np.arange(ROWS) - random.uniform(0.0, 0.3, ROWS)
    inputs = {
        "thrust_direction": direction,
        "thrust_direction_rate": turning,
        "command_time": since,
        "angular_acceleration_feed": feed,
        "attitude": attitude,
        "angular_rate": w,
    }
    direction[:4], turning[:4] = 0.0, 0.0
    attitude[-4:] = 0.0
    known = follow((np.arange(ROWS) >= 4) & (np.arange(ROWS) < ROWS - 4))
    direction, turning, since, feed, attitude, w = map(follow, (direction, turning, since, feed, attitude, w))
    ages = STEP * np.arange(ROWS) - since
    angle, demanded = np.zeros(ROWS), feed - rate_gain * w
    complex_goal = unit(direction[known] + (ages[known, None] + 1e-30j) * turning[known])
    goal = complex_goal.real
    bisector = unit(goal + attitude[known])
    scalar = (attitude[known] * bisector).sum(axis=1)[:, None]
    vector = np.cross(attitude[known], bisector)
    error = Rotation.from_quat(np.hstack([vector, scalar])).as_rotvec()
    angle[known] = np.linalg.norm(error, axis=1)
    rates = np.array([angle_gain * angle, np.sqrt(2.0 * braking * angle), np.full(ROWS, maximum_rate)])[:, known]
    assert set(rates.argmin(axis=0)) == {0, 1, 2}
    following = np.cross(goal, complex_goal.imag / 1e-30)
    demanded[known] += rate_gain * (following + rates.min(axis=0)[:, None] * unit(error))
    length = np.linalg.norm(demanded, axis=1)
    limited = length > maximum
    assert 0 < limited.sum() < ROWS
    return Check(
        truth="rotation vectors by scipy, derivatives by complex steps",
        step=STEP,
        inputs=inputs,
        outputs={
            "angular_acceleration": demanded * np.minimum(1.0, maximum / length)[:, None],
            "direction_error": angle,
            "status": limited,
        },
        tolerances={"angular_acceleration": (1e-12, 0.0), "direction_error": (1e-12, 0.0), "status": (0.0, 0.0)},
        parameters={
            "rate_gain": rate_gain,
            "angle_gain": angle_gain,
            "braking_acceleration": braking,
            "maximum_rate": maximum_rate,
            "maximum_angular_acceleration": maximum,
        },
    )


TRUTHS = {"thrust_axis_control": thrust_axis_control}
