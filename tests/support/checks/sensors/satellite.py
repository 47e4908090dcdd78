"""Truths of the sensors of a satellite."""

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP
from tests.support.checks.mrg32k3a import Numbers
from tests.support.checks.sensors.sampled import (
    EVERY,
    SAMPLES,
    SEED,
    STREAM,
    TIME,
    check_sensor,
    keep,
    sampled,
    wave,
)

NOT_FINITE = 5  # sample of an input that is not finite
SHAPE = np.array([[2.0, -1.0, 0.5], [0.5, 3.0, -0.2], [1.0, 0.2, -1.0]])


def delayed(rows, good, late):
    """Return rows of good samples as they arrive ``late`` samples after they were taken, 0 before, and their count."""
    arrived = np.concatenate([np.zeros(late, dtype=bool), good[: SAMPLES - late]])
    return keep(np.concatenate([np.zeros_like(rows[:late]), rows[: SAMPLES - late]]), arrived)


def correlated(first, fresh, sigma, lag):
    """Return a first-order Gauss-Markov error that begins in its steady state, summed from all its past."""
    ages = np.subtract.outer(np.arange(SAMPLES), np.arange(SAMPLES)) * EVERY * STEP
    weights = np.where(ages >= 0.0, np.exp(-np.abs(ages) / lag), 0.0)
    weights[:, 1:] *= np.sqrt(1.0 - np.exp(-2.0 * EVERY * STEP / lag))
    return sigma * weights @ np.concatenate([[first], fresh])


def rate_gyros():
    """Check all errors at once; a sample has the random walk half way of its step, and arrives a period late."""
    velocity, bias, limit, sigma = wave(0.05, 0.0, 1.0, 2.0), np.array([0.001, -0.002, 0.003]), 0.004, 0.002
    numbers, walk, slow, lag = Numbers(SEED, STREAM), 0.003, 0.002, 1.5
    scale, largest, quantum = 0.02 * SHAPE, 0.045, 1e-4
    first = bias + limit * (2.0 * numbers.uniform(3) - 1.0)
    unsteady, fresh, later = numbers.normal(3), numbers.normal(1, 3), numbers.normal(SAMPLES - 1, 3, 3)
    steps = walk * np.sqrt(EVERY * STEP) * np.concatenate([np.zeros((1, 3)), later[:, 1]])
    total = first + np.cumsum(steps, axis=0)
    errors = sigma * np.concatenate([fresh, later[:, 2]]) + correlated(unsteady, later[:, 0], slow, lag)
    y = sampled(velocity) @ (np.eye(3) + scale).T + total - 0.5 * steps + errors
    within = np.clip(y, -largest, largest)
    status = (within != y).any(axis=1).astype(int)
    assert set(status) == {0, 1}
    measured, count = delayed(quantum * np.floor(within / quantum + 0.5), np.ones(SAMPLES, dtype=bool), 1)
    return check_sensor(
        "closed form with exact random numbers",
        {"angular_velocity": velocity},
        {"measured_angular_velocity": measured, "true_bias": total, "status": status},
        {
            "bias": bias,
            "bias_limit": limit,
            "sigma": sigma,
            "bias_walk": walk,
            "scale": scale,
            "instability_sigma": slow,
            "instability_time": lag,
            "range": largest,
            "quantum": quantum,
            "latency": 1,
        },
        (1e-15, 0.0),
        count,
    )


