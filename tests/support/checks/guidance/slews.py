"""Truths of slews: the angle as a piecewise polynomial by scipy, rotations by scipy."""

import numpy as np
from scipy.interpolate import BPoly
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check

ROWS, BEGIN, RATE, ACCELERATION = 65, 0.55, 0.3, 0.2
START, TURN = Rotation.from_rotvec([0.3, -0.8, 0.5]), np.array([0.6, -0.5, 0.7])
ANGLE = float(np.linalg.norm(TURN))


def check_slew(truth, angle, duration):
    """Return the check of a slew; angle: a piecewise polynomial of the time since its begin."""
    time, later = STEP * np.arange(ROWS) - BEGIN, STEP * np.arange(1, ROWS + 1) - BEGIN

    def rate(at):
        inside = (at > 0.0) & (at < duration)
        return np.where(inside, angle.derivative()(np.clip(at, 0.0, duration)), 0.0)

    angles = angle(np.clip(time, 0.0, duration))
    axis = TURN / ANGLE
    attitude = START * Rotation.from_rotvec(np.outer(angles, axis))
    quaternion = attitude.as_quat(scalar_first=True)
    quaternion *= np.sign(quaternion @ START.as_quat(scalar_first=True))[:, None]
    target = -2.0 * (START * Rotation.from_rotvec(TURN)).as_quat(scalar_first=True)
    outputs = {
        "reference_quaternion": quaternion,
        "reference_angular_velocity": np.outer(rate(time), axis),
        "reference_angular_acceleration": np.outer((rate(later) - rate(time)) / STEP, axis),
        "slew_angle": np.full(ROWS, ANGLE),
        "duration": np.full(ROWS, duration),
        "phase": np.where(time < 0.0, 0, np.where(time < duration, 1, 2)),
    }
    return Check(
        truth=truth,
        step=STEP,
        inputs={"estimated_quaternion": np.tile(3.0 * START.as_quat(scalar_first=True), (ROWS, 1))},
        outputs=outputs,
        tolerances={**dict.fromkeys(outputs, (1e-13, 0.0)), "phase": (0.0, 0.0)},
        parameters={
            "target_quaternion": target,
            "slew_start": BEGIN,
            "rate_limit": RATE,
            "acceleration_limit": ACCELERATION,
            "sample_period": STEP,
        },
    )


def slew_bang_coast():
    """Interpolate the slew by its knees: the angle and the rate at each of them."""
    ramp = RATE / ACCELERATION
    duration = ANGLE / RATE + ramp
    assert duration > 2.0 * ramp
    knees = [0.0, ramp, duration - ramp, duration]
    gained = 0.5 * RATE * ramp
    ends = [[0.0, 0.0], [gained, RATE], [ANGLE - gained, RATE], [ANGLE, 0.0]]
    return check_slew("piecewise polynomial by its knees, by scipy", BPoly.from_derivatives(knees, ends), duration)


def slew_quintic():
    """Interpolate the slew by its ends, at rest without acceleration; its largest rate and acceleration by search."""
    unit_slew = BPoly.from_derivatives([0.0, 1.0], [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]])
    s = np.linspace(0.0, 1.0, 100001)
    fastest, hardest = unit_slew.derivative()(s).max(), unit_slew.derivative(2)(s).max()
    duration = max(fastest * ANGLE / RATE, np.sqrt(hardest * ANGLE / ACCELERATION))
    angle = BPoly.from_derivatives([0.0, duration], [[0.0, 0.0, 0.0], [ANGLE, 0.0, 0.0]])
    return check_slew("polynomial of fifth degree by its ends, by scipy", angle, duration)


def slew_step():
    """Turn at once."""
    angle = BPoly.from_derivatives([0.0, 1e-12], [[0.0], [ANGLE]])
    check = check_slew("rotations by scipy", angle, 0.0)
    time = STEP * np.arange(ROWS) - BEGIN
    jump = np.where(time[:, None] > 0.0, TURN, 0.0)
    quaternion = (START * Rotation.from_rotvec(jump)).as_quat(scalar_first=True)
    quaternion *= np.sign(quaternion @ START.as_quat(scalar_first=True))[:, None]
    still = np.zeros((ROWS, 3))
    changed = {
        "reference_quaternion": quaternion,
        "reference_angular_velocity": still,
        "reference_angular_acceleration": still,
    }
    return Check(**{**vars(check), "outputs": {**check.outputs, **changed}})


TRUTHS = {"slew_bang_coast": slew_bang_coast, "slew_quintic": slew_quintic, "slew_step": slew_step}
