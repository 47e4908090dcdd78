"""Truth of quaternion feedback: rotations by scipy, the law in matrices."""

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow

ROWS = 33


def quaternion_feedback():
    """Check errors within and beyond the band of the integral and the limit; quaternions of either sign, any length.

    A torque fed forward; off for a while, which clears the integral: the error stays that of the last sample then.
    """
    inertia = np.array([[12.0, -0.7, 0.3], [-0.7, 9.0, 0.5], [0.3, 0.5, 7.0]])
    w0, damping, time, band, limit = 0.8, 0.7, 5.0, 0.3, 0.5
    random = np.random.default_rng(46)
    size = np.where(np.arange(ROWS) % 4 == 0, 0.5, 0.06)
    reference = Rotation.from_rotvec(random.normal(size=(ROWS, 3)))
    error = Rotation.from_rotvec(size[:, None] * random.normal(size=(ROWS, 3)))
    rate, desired, acceleration = (scale * random.normal(size=(ROWS, 3)) for scale in (0.05, 0.05, 0.01))
    wheels = random.normal(0.0, 3.0, (ROWS, 3))
    estimated = random.choice([-2.0, -1.0, 1.0], (ROWS, 1)) * (reference * error).as_quat(scalar_first=True)
    q = error.as_quat(canonical=True, scalar_first=True)[:, 1:]
    length = 2.0 * np.linalg.norm(q, axis=1)
    assert (length > limit).any()
    assert 0 < (length < band).sum() < ROWS
    bounded = 2.0 * q * np.minimum(1.0, limit / length)[:, None]
    stiffness, friction = w0**2 + 2.0 * damping * w0 / time, 2.0 * damping * w0 + 1.0 / time
    feedforward = random.normal(0.0, 0.1, (ROWS, 3))
    active = (np.arange(ROWS) < 14) | (np.arange(ROWS) > 18)
    # a tick sees the inputs of the row before, the first one those of the first row: they are integrated twice
    sampled = follow(np.arange(ROWS))
    integral = np.cumsum(np.where((length < band)[:, None] & active[:, None], 2.0 * q, 0.0)[sampled], axis=0)
    integral -= np.where((sampled > 18)[:, None], integral[sampled == 18], 0.0)
    integral *= STEP * w0**2 / time
    on, answered = active[sampled], np.maximum.accumulate(np.where(active, np.arange(ROWS), 0))[sampled]
    seen_rate, seen_acceleration = error.inv().apply(desired), error.inv().apply(acceleration)
    answer = seen_acceleration + np.cross(seen_rate, rate) - stiffness * bounded - friction * (rate - seen_rate)
    torque = np.cross(rate, rate @ inertia.T + wheels) + answer @ inertia.T + feedforward
    return Check(
        truth="rotations by scipy, the law by numpy",
        step=STEP,
        inputs={
            "estimated_quaternion": estimated,
            "estimated_angular_velocity": rate,
            "reference_quaternion": reference.as_quat(scalar_first=True),
            "reference_angular_velocity": desired,
            "reference_angular_acceleration": acceleration,
            "wheel_momentum": wheels,
            "feedforward_torque": feedforward,
            "active": active,
        },
        outputs={
            "torque_command": np.where(on[:, None], torque[sampled] - integral @ inertia.T, 0.0),
            "attitude_error": 2.0 * q[answered],
            "status": np.where(on, 0, 3),
        },
        tolerances={"torque_command": (1e-12, 0.0), "attitude_error": (1e-14, 0.0), "status": (0.0, 0.0)},
        parameters={
            "inertia": inertia,
            "natural_frequency": w0,
            "damping": damping,
            "integral_time": time,
            "integral_band": band,
            "error_limit": limit,
            "sample_period": STEP,
        },
    )


TRUTHS = {"quaternion_feedback": quaternion_feedback}
