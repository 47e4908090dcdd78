"""Truth of pulse allocation: sums that are exact in binary."""

import numpy as np

from tests.support.checks.check import STEP, Check, follow


def pulse_allocation():
    """Check demands that are too short, long enough, carried over and beyond the tick: a pulse
    takes all that is carried."""
    rows, level, shortest = 41, np.array([2.0, 4.0, 8.0]), 0.03125
    time = np.random.default_rng(285).normal(0.0, 0.06, (rows, 3))
    demanded = np.round(time * 1024.0) / 1024.0  # s, exact in binary
    pulses, rests, carried = [], [], np.zeros(3)
    for tick in follow(demanded):  # a tick at the start, and one at the end of each step
        carried = carried + tick
        fires = np.abs(carried) >= shortest
        pulses.append(np.where(fires, carried.clip(-STEP, STEP), 0.0))
        carried = np.where(fires, 0.0, carried)
        rests.append(carried)
    lengths = np.array(pulses)
    beyond = (np.abs(lengths) == STEP).any(axis=1)
    assert 0 < beyond.sum() < rows
    return Check(
        truth="sums that are exact in binary",
        step=STEP,
        inputs={"torque_command": demanded * level / STEP},
        outputs={
            "pulse_lengths": lengths,
            "pulse_count": 1 + np.arange(rows),
            "mean_torque": np.zeros((rows, 3)),
            "remainder": np.array(rests),
            "status": beyond,
        },
        tolerances=dict.fromkeys(("pulse_lengths", "pulse_count", "mean_torque", "remainder", "status"), (0.0, 0.0)),
        parameters={"jet_torque": level, "shortest_pulse": shortest, "sample_period": STEP},
    )


TRUTHS = {"pulse_allocation": pulse_allocation}
