"""Truth of relays with hysteresis."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow


def standard_control():
    """Derive the hysteresis from the whole record: a relay is closed if no signal since the last beyond y was within
    y/2.

    Signals lie a thousandth off their thresholds, on either side; one error of bank in four is beyond its limit.
    """
    limit, lead, thresholds, level, rows = 0.3, 1.5, np.array([0.1, 0.02, 0.015]), np.array([90.0, 70.0, 80.0]), 65
    random = np.random.default_rng(292)
    x = thresholds * random.choice([-1.0, 1.0], (rows, 3)) * random.choice([0.1, 0.499, 0.501, 0.999, 1.001], (rows, 3))
    error = np.where(
        np.arange(rows) % 4 > 0, random.uniform(-limit, limit, rows), limit * (-1.0) ** (np.arange(rows) // 4)
    )
    w = np.column_stack([(x[:, 0] - error) / lead, x[:, 1:]])
    target = np.where(np.arange(rows) < 20, 0.2, 0.2 + 4.0 * np.pi)  # two turns of the same bank
    inputs = {
        "measured_bank": 0.2 + np.where(np.arange(rows) % 4 > 0, error, 1.5 * error),
        "measured_angular_velocity": w,
        "target_bank": target,
    }
    beyond = np.abs(x) > thresholds
    latest = np.maximum.accumulate(np.where(beyond, np.arange(rows)[:, None], -1))
    torque = np.zeros((rows, 3))
    for row, axis in zip(*np.nonzero(latest >= 0), strict=True):
        since = x[latest[row, axis] : row + 1, axis]
        if (since * np.sign(since[0]) >= thresholds[axis] / 2.0).all():
            torque[row, axis] = -np.sign(since[0]) * level[axis]
    latched = (torque != 0.0) & ~beyond
    assert latched.any(axis=0).all()
    assert ((torque > 0.0).any(axis=0) & (torque < 0.0).any(axis=0) & (torque == 0.0).any(axis=0)).all()
    return Check(
        truth="search through the record",
        step=STEP,
        inputs=inputs,
        outputs={"torque_command": follow(torque), "status": np.zeros(rows)},
        tolerances={"torque_command": (0.0, 0.0), "status": (0.0, 0.0)},
        parameters={
            "sample_period": STEP,
            "bank_limit": limit,
            "lead_time": lead,
            "thresholds": thresholds,
            "jet_torque": level,
        },
    )


TRUTHS = {"standard_control": standard_control}
