"""Truth of magnetic control: the complete record by numpy, one magnetometer sample after another."""

import numpy as np

from tests.support.checks.check import Check, follow

CYCLE, ROWS = 0.25, 57
OFF, DETUMBLE, UNLOAD = range(3)
GOOD, LIMITED, WEAK_FIELD, NOT_FINITE = range(4)
WEAK, WRONG_FIELD, WRONG_MOMENTUM = 5, 7, 11  # samples of the magnetometer


def dipole_of(mode, field, before, momentum, parameters):
    """Return the dipole without a limit; ``before`` is the field of the sample before, None without one."""
    square = field @ field
    if mode == DETUMBLE and before is not None:
        return -parameters["detumble_gain"] / square * (field - before) / parameters["field_period"]
    if mode == UNLOAD:
        return parameters["unload_gain"] / square * np.cross(momentum - parameters["target_momentum"], field)
    return np.zeros(3)


def magnetic_control():
    """Check all modes, changes of them between samples; a weak field, a field and a momentum that are not finite.

    A sample every second, one of them late by a cycle; the dipole acts for 0.75 s of each.
    """
    random = np.random.default_rng(61)
    parameters = {
        "detumble_gain": 0.03,
        "unload_gain": 0.004,
        "target_momentum": np.array([1e-3, -2e-3, 5e-4]),
        "dipole_limit": 4.0,
        "field_period": 1.0,
        "active_fraction": 0.75,
    }
    count = 3 + np.maximum(np.arange(ROWS) // 4, (np.arange(ROWS) + 3) // 4 - (np.arange(ROWS) > 16))
    new = np.diff(count, prepend=0) > 0
    number = np.cumsum(new) - 1
    mode = np.repeat([DETUMBLE, UNLOAD, OFF, UNLOAD, DETUMBLE, UNLOAD], [14, 9, 6, 13, 9, 6])
    field = (3e-5 * np.array([0.5, -0.3, 0.8]) + random.normal(0.0, 4e-6, (number[-1] + 1, 3)))[number]
    field += np.where(new, 0.0, 1e-6)[:, None]  # between samples: it must not count
    field[number == WEAK] *= 0.02
    momentum = random.normal(0.0, 0.02, (ROWS, 3))
    field[new & (number == WRONG_FIELD), 1] = np.nan
    momentum[new & (number == WRONG_MOMENTUM), 2] = np.nan
    sampled = follow(np.arange(ROWS))
    before, sample, rows = None, None, []
    for row, source in enumerate(sampled):
        if row == 0 or count[source] != count[sampled[row - 1]]:
            sample, begun, dipole, status = field[source], row, np.zeros(3), GOOD
            if not np.isfinite([sample, momentum[source]]).all():
                status, before = NOT_FINITE, None
            else:
                if np.linalg.norm(sample) < 1e-6:
                    status = WEAK_FIELD
                else:
                    dipole = dipole_of(mode[source], sample, before, momentum[source], parameters)
                size = np.abs(dipole).max()
                if size > parameters["dipole_limit"]:
                    dipole, status = parameters["dipole_limit"] * (dipole / size), LIMITED
                before = sample
        acts = row - begun < 3 and mode[source] != OFF
        torque = np.cross(sample, dipole) if acts and mode[source] == UNLOAD and dipole.any() else np.zeros(3)
        rows.append([np.where(acts, dipole, 0.0), torque, status])
    dipole, torque, status = map(np.array, zip(*rows, strict=True))
    assert set(status) == {GOOD, LIMITED, WEAK_FIELD, NOT_FINITE}
    return Check(
        truth="the two laws by numpy, sample by sample",
        step=CYCLE,
        inputs={"mode": mode, "measured_field": field, "field_count": count, "wheel_momentum": momentum},
        outputs={"dipole": dipole, "feedforward_torque": torque, "status": status},
        tolerances={"dipole": (1e-14, 1e-13), "feedforward_torque": (1e-18, 1e-12), "status": (0.0, 0.0)},
        parameters={**parameters, "sample_period": CYCLE},
    )


TRUTHS = {"magnetic_control": magnetic_control}
