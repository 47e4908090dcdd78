"""Truth of a satellite's modes: durations counted in samples, for a record with prescribed transitions."""

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.check import Check, follow

CYCLE, ROWS = 0.25, 72
DETUMBLE, SUN, NADIR = range(3)
CALM, LOST, SUN_ERROR = 0.01, 0.05, 0.2
SETTLE, LOST_FOR, BLIND = 4, 2, 6  # samples
UNLOAD_TORQUERS, BRAKE = 2, 1  # of magnetic_mode
TRANSITIONS = {11: SUN, 20: NADIR, 35: SUN, 40: NADIR, 49: DETUMBLE, 59: SUN, 67: DETUMBLE}  # row: mode


def record():
    """Return size of the rate, angle of the panel from the Sun, knowledge of the attitude; all as of a row's cycle."""
    rate = np.full(ROWS, 0.3)
    rate[3:6] = 0.99 * CALM  # too short
    rate[7:] = 0.9 * CALM
    rate[25] = rate[30] = 1.1 * LOST  # a single sample each
    rate[47:50] = 1.01 * LOST
    rate[50:55] = 1.01 * CALM
    rate[62:64] = 1.05 * CALM  # not calm, not lost
    rate[64], rate[65:] = 0.99 * LOST, 1.01 * LOST
    angle = np.full(ROWS, 1.01 * SUN_ERROR)
    angle[14:17] = 0.5 * SUN_ERROR  # while no attitude is known, and then too short
    angle[17:] = 0.99 * SUN_ERROR
    known = np.zeros(ROWS, dtype=bool)
    known[16:29] = known[36:56] = True
    return rate, angle, known


def aocs_modes():
    """Check every transition but from SUN for want of an attitude, which is none."""
    random = np.random.default_rng(62)
    rate, angle, known = record()
    panel = np.array([0.36, -0.48, 0.8])
    attitude = Rotation.random(ROWS, random)
    axis = np.cross(panel, random.normal(size=(ROWS, 3)))
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    sun = attitude.apply(Rotation.from_rotvec(angle[:, None] * axis).apply(panel))
    direction = random.normal(size=(ROWS, 3))
    omega = rate[:, None] * direction / np.linalg.norm(direction, axis=1)[:, None]
    quaternion = random.choice([-2.0, 1.0], (ROWS, 1)) * attitude.as_quat(scalar_first=True)
    sampled = follow(np.arange(ROWS))
    mode, begun, settled, fast, blind, rows = DETUMBLE, 0, 0, 0, 0, []
    for row, n in enumerate(sampled):
        ready = rate[n] < CALM if mode == DETUMBLE else known[n] and angle[n] < SUN_ERROR
        settled = settled + 1 if ready and row > 0 else 0
        fast = fast + 1 if rate[n] > LOST and row > 0 else 0
        blind = blind + 1 if not known[n] and row > 0 else 0
        after = mode
        if mode == DETUMBLE:
            after = SUN if settled >= SETTLE else mode
        elif fast >= LOST_FOR:
            after = DETUMBLE
        elif mode == SUN:
            after = NADIR if settled >= SETTLE else mode
        elif blind >= BLIND:
            after = SUN
        if after != mode:
            mode, begun, settled = after, row, 0
        rows.append([mode, CYCLE * (row - begun)])
    mode, time = map(np.array, zip(*rows, strict=True))
    changes = 1 + np.flatnonzero(np.diff(mode))
    assert dict(zip(changes.tolist(), mode[changes].tolist(), strict=True)) == TRANSITIONS
    return Check(
        truth="spells counted in samples, transitions written beforehand; attitudes by scipy",
        step=CYCLE,
        inputs={
            "estimated_angular_velocity": omega,
            "estimated_quaternion": quaternion,
            "sun_direction": sun,
            "attitude_known": known,
        },
        outputs={
            "mode": mode,
            "pointing_mode": np.where(mode == NADIR, 0, 1),
            "magnetic_mode": np.where(mode == DETUMBLE, BRAKE, UNLOAD_TORQUERS),
            "wheels_on": mode != DETUMBLE,
            "time_in_mode": time,
            "status": np.zeros(ROWS),
        },
        tolerances=dict.fromkeys(
            ("mode", "pointing_mode", "magnetic_mode", "wheels_on", "time_in_mode", "status"), (0.0, 0.0)
        ),
        parameters={
            "calm_rate": CALM,
            "lost_rate": LOST,
            "sun_error": SUN_ERROR,
            "panel_normal": panel,
            "settle_time": SETTLE * CYCLE,
            "lost_time": LOST_FOR * CYCLE,
            "blind_time": BLIND * CYCLE,
            "sample_period": CYCLE,
        },
    )


TRUTHS = {"aocs_modes": aocs_modes}
