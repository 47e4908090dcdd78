"""Truths of actuators: linear programmes and least squares. Direct outputs follow one row later."""

import numpy as np
from scipy.optimize import linprog

from tests.support.checks.check import STEP, Check, follow

TILT, AZIMUTH, ARM, LARGEST = 0.6, 0.8, np.array([0.6, 0.5, 0.9]), 1.2
CORNERS = np.array([[x, y, z] for x in (1.0, -1.0) for y in (1.0, -1.0) for z in (1.0, -1.0)])


def jets():
    """B: force and torque of 1 N of each jet, whose nozzle points outwards."""
    nozzle = np.array([np.cos(TILT) * np.cos(AZIMUTH), np.cos(TILT) * np.sin(AZIMUTH), np.sin(TILT)])
    nozzles = CORNERS * nozzle
    return -np.concatenate([nozzles.T, np.cross(CORNERS * ARM, nozzles).T])


def allocate_jets(allocate):
    """Wrenches of all sizes at a body that is not turned, each new at its row and put out at once."""
    rows = 25
    wrench = np.random.default_rng(283).normal(0.0, 1.0, (rows, 6)) * np.array([0.7, 0.7, 0.7, 0.06, 0.06, 0.06])
    thrust, scaled = map(np.array, zip(*(allocate(row) for row in wrench), strict=True))
    assert 0 < scaled.sum() < rows
    given = thrust @ jets().T
    return Check(
        truth="linear algebra and optimisation",
        step=STEP,
        inputs={
            "force_command": wrench[:, :3],
            "torque_command": wrench[:, 3:],
            "quaternion": np.tile([1.0, 0.0, 0.0, 0.0], (rows, 1)),
            "command_count": 1 + np.arange(rows),
            "translation_period": np.full(rows, STEP),
        },
        outputs={
            "jet_thrust": follow(thrust),
            "allocated_force": follow(given[:, :3]),
            "allocated_torque": follow(given[:, 3:]),
            "status": follow(scaled),
        },
        tolerances=dict.fromkeys(("jet_thrust", "allocated_force", "allocated_torque"), (1e-9, 0.0))
        | {"status": (0.0, 0.0)},
        parameters={
            "jet_tilt": TILT,
            "jet_azimuth": AZIMUTH,
            "jet_arm": ARM,
            "maximum_thrust": LARGEST,
            "delay_fraction": 0.0,
        },
    )


def jet_allocation_pseudo_inverse():
    """The pseudo-inverse of numpy, lifted to 0 and scaled where the largest thrust is beyond the limit."""

    def allocate(wrench):
        thrust = np.linalg.pinv(jets()) @ wrench
        thrust = thrust - thrust.min()
        return thrust * min(1.0, LARGEST / thrust.max()), thrust.max() > LARGEST

    return allocate_jets(allocate)


def jet_allocation_least_propellant():
    """Two linear programmes of HiGHS: the largest attainable part of the wrench, and the least thrust that gives it."""
    matrix = jets()

    def allocate(wrench):
        largest = linprog(
            -np.eye(9)[8],
            A_eq=np.column_stack([matrix, -wrench]),
            b_eq=np.zeros(6),
            bounds=[(0.0, LARGEST)] * 8 + [(0, 1)],
        )
        part = largest.x[8]
        optimum = linprog(np.ones(8), A_eq=matrix, b_eq=part * wrench, bounds=[(0.0, None)] * 8)
        assert optimum.x.max() <= LARGEST + 1e-9
        return optimum.x, part < 1.0 - 1e-9

    return allocate_jets(allocate)


def gyro_steering_robust():
    """The smallest rates that give the torque, by least squares, scaled together where one is beyond the limit."""
    rows, momentum, limit = 25, 30.0, 0.6
    random = np.random.default_rng(284)
    angles = np.array([1.0, -1.0, 1.1, -0.9]) + random.normal(0.0, 0.1, (rows, 4))
    torque = random.normal(0.0, 10.0, (rows, 3))
    rates, measures, limited = [], [], []
    for (b1, b2, b3, b4), wanted in zip(angles, torque, strict=True):
        # derivatives of h = (C1 + C2 + C3 + C4, S1 + S2, S3 + S4)
        jacobian = np.array(
            [
                -np.sin([b1, b2, b3, b4]),
                [np.cos(b1), np.cos(b2), 0.0, 0.0],
                [0.0, 0.0, np.cos(b3), np.cos(b4)],
            ]
        )
        rate = np.linalg.lstsq(jacobian, -wanted / momentum, rcond=None)[0]
        rates.append(rate / max(1.0, np.abs(rate).max() / limit))
        limited.append(np.abs(rate).max() > limit)
        measures.append(np.prod(np.linalg.svd(jacobian, compute_uv=False)))
    assert min(measures) > 0.5
    assert 0 < sum(limited) < rows
    return Check(
        truth="least squares by numpy",
        step=STEP,
        inputs={"torque_command": torque, "gimbal_angles": angles},
        outputs={
            "gimbal_rates": follow(np.array(rates)),
            "singularity": follow(np.array(measures)),
            "status": follow(2 * np.array(limited)),
        },
        tolerances={"gimbal_rates": (1e-12, 0.0), "singularity": (1e-12, 0.0), "status": (0.0, 0.0)},
        parameters={"rotor_momentum": momentum, "gimbal_rate_limit": limit, "sample_period": STEP},
    )


def pulse_allocation():
    """Demands that are too short, long enough, carried over and beyond the tick: a pulse takes all that is carried."""
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


TRUTHS = {
    "pulse_allocation": pulse_allocation,
    "gyro_steering_robust": gyro_steering_robust,
    "jet_allocation_least_propellant": jet_allocation_least_propellant,
    "jet_allocation_pseudo_inverse": jet_allocation_pseudo_inverse,
}
