"""Truths of attitude navigation by star tracker and gyros: filterpy with all axes at once, rotations by scipy."""

import numpy as np
from filterpy.kalman import KalmanFilter
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.navigation.chains import NOT_FINITE, PHASES, ROWS, TIME, innovation_square

NO_RATE = 12  # row of a gyro sample that is not finite
SPIKE, NO_FIELD = 15, 25  # rows of a direction to the Sun that is far off, of a field that is not finite
STAR_TIME = np.maximum(TIME - 0.6 * STEP, 0.0)  # of star samples, taken in at the next row
RATE = np.array([0.2, -0.3, 0.25])


def cross_matrix(v):
    return np.cross(np.eye(3), v)


def true_attitude(time):
    """Return the true attitude at times (s)."""
    return Rotation.from_rotvec([0.3, -0.2, 0.9]) * Rotation.from_rotvec(time[:, None] * RATE)


def motion():
    """Return attitude, angular velocity, samples of both sensors and their counts."""
    random = np.random.default_rng(47)
    rate = np.tile(RATE, (ROWS, 1))
    stars = true_attitude(STAR_TIME) * Rotation.from_rotvec(random.normal(0.0, 2e-3, (ROWS, 3)))
    stars = stars.as_quat(scalar_first=True) * random.choice([-1.0, 1.0], (ROWS, 1))
    gyros = rate + random.normal(0.0, 1e-3, (ROWS, 3)) + 0.01 * np.sin(0.5 * TIME[:, None] + PHASES)
    quaternion = true_attitude(TIME).as_quat(scalar_first=True)
    return quaternion, rate, stars, gyros, 1 + np.arange(ROWS) // 4, 1 + np.arange(ROWS) // 2


def check_navigation(truth, outputs, stars, gyros, parameters, tolerances, **inputs):
    quaternion, rate, _, _, star_count, gyro_count = motion()
    return Check(
        truth=truth,
        step=STEP,
        inputs={
            "quaternion": quaternion,
            "angular_velocity": rate,
            "measured_quaternion": stars,
            "star_count": star_count,
            "measured_angular_velocity": gyros,
            "gyro_count": gyro_count,
            **inputs,
        },
        outputs=outputs,
        tolerances=tolerances,
        parameters={**parameters, "sample_period": STEP},
    )