def star_inertial():
    """Compute the attitude after a small body rotation, larger about the boresight; Sun, Moon, limb, rate, latency."""
    attitude, sigma, roll, late = Rotation.from_euler("zyx", wave(1.2, 0.3, 1.3, 2.9)), 0.02, 0.05, 1
    boresight = np.array([2.0, -1.0, 2.0]) / 3.0
    aim = attitude.apply(boresight)
    rate = wave(0.03, 1.2, 1.3, 1.4)
    numbers = Numbers(SEED, STREAM).normal(SAMPLES, 3)
    about = np.outer(numbers @ boresight, boresight)
    error = Rotation.from_rotvec(sigma * (numbers - about) + roll * about)

    def passing(time, distance, axis):
        """Return a vector from the spacecraft that crosses the boresight at a time."""
        return distance * Rotation.from_rotvec(np.outer(2.0 * (TIME - time), np.cross(axis, aim[0]))).apply(aim)

    position = -passing(3.2, 7e6, [0.0, 0.0, 1.0])
    sun, moon = passing(0.6, 1.0, [1.0, 0.0, 0.0]), position + passing(1.4, 3e8, [0.0, 1.0, 0.0])
    limits = {"sun_exclusion": 0.3, "moon_exclusion": 0.25, "limb_exclusion": 0.2, "rate_limit": 0.039}

    def off(direction):
        """Return angle from the boresight at the samples."""
        cosine = (sampled(direction) * sampled(aim)).sum(axis=1) / np.linalg.norm(sampled(direction), axis=1)
        return np.arccos(cosine)

    disk = np.arcsin(6378137.0 / 7e6)
    dazzled = np.array([off(sun) < 0.3, off(moon - position) < 0.25, off(-position) < disk + 0.2])
    assert (dazzled & (dazzled.sum(axis=0) == 1)).any(axis=1).all()
    fast = np.linalg.norm(sampled(rate), axis=1) > 0.039
    status = np.where(dazzled.any(axis=0), 1, np.where(fast, 2, 0))
    assert set(status) == {0, 1, 2}
    quaternion = attitude.as_quat(scalar_first=True)
    measured = (Rotation.from_quat(sampled(quaternion), scalar_first=True) * error).as_quat(scalar_first=True)
    measured *= np.sign((measured * sampled(quaternion)).sum(axis=1))[:, None]
    arrived, count = delayed(measured, status == 0, late)
    arrived[count == 0] = [1.0, 0.0, 0.0, 0.0]
    return check_sensor(
        "rotations and angles by scipy; exact random numbers",
        {
            "quaternion": quaternion,
            "angular_velocity": rate,
            "position": position,
            "sun_direction": sun,
            "moon_position": moon,
        },
        {
            "measured_quaternion": arrived,
            "sample_time": delayed(EVERY * STEP * np.arange(SAMPLES), status == 0, late)[0],
            "status": status,
        },
        {"attitude_sigma": sigma, "roll_sigma": roll, "boresight": 3.0 * boresight, "latency": late, **limits},
        (1e-14, 0.0),
        count,
    )


def magnetometer():
    """Check a drawn matrix and bias, the torquers' field, both limits of a component, a field that is not finite."""
    field, dipole = wave(4e-5, 0.0, 2.2, 4.2), wave(3.0, 5.0, 3.0, 1.0)
    field[2 * NOT_FINITE - 1, 1] = np.nan
    scale, coupling = 0.01 * SHAPE, 1e-7 * SHAPE.T
    bias, sigma, bias_sigma, scale_sigma, limit, quantum = np.array([1e-6, -2e-6, 3e-6]), 5e-7, 2e-6, 0.02, 3.6e-5, 1e-7
    numbers = Numbers(SEED, STREAM)
    whole_bias = bias + bias_sigma * numbers.normal(3)
    matrix = np.eye(3) + scale + scale_sigma * numbers.normal(3, 3)
    y = sampled(field) @ matrix.T + sampled(dipole) @ coupling.T + whole_bias + sigma * numbers.normal(SAMPLES, 3)
    within = np.clip(y, -limit, limit)
    status = np.where(np.isnan(y).any(axis=1), 2, (within != y).any(axis=1))
    assert set(status) == {0, 1, 2}
    assert (y > limit).any()
    assert (y < -limit).any()
    measured, count = keep(quantum * np.floor(within / quantum + 0.5), status < 2)
    return check_sensor(
        "matrices by numpy; exact random numbers",
        {"magnetic_field_body": field, "applied_dipole": dipole},
        {"measured_field": measured, "status": status},
        {
            "sigma": sigma,
            "bias": bias,
            "bias_sigma": bias_sigma,
            "scale": scale,
            "scale_sigma": scale_sigma,
            "coupling": coupling,
            "range": limit,
            "quantum": quantum,
        },
        (1e-19, 0.0),
        count,
    )


