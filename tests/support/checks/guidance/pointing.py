"""Truth of the reference attitude on an orbit: axes by numpy, rotations by scipy, J2 from its potential."""

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.check import Check, follow

CYCLE, ROWS = 0.25, 73
NADIR, SUN, INERTIAL = range(3)
GOOD, OLD_ORBIT, DEGENERATE, NOT_FINITE = range(4)
MU, J2, RADIUS = 4.0e14, 1.1e-3, 6.4e6
NO_ORBIT, NO_COUNT, ALONG, FALLING = range(4), range(12, 37), range(50, 53), range(60, 64)  # rows


def oblate_acceleration(r):
    """Return the gradient of the potential of J2, (mu/r) (R/r)^2 J2 (1 - 3 sin^2)/2, by complex steps."""

    def potential(x):
        square = x @ x
        return MU * J2 * RADIUS**2 * (1.0 - 3.0 * x[2] ** 2 / square) / (2.0 * square**1.5)

    step = 1e-20
    return np.array([potential(r + 1j * step * axis).imag / step for axis in np.eye(3)])


def nadir(r, v, offset):
    """Return attitude, angular velocity and acceleration in reference axes."""
    normal = np.cross(r, v)
    z, y = -r / np.linalg.norm(r), -normal / np.linalg.norm(normal)
    attitude = Rotation.from_matrix(np.column_stack([np.cross(y, z), y, z])) * offset
    rate = normal / (r @ r) + (oblate_acceleration(r) @ normal) / (normal @ normal) * r
    return attitude, attitude.inv().apply(rate), attitude.inv().apply(-2.0 * (r @ v) / (r @ r) * rate)


def carry(r, v, h):
    """Move under the gravity of a point, by the rule of the block's page."""
    g = -MU * r / np.linalg.norm(r) ** 3
    return r + h * v + 0.5 * h * h * g, v + h * g


def orbit_samples():
    """Return samples each second, 1 s old; none for more than 5 s; then one that falls straight down."""
    time = CYCLE * np.arange(ROWS)
    count = 7 + np.arange(ROWS) // 4
    count[NO_COUNT] = count[NO_COUNT[0] - 1]
    sampled_at = np.floor(time) - 1.0
    angle = 1.1e-3 * sampled_at[:, None]
    r = 6.9e6 * (np.cos(angle) * [0.6, 0.48, 0.64] + np.sin(angle) * [-0.8, 0.36, 0.48])
    v = 7600.0 * (-np.sin(angle) * [0.6, 0.48, 0.64] + np.cos(angle) * [-0.79, 0.38, 0.48])
    fall = np.isin(np.arange(ROWS), FALLING)
    v[fall] = -3e-4 * r[fall]
    r[NO_ORBIT] = 0.0
    return r, v, sampled_at, count


def pointing_guidance():
    """Check all modes and statuses: an old orbit, the Sun along the orbit normal, a fall, no orbit at first."""
    r, v, sampled_at, count = orbit_samples()
    sun = np.tile([0.3, -0.7, 0.55], (ROWS, 1)) + 0.01 * np.arange(ROWS)[:, None]
    sun[ALONG] = -2.0 * np.cross(r[ALONG], v[ALONG])
    mode = np.repeat([NADIR, SUN, INERTIAL, SUN, NADIR, SUN], [20, 12, 9, 14, 11, 7])
    offset, fixed = Rotation.from_rotvec([0.2, -0.1, 0.4]), Rotation.from_rotvec([1.0, 0.5, -2.0])
    panel, secondary = np.array([0.1, -2.0, 0.3]), np.array([0.2, 0.1, 1.5])
    sampled = follow(np.arange(ROWS))
    reference, before, rows = (Rotation.identity(), np.zeros(3), np.zeros(3)), None, []
    for row, n in enumerate(sampled):
        time, finite = CYCLE * row, n not in NO_ORBIT
        if finite and count[n] != before:
            before, at = count[n], sampled_at[n]
            position, velocity = carry(r[n], v[n], time - at)
        elif finite:
            position, velocity = carry(position, velocity, CYCLE)
        status = GOOD if finite else NOT_FINITE
        if finite and time - at > 5.0:
            status = OLD_ORBIT
        if finite and ((mode[n] == SUN and n in ALONG) or n in FALLING):
            status = DEGENERATE
        elif finite and mode[n] == NADIR:
            reference = nadir(position, velocity, offset)
        elif finite and mode[n] == SUN:
            normal = np.cross(position, velocity)
            pairs = [sun[n], normal / np.linalg.norm(normal)], [panel, secondary]
            reference = (Rotation.align_vectors(*pairs, weights=[np.inf, 1.0])[0], np.zeros(3), np.zeros(3))
        elif finite:
            reference = (fixed, np.zeros(3), np.zeros(3))
        attitude = reference[0].as_quat(scalar_first=True, canonical=mode[n] != INERTIAL)
        rows.append([attitude, reference[1], reference[2], status])
    quaternion, rate, acceleration, status = map(np.array, zip(*rows, strict=True))
    assert set(status) == {GOOD, OLD_ORBIT, DEGENERATE, NOT_FINITE}
    return Check(
        truth="axes by numpy, rotations and the Sun's attitude by scipy, J2 from its potential by complex steps",
        step=CYCLE,
        inputs={
            "mode": mode,
            "estimated_position": r,
            "estimated_velocity": v,
            "sample_time": sampled_at,
            "orbit_count": count,
            "sun_direction": sun,
        },
        outputs={
            "reference_quaternion": quaternion,
            "reference_angular_velocity": rate,
            "reference_angular_acceleration": acceleration,
            "status": status,
        },
        tolerances={
            "reference_quaternion": (1e-13, 0.0),
            "reference_angular_velocity": (1e-16, 0.0),
            "reference_angular_acceleration": (1e-19, 0.0),
            "status": (0.0, 0.0),
        },
        parameters={
            "gravitational_parameter": MU,
            "oblateness": J2,
            "radius": RADIUS,
            "offset": 3.0 * offset.as_quat(scalar_first=True),
            "panel_normal": panel,
            "secondary": secondary,
            "inertial_quaternion": fixed.as_quat(scalar_first=True),
            "sample_period": CYCLE,
        },
    )


TRUTHS = {"pointing_guidance": pointing_guidance}