def directions():
    """Return inertial directions of Sun and field, samples of both in body axes and their
    counts; one far off, one missing."""
    random = np.random.default_rng(53)
    to_body = true_attitude(TIME + STEP).inv()
    sun, field = np.tile([0.6, -0.5, 0.7], (ROWS, 1)), 3e-5 * np.sin(0.1 * TIME[:, None] + np.array([0.5, 2.0, 4.0]))
    measured = to_body.apply(sun) + random.normal(0.0, 5e-3, (ROWS, 3)), to_body.apply(field)
    measured[0][SPIKE] *= [1.0, -1.0, 1.0]
    measured[1][NO_FIELD, 1] = np.nan
    return (sun, field), measured, (1 + np.arange(ROWS) // 3, 1 + np.arange(ROWS) // 5)


def attitude_navigation_filter():
    """Check a turn with errors far larger than real ones; late star samples of either sign, directions, a gate.

    Q is that of Crassidis and Junkins, in which the body does not turn.
    """
    _, _, stars, gyros, count, gyro_count = motion()
    references, measured, counts = directions()
    sigma, roll, walk, drift, first, widths, gate = 2e-3, 5e-3, 4e-4, 3e-3, 0.02, (8e-3, 3e-2), 16.27
    boresight = np.array([2.0, -1.0, 2.0]) / 3.0
    finite_stars, finite_gyros = stars.copy(), gyros.copy()
    stars[NOT_FINITE, 2] = np.nan
    gyros[NO_RATE, 1] = np.nan
    new, fresh, *fresh_directions = (
        np.diff(number, prepend=number[0] - start) > 0
        for number, start in zip((count, gyro_count, *counts), (1, 1, 0, 0), strict=True)
    )
    assert new[NOT_FINITE]
    assert fresh[NO_RATE]
    assert fresh_directions[0][SPIKE]
    assert fresh_directions[1][NO_FIELD]
    kalman = KalmanFilter(dim_x=6, dim_z=3)
    kalman.x = np.zeros(6)
    kalman.P = np.diag(np.square([roll] * 3 + [first] * 3))
    angle, both, bias_noise = walk**2 * STEP + drift**2 * STEP**3 / 3.0, -(drift**2) * STEP**2 / 2.0, drift**2 * STEP
    noise = np.kron([[angle, both], [both, bias_noise]], np.eye(3))
    attitude, bias, rate = Rotation.from_quat(stars[0], scalar_first=True), np.zeros(3), gyros[0]
    quaternion, square, rejected, rows, turns = stars[0], 0.0, 0, [], []

    def note(status):
        sigmas = np.sqrt(np.diag(kalman.P))
        rows.append([quaternion, rate - bias, bias, sigmas[:3], sigmas[3:], square, rejected, status])

    def take(z, h, r):
        """Correct attitude and bias with a sample; return True if it is within the gate."""
        nonlocal attitude, bias, square, rejected
        if z @ np.linalg.solve(h @ kalman.P @ h.T + r, z) > gate:
            rejected += 1
            return False
        kalman.update(z, R=r, H=h)
        attitude, bias = attitude * Rotation.from_rotvec(kalman.x[:3]), bias + kalman.x[3:]
        kalman.x = np.zeros(6)
        square = innovation_square(kalman)
        return True

    note(0)
    for row in range(ROWS - 1):
        status, before = 0, rate
        if row == NO_RATE:
            status = 1
        elif fresh[row]:
            rate = finite_gyros[row]
        mean = 0.5 * (before + rate) - bias
        turns.append(mean)
        attitude = attitude * Rotation.from_rotvec(STEP * mean)
        generator = np.block([[-cross_matrix(mean), -np.eye(3)], [np.zeros((3, 6))]])
        kalman.predict(F=expm(STEP * generator), Q=noise)
        if new[row] and row == NOT_FINITE:
            status = 2
        elif new[row] and row > 0:
            star = Rotation.from_quat(finite_stars[row], scalar_first=True)
            for n, turn in enumerate(turns):
                star = star * Rotation.from_rotvec(np.clip((n + 1) * STEP - STAR_TIME[row], 0.0, STEP) * turn)
            along = np.outer(boresight, boresight)
            r = sigma**2 * np.eye(3) + (roll**2 - sigma**2) * along
            status = status if take((attitude.inv() * star).as_rotvec(), np.eye(3, 6), r) else 4
        for k in range(2):
            if fresh_directions[k][row] and row == NO_FIELD and k == 1:
                status = 7
            elif fresh_directions[k][row]:
                body = attitude.inv().apply(references[k][row] / np.linalg.norm(references[k][row]))
                z = measured[k][row] / np.linalg.norm(measured[k][row]) - body
                h = np.hstack([cross_matrix(body), np.zeros((3, 3))])
                status = status if take(z, h, widths[k] ** 2 * np.eye(3)) else 4
        ahead = attitude.as_quat(scalar_first=True)
        quaternion = ahead * np.sign(ahead @ quaternion)
        note(status)
    names = (
        "estimated_quaternion",
        "estimated_angular_velocity",
        "estimated_bias",
        "attitude_sigma",
        "bias_sigma",
        "innovation_square",
        "rejected",
        "status",
    )
    outputs = {name: np.array(values) for name, values in zip(names, zip(*rows, strict=True), strict=True)}
    assert set(outputs["status"]) == {0, 1, 2, 4, 7}
    return check_navigation(
        "filterpy, three components at once; transition by matrix exponential, rotations by scipy",
        outputs,
        stars,
        gyros,
        {
            "star_sigma": sigma,
            "roll_sigma": roll,
            "boresight": boresight,
            "gyro_random_walk": walk,
            "bias_random_walk": drift,
            "first_bias_sigma": first,
            "sun_sigma": widths[0],
            "field_sigma": widths[1],
            "gate": gate,
        },
        {
            **dict.fromkeys(outputs, (1e-13, 1e-11)),
            "innovation_square": (1e-12, 1e-9),
            "rejected": (0.0, 0.0),
            "status": (0.0, 0.0),
        },
        star_time=STAR_TIME,
        **dict(zip(("sun_direction", "magnetic_field"), references, strict=True)),
        **dict(zip(("measured_sun", "measured_field"), measured, strict=True)),
        **dict(zip(("sun_count", "field_count"), counts, strict=True)),
    )


def attitude_navigation_ideal():
    """Return the truth."""
    quaternion, rate, stars, gyros, _, _ = motion()
    outputs = {"estimated_quaternion": follow(quaternion), "estimated_angular_velocity": follow(rate)}
    tolerances = dict.fromkeys(outputs, (0.0, 0.0))
    return check_navigation("the true motion", outputs, stars, gyros, {}, tolerances)


def pointing_monitor():
    """Compute rotation vectors by scipy; two spells of pointing, the second of them long enough."""
    target = Rotation.from_rotvec([0.4, -0.9, 0.7])
    off = 0.02 * np.exp(-0.6 * TIME) + np.where((TIME > 2.2) & (TIME < 2.7), 0.02, 0.0)
    true = target * Rotation.from_rotvec(np.outer(off, [0.6, 0.0, 0.8]))
    reference = target * Rotation.from_rotvec(np.outer(0.5 * off, [0.0, 1.0, 0.0]))
    estimate = true * Rotation.from_rotvec(0.3 * np.sin(TIME[:, None] + PHASES))
    boresight = np.array([0.6, -1.2, 2.0])
    aims = zip(true.apply(boresight), reference.apply(boresight), strict=True)
    cone = np.array([Rotation.align_vectors([aim], [desired])[0].magnitude() for aim, desired in aims])
    rate = np.outer(np.where(TIME < 1.7, 0.01, 1e-4), [0.0, 0.6, -0.8])
    angle_limit, rate_limit, hold = 0.01, 1e-3, 1.0
    within = (off <= angle_limit) & (np.linalg.norm(rate, axis=1) <= rate_limit)
    observed = follow(np.arange(ROWS))
    since, settling, finished = 0.0, [], []
    for row in range(ROWS):
        before = row > 0 and within[observed[row - 1]]
        if not (within[observed[row]] and before):
            since = TIME[row]
        settling.append(since)
        finished.append(bool(finished and finished[-1]) or (within[observed[row]] and TIME[row] - since >= hold))
    assert np.unique(settling).size > 3
    assert finished[-1]
    assert not finished[0]
    return Check(
        truth="rotations by scipy",
        step=STEP,
        inputs={
            "quaternion": true.as_quat(scalar_first=True),
            "angular_velocity": rate,
            "reference_quaternion": reference.as_quat(scalar_first=True),
            "estimated_quaternion": -estimate.as_quat(scalar_first=True),
        },
        outputs={
            "attitude_error": (reference.inv() * true).as_rotvec()[observed],
            "pointing_error": off[observed],
            "half_cone": cone[observed],
            "knowledge_error": (true.inv() * estimate).as_rotvec()[observed],
            "rate": np.linalg.norm(rate, axis=1)[observed],
            "settling_time": np.array(settling),
            "finished": np.array(finished),
        },
        tolerances={
            "attitude_error": (1e-14, 0.0),
            "pointing_error": (1e-14, 0.0),
            "half_cone": (1e-14, 0.0),
            "knowledge_error": (1e-14, 0.0),
            "rate": (1e-15, 0.0),
            "settling_time": (1e-12, 0.0),
            "finished": (0.0, 0.0),
        },
        parameters={
            "target_quaternion": target.as_quat(scalar_first=True),
            "angle_limit": angle_limit,
            "rate_limit": rate_limit,
            "hold_time": hold,
            "boresight": boresight,
        },
    )


TRUTHS = {
    "attitude_navigation_filter": attitude_navigation_filter,
    "attitude_navigation_ideal": attitude_navigation_ideal,
    "pointing_monitor": pointing_monitor,
}