def sun_sensors():
    """Check heads on tilted axes, sunset, the body's light, a field of the fine head, a direction that is not
    finite."""
    attitude = Rotation.from_euler("zyx", wave(1.2, 0.3, 1.3, 2.9))
    boresight, field, fine_field, threshold = np.array([-1.0, 0.5, 2.0]), 1.3, 0.6, 0.6
    turns = Rotation.from_rotvec(np.outer(0.2 + 0.5 * TIME, [0.6, 0.0, 0.8]))
    sun = (attitude * turns).apply(boresight / np.linalg.norm(boresight))
    position = wave(7e6, 0.5, 2.0, 4.0)
    illumination = np.clip(1.6 - TIME / 2.0, 0.0, 1.0)
    sun[2 * NOT_FINITE - 1, 2] = np.nan
    axes = Rotation.from_rotvec([0.3, -0.2, 0.4]).as_matrix()
    heads = np.concatenate([axes, -axes])
    sigma, scale_sigma, albedo, fine_sigma = 0.02, 0.05, 0.15, 0.01
    numbers = Numbers(SEED, STREAM)
    scales, fresh = scale_sigma * numbers.normal(6), numbers.normal(SAMPLES, 3, 3)
    to_body = Rotation.from_quat(sampled(attitude.as_quat())).inv()
    observed, light = to_body.apply(sampled(sun)), sampled(illumination)
    down = -to_body.apply(sampled(position / np.linalg.norm(position, axis=1)[:, None]))
    angles = np.arccos(observed @ heads.T)
    direct = np.where(angles <= min(field, np.pi / 2.0), np.cos(angles), 0.0) * light[:, None] * (1.0 + scales)
    below = albedo * np.maximum(down @ heads.T, 0.0)
    currents = direct + below + sigma * fresh[:, :2].reshape(SAMPLES, 6)
    total = currents @ heads
    off = np.arccos(observed @ boresight / np.linalg.norm(boresight))
    fine = (off <= fine_field) & (light > 0.5)
    direction = np.where(fine[:, None], Rotation.from_rotvec(fine_sigma * fresh[:, 2]).apply(observed), total)
    finite = np.isfinite(off)
    valid = finite & (fine | (np.linalg.norm(total, axis=1) > threshold))
    assert 0 < (fine & valid).sum() < valid.sum()
    assert (finite & ~valid).any()
    measured, count = keep(direction / np.linalg.norm(direction, axis=1)[:, None], valid)
    return check_sensor(
        "angles and rotations by scipy; exact random numbers",
        {
            "quaternion": attitude.as_quat(scalar_first=True),
            "position": position,
            "sun_direction": sun,
            "illumination": illumination,
        },
        {
            "currents": keep(currents, finite)[0],
            "measured_direction": measured,
            "valid": valid,
            "status": np.where(finite, np.where(valid, 0, 1), 2),
        },
        {
            "normals_of_heads": heads,
            "sigma": sigma,
            "scale_sigma": scale_sigma,
            "albedo_factor": albedo,
            "field_of_view": field,
            "threshold": threshold,
            "boresight": boresight,
            "fine_sigma": fine_sigma,
            "fine_field": fine_field,
        },
        (1e-13, 0.0),
        count,
    )


def gps_receiver():
    """Check samples two periods late; the correlated error summed from all its past; an outage,
    a position not finite."""
    position = np.array([7e6, 1e5, -2e5]) + np.outer(TIME, [500.0, 7000.0, 2000.0])
    velocity = np.array([500.0, 7000.0, 2000.0]) + wave(10.0, 0.0, 1.0, 2.0)
    position[2 * NOT_FINITE - 1, 0] = np.nan
    outage = (TIME > 1.3) & (TIME < 1.9)
    white, speed, slow, lag, clock, late = 3.0, 0.03, 5.0, 1.5, -2e-6, 2
    numbers = Numbers(SEED, STREAM)
    first, fresh = numbers.normal(3), numbers.normal(SAMPLES, 3, 3)
    markov = correlated(first, fresh[1:, 0], slow, lag)
    status = np.where(sampled(outage), 1, np.where(np.isnan(sampled(position)).any(axis=1), 2, 0))
    assert set(status) == {0, 1, 2}
    measured, count = delayed(sampled(position) + markov + white * fresh[:, 1], status == 0, late)
    return check_sensor(
        "weighted sum of exact random numbers",
        {"position": position, "velocity": velocity, "outage": outage},
        {
            "measured_position": measured,
            "measured_velocity": delayed(sampled(velocity) + speed * fresh[:, 2], status == 0, late)[0],
            "sample_time": delayed(EVERY * STEP * np.arange(SAMPLES) + clock, status == 0, late)[0],
            "status": status,
        },
        {
            "position_sigma": white,
            "velocity_sigma": speed,
            "markov_sigma": slow,
            "markov_time": lag,
            "clock_error": clock,
            "latency": late,
        },
        (1e-9, 1e-15),
        count,
    )


TRUTHS = {
    "gps_receiver": gps_receiver,
    "magnetometer": magnetometer,
    "rate_gyros": rate_gyros,
    "star_inertial": star_inertial,
    "sun_sensors": sun_sensors,
}
