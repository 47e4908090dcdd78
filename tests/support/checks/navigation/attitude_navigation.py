"""Truths of attitude by star tracker and gyros: filterpy with all axes at once, rotations by scipy."""

import numpy as np
from filterpy.kalman import KalmanFilter
from scipy.linalg import expm
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.navigation.chains import NOT_FINITE, PHASES, ROWS, TIME, innovation_square

NO_RATE = 12  # row of a gyro sample that is not finite


def cross_matrix(v):
    return np.cross(np.eye(3), v)


def motion():
    """Attitude, angular velocity, samples of both sensors and their counts."""
    random = np.random.default_rng(47)
    rate = np.tile([0.2, -0.3, 0.25], (ROWS, 1))
    attitude = Rotation.from_rotvec([0.3, -0.2, 0.9]) * Rotation.from_rotvec(TIME[:, None] * rate)
    stars = (attitude * Rotation.from_rotvec(random.normal(0.0, 2e-3, (ROWS, 3)))).as_quat(scalar_first=True)
    stars *= random.choice([-1.0, 1.0], (ROWS, 1))
    gyros = rate + random.normal(0.0, 1e-3, (ROWS, 3)) + 0.01 * np.sin(0.5 * TIME[:, None] + PHASES)
    return attitude.as_quat(scalar_first=True), rate, stars, gyros, 1 + np.arange(ROWS) // 4, 1 + np.arange(ROWS) // 2


def check_navigation(truth, outputs, stars, gyros, parameters, tolerances):
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
        },
        outputs=outputs,
        tolerances=tolerances,
        parameters={**parameters, "sample_period": STEP},
    )


def attitude_navigation_filter():
    """Turning with errors far larger than real ones; samples of either sign, one of each sensor not finite.

    Q is that of Crassidis and Junkins, in which the body does not turn.
    """
    _, _, stars, gyros, count, gyro_count = motion()
    sigma, walk, drift, first = 2e-3, 4e-4, 3e-3, 0.02
    finite_stars, finite_gyros = stars.copy(), gyros.copy()
    stars[NOT_FINITE, 2] = np.nan
    gyros[NO_RATE, 1] = np.nan
    new = np.diff(count, prepend=0) > 0
    fresh = np.diff(gyro_count, prepend=0) > 0
    assert new[NOT_FINITE]
    assert fresh[NO_RATE]
    kalman = KalmanFilter(dim_x=6, dim_z=3)
    kalman.x = np.zeros(6)
    kalman.P = np.diag(np.square([sigma] * 3 + [first] * 3))
    kalman.H = np.eye(3, 6)
    kalman.R = sigma**2 * np.eye(3)
    angle, both, bias_noise = walk**2 * STEP + drift**2 * STEP**3 / 3.0, -(drift**2) * STEP**2 / 2.0, drift**2 * STEP
    noise = np.kron([[angle, both], [both, bias_noise]], np.eye(3))
    attitude, bias, rate = Rotation.from_quat(stars[0], scalar_first=True), np.zeros(3), gyros[0]
    quaternion, square, rows = stars[0], 0.0, []

    def note(status):
        sigmas = np.sqrt(np.diag(kalman.P))
        rows.append([quaternion, rate - bias, bias, sigmas[:3], sigmas[3:], square, status])

    note(0)
    for row in range(ROWS - 1):
        status, before = 0, rate
        if row == NO_RATE:
            status = 1
        elif fresh[row]:
            rate = finite_gyros[row]
        mean = 0.5 * (before + rate) - bias
        attitude = attitude * Rotation.from_rotvec(STEP * mean)
        generator = np.block([[-cross_matrix(mean), -np.eye(3)], [np.zeros((3, 6))]])
        kalman.predict(F=expm(STEP * generator), Q=noise)
        if new[row] and row == NOT_FINITE:
            status = 2
        elif new[row] and row > 0:
            kalman.update((attitude.inv() * Rotation.from_quat(finite_stars[row], scalar_first=True)).as_rotvec())
            attitude, bias = attitude * Rotation.from_rotvec(kalman.x[:3]), bias + kalman.x[3:]
            kalman.x = np.zeros(6)
            square = innovation_square(kalman)
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
        "status",
    )
    outputs = {name: np.array(values) for name, values in zip(names, zip(*rows, strict=True), strict=True)}
    assert set(outputs["status"]) == {0, 1, 2}
    return check_navigation(
        "filterpy, all axes at once; transition by matrix exponential, rotations by scipy",
        outputs,
        stars,
        gyros,
        {"star_sigma": sigma, "gyro_random_walk": walk, "bias_random_walk": drift, "first_bias_sigma": first},
        {
            **dict.fromkeys(outputs, (1e-13, 1e-11)),
            "innovation_square": (1e-12, 1e-9),
            "status": (0.0, 0.0),
        },
    )


def attitude_navigation_ideal():
    """The truth."""
    quaternion, rate, stars, gyros, _, _ = motion()
    outputs = {"estimated_quaternion": follow(quaternion), "estimated_angular_velocity": follow(rate)}
    tolerances = dict.fromkeys(outputs, (0.0, 0.0))
    return check_navigation("the true motion", outputs, stars, gyros, {}, tolerances)


def pointing_monitor():
    """Rotation vectors by scipy; two spells of pointing, the second of them long enough."""
    target = Rotation.from_rotvec([0.4, -0.9, 0.7])
    off = 0.02 * np.exp(-0.6 * TIME) + np.where((TIME > 2.2) & (TIME < 2.7), 0.02, 0.0)
    true = target * Rotation.from_rotvec(np.outer(off, [0.6, 0.0, 0.8]))
    reference = target * Rotation.from_rotvec(np.outer(0.5 * off, [0.0, 1.0, 0.0]))
    estimate = true * Rotation.from_rotvec(0.3 * np.sin(TIME[:, None] + PHASES))
    boresight = np.array([0.6, -1.2, 2.0])
    aims = zip(true.apply(boresight), reference.apply(boresight), strict=True)
    cone = np.array([Rotation.align_vectors([aim], [wanted])[0].magnitude() for aim, wanted in aims])
    rate = np.outer(np.where(TIME < 1.7, 0.01, 1e-4), [0.0, 0.6, -0.8])
    angle_limit, rate_limit, hold = 0.01, 1e-3, 1.0
    within = (off <= angle_limit) & (np.linalg.norm(rate, axis=1) <= rate_limit)
    seen = follow(np.arange(ROWS))
    since, settling, finished = 0.0, [], []
    for row in range(ROWS):
        before = row > 0 and within[seen[row - 1]]
        if not (within[seen[row]] and before):
            since = TIME[row]
        settling.append(since)
        finished.append(bool(finished and finished[-1]) or (within[seen[row]] and TIME[row] - since >= hold))
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
            "attitude_error": (reference.inv() * true).as_rotvec()[seen],
            "pointing_error": off[seen],
            "half_cone": cone[seen],
            "knowledge_error": (true.inv() * estimate).as_rotvec()[seen],
            "rate": np.linalg.norm(rate, axis=1)[seen],
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
