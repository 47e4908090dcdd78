"""Truth of the jet allocation in discrete levels: enumeration of all levels."""

import itertools

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.actuators.jets import ARM, AZIMUTH, TILT, attainable_part, jets
from tests.support.checks.check import STEP, Check, follow

ROWS, QUANTUM, LARGEST, DELAY = 49, 0.05, 0.16, 0.25


def jet_allocation_quantised():
    """Search all 4^8 levels without torque for the nearest force of least sum, scaled by a linear programme before.

    Commands turn with the body, last four rows or eight; one takes the place of another that still waits, one lasts no
    time, which counts as no number, some have a torque.
    """
    levels = np.array(list(itertools.product(range(int(LARGEST / QUANTUM) + 1), repeat=8)))
    matrix = jets()
    levels = levels[(np.abs(levels @ matrix[3:].T) < 1e-9).all(axis=1)]
    levels = levels[np.argsort(levels.sum(axis=1), kind="stable")]
    forces = QUANTUM * levels @ matrix[:3].T
    commands = np.array([0, 4, 8, 16, 17, 22, 26, 30, 34, 38, 42, 46])
    random = np.random.default_rng(295)
    force, torque = 0.12 * random.normal(size=(len(commands), 3)), np.zeros((len(commands), 3))
    force[[1, 4, 6, 7]] *= 5.0
    torque[[5, 7], 2] = 0.01, 0.02
    attitude = Rotation.from_rotvec(random.normal(size=(len(commands), 3)))
    period = STEP * np.array([4, 4, 8, 8, 4, 4, 4, 4, 4, 0, 4, 4])
    thrusts, statuses, owed = np.zeros((len(commands), 8)), np.full(len(commands), 3), np.zeros(3)
    for k in np.nonzero(period)[0]:
        desired = attitude[k].inv().apply(force[k] + owed / period[k])
        part = attainable_part(matrix, np.append(desired, np.zeros(3)), QUANTUM * levels.max())
        attained = part * desired
        distance = np.linalg.norm(forces - attained, axis=1)
        best, *others = np.nonzero(distance < distance.min() + 1e-9)[0]
        assert all(levels[other].sum() > levels[best].sum() for other in others)
        owed = period[k] * attitude[k].apply(attained - forces[best])
        thrusts[k] = QUANTUM * levels[best]
        statuses[k] = 1 if part < 1.0 - 1e-9 else 2 * torque[k].any()
    assert set(statuses) == {0, 1, 2, 3}
    count = 1 + np.searchsorted(commands, np.arange(ROWS), side="right")
    newest = follow(count) - 2  # at the end of each row's step
    received = np.searchsorted(newest, np.arange(len(commands)))
    due = received + np.ceil(DELAY * period / STEP).astype(int)
    in_time = due <= np.append(received[1:], ROWS)
    assert 0 < in_time.sum() < len(commands)
    jet_thrust = np.zeros((ROWS, 8))
    for row, thrust in zip(due[in_time], thrusts[in_time], strict=True):
        jet_thrust[row:] = thrust
    applied = jet_thrust @ matrix.T
    sent = count - 2
    return Check(
        truth="search through all levels, a linear programme",
        step=STEP,
        inputs={
            "force_command": force[sent],
            "torque_command": torque[sent],
            "quaternion": attitude.as_quat(scalar_first=True)[sent],
            "command_count": count,
            "translation_period": period[sent],
        },
        outputs={
            "jet_thrust": jet_thrust,
            "allocated_force": applied[:, :3],
            "allocated_torque": applied[:, 3:],
            "status": statuses[newest],
        },
        tolerances=dict.fromkeys(("jet_thrust", "allocated_force", "allocated_torque"), (1e-13, 0.0))
        | {"status": (0.0, 0.0)},
        parameters={
            "jet_tilt": TILT,
            "jet_azimuth": AZIMUTH,
            "jet_arm": ARM,
            "maximum_thrust": LARGEST,
            "thrust_quantum": QUANTUM,
            "delay_fraction": DELAY,
        },
    )


TRUTHS = {"jet_allocation_quantised": jet_allocation_quantised}
