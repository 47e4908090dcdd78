"""Truths of jet allocations: linear programmes and the pseudo-inverse."""

import numpy as np
from scipy.optimize import linprog

from tests.support.checks.check import STEP, Check, follow

TILT, AZIMUTH, ARM, LARGEST = 0.6, 0.8, np.array([0.6, 0.5, 0.9]), 1.2
CORNERS = np.array([[x, y, z] for x in (1.0, -1.0) for y in (1.0, -1.0) for z in (1.0, -1.0)])


def jets():
    """Return B: force and torque of 1 N of each jet, whose nozzle points outwards."""
    nozzle = np.array([np.cos(TILT) * np.cos(AZIMUTH), np.cos(TILT) * np.sin(AZIMUTH), np.sin(TILT)])
    nozzles = CORNERS * nozzle
    return -np.concatenate([nozzles.T, np.cross(CORNERS * ARM, nozzles).T])


def attainable_part(matrix, wrench, largest):
    """Return the largest fraction of a wrench that jets of at most ``largest`` (N) give: a
    linear programme of HiGHS."""
    programme = linprog(
        -np.eye(9)[8],
        A_eq=np.column_stack([matrix, -wrench]),
        b_eq=np.zeros(6),
        bounds=[(0.0, largest)] * 8 + [(0.0, 1.0)],
    )
    return programme.x[8]


def allocate_jets(allocate):
    """Check wrenches of all sizes at a body that is not turned, each new at its row and put out at once."""
    rows = 25
    wrench = np.random.default_rng(283).normal(0.0, 1.0, (rows, 6)) * np.array([0.7, 0.7, 0.7, 0.06, 0.06, 0.06])
    thrust, scaled = map(np.array, zip(*(allocate(row) for row in wrench), strict=True))
    assert 0 < scaled.sum() < rows
    applied = thrust @ jets().T
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
            "allocated_force": follow(applied[:, :3]),
            "allocated_torque": follow(applied[:, 3:]),
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
    """Compute the pseudo-inverse by numpy, lifted to 0 and scaled where the largest thrust is beyond the limit."""

    def allocate(wrench):
        thrust = np.linalg.pinv(jets()) @ wrench
        thrust = thrust - thrust.min()
        return thrust * min(1.0, LARGEST / thrust.max()), thrust.max() > LARGEST

    return allocate_jets(allocate)


def jet_allocation_least_propellant():
    """Solve two linear programmes by HiGHS: the largest attainable fraction of the wrench, then
    the least thrust for it."""
    matrix = jets()

    def allocate(wrench):
        part = attainable_part(matrix, wrench, LARGEST)
        optimum = linprog(np.ones(8), A_eq=matrix, b_eq=part * wrench, bounds=[(0.0, None)] * 8)
        assert optimum.x.max() <= LARGEST + 1e-9
        return optimum.x, part < 1.0 - 1e-9

    return allocate_jets(allocate)


TRUTHS = {
    "jet_allocation_least_propellant": jet_allocation_least_propellant,
    "jet_allocation_pseudo_inverse": jet_allocation_pseudo_inverse,
}
