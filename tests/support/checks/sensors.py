"""Truths of sensors: their errors as declared, from MRG32k3a in exact integers.

A sample is taken at the start and at every second row, so that outputs stay in between.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.check import STEP, Check, follow
from tests.support.checks.mrg32k3a import Numbers

ROWS, EVERY = 25, 2
SAMPLES = (ROWS + 1) // EVERY
SEED, STREAM, MOON_RADIUS = 28, 7, 1.7374e6
SAMPLING = {"sample_period": EVERY * STEP, "seed": SEED, "stream": STREAM}
TIME = STEP * np.arange(ROWS)


def sampled(rows):
    """What a sensor sees at its samples: a sample at t_n sees the inputs of the row before."""
    return follow(rows)[::EVERY]


def repeat(samples):
    return np.repeat(samples, EVERY, axis=0)[:ROWS]


def check_sensor(truth, inputs, samples, parameters, tolerance, count=None):
    """The check of a sensor with these ``samples`` of its outputs; ``count`` if not all samples count."""
    outputs = {name: repeat(rows) for name, rows in samples.items()}
    outputs["sample_count"] = repeat(1 + np.arange(SAMPLES) if count is None else count)
    return Check(
        truth=truth,
        step=STEP,
        inputs=inputs,
        outputs=outputs,
        tolerances={**dict.fromkeys(samples, tolerance), "sample_count": (0.0, 0.0)},
        parameters={**SAMPLING, **parameters},
    )


def wave(size, *phases):
    """A row per time, an element per phase."""
    return size * np.sin(0.7 * TIME[:, None] + np.array(phases))


def attitude_sensor():
    """The axis measured by a constant and a new small rotation, to first order."""
    constant_sigma, attitude_sigma, rate_sigma = 0.02, 0.01, 0.003
    axis = wave(1.0, 0.3, 2.0, 4.0) + np.array([0.0, 0.0, 3.0])
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    rate = wave(0.1, 1.0, 2.5, 5.0)
    numbers = Numbers(SEED, STREAM)
    constant = constant_sigma * numbers.normal(3)
    fresh = numbers.normal(SAMPLES, 2, 3)
    measured = sampled(axis) + np.cross(constant + attitude_sigma * fresh[:, 0], sampled(axis))
    return check_sensor(
        "cross product of the rotation by numpy; exact random numbers",
        {"attitude": axis, "angular_rate": rate},
        {
            "measured_attitude": measured / np.linalg.norm(measured, axis=1)[:, None],
            "measured_angular_rate": sampled(rate) + rate_sigma * fresh[:, 1],
        },
        {"constant_sigma": constant_sigma, "attitude_sigma": attitude_sigma, "rate_sigma": rate_sigma},
        (1e-14, 0.0),
    )


def bank_sensor():
    """Bias and white error."""
    bank, bias, sigma = wave(0.8, 0.2)[:, 0], -0.01, 0.02
    return check_sensor(
        "closed form with exact random numbers",
        {"bank": bank},
        {"measured_bank": sampled(bank) + bias + sigma * Numbers(SEED, STREAM).normal(SAMPLES)},
        {"bias": bias, "sigma": sigma},
        (1e-15, 0.0),
    )


def rate_gyros():
    """A drawn bias that walks, a declared one and white errors; a sample has the bias half way of its step."""
    velocity, bias, limit, sigma = wave(0.05, 0.0, 1.0, 2.0), np.array([0.001, -0.002, 0.003]), 0.004, 0.002
    numbers, walk = Numbers(SEED, STREAM), 0.003
    first = bias + limit * (2.0 * numbers.uniform(3) - 1.0)
    fresh, later = numbers.normal(1, 3), numbers.normal(SAMPLES - 1, 2, 3)
    steps = walk * np.sqrt(EVERY * STEP) * np.concatenate([np.zeros((1, 3)), later[:, 0]])
    whole = first + np.cumsum(steps, axis=0)
    errors = sigma * np.concatenate([fresh, later[:, 1]])
    return check_sensor(
        "closed form with exact random numbers",
        {"angular_velocity": velocity},
        {"measured_angular_velocity": sampled(velocity) + whole - 0.5 * steps + errors, "true_bias": whole},
        {"bias": bias, "bias_limit": limit, "sigma": sigma, "bias_walk": walk},
        (1e-15, 0.0),
    )


def infrared_vertical():
    """Errors of a first-order Gauss-Markov process, summed from all their past."""
    angles, bias, sigma, lag = wave(0.1, 0.0, 1.0, 2.0), np.array([0.002, -0.003]), 0.01, 1.5
    fresh = Numbers(SEED, STREAM).normal(SAMPLES, 3)[:, :2]
    ages = np.subtract.outer(np.arange(SAMPLES), np.arange(SAMPLES)) * EVERY * STEP
    weights = np.where(ages >= 0.0, np.exp(-np.abs(ages) / lag), 0.0)
    weights[:, 1:] *= np.sqrt(1.0 - np.exp(-2.0 * EVERY * STEP / lag))
    measured = sampled(angles)[:, [0, 2]] + bias + sigma * weights @ fresh
    return check_sensor(
        "weighted sum of exact random numbers",
        {"angles": angles},
        {"measured_roll": measured[:, 0], "measured_pitch": measured[:, 1]},
        {"bias": bias, "sigma": sigma, "correlation_time": lag},
        (1e-15, 0.0),
    )


def laser_ranger():
    """Coarse from the limit of range on, fine below."""
    robot = wave(3.0, 0.0, 1.0, 2.0) + np.outer(TIME, [9.0, 4.0, -1.0])
    target = np.array([40.0, 10.0, -5.0]) + wave(1.0, 4.0, 5.0, 6.0)
    true = sampled(target - robot)
    near = np.linalg.norm(true, axis=1) < 25.0
    assert 0 < near.sum() < SAMPLES
    measured = true + np.where(near, 0.002, 0.2)[:, None] * Numbers(SEED, STREAM).normal(SAMPLES, 3)
    return check_sensor(
        "closed form with exact random numbers",
        {"robot_position": robot, "target_position": target},
        {"relative_position": measured, "range": np.linalg.norm(measured, axis=1)},
        {"near_range": 25.0, "near_sigma": 0.002, "far_sigma": 0.2},
        (1e-13, 0.0),
    )


def planar_state_sensor():
    """Uniform relative errors."""
    angle, altitude = wave(1.0, 0.3)[:, 0], 2000.0 + 90.0 * TIME
    errors = 2.0 * Numbers(SEED, STREAM).uniform(SAMPLES, 2) - 1.0
    return check_sensor(
        "closed form with exact random numbers",
        {"path_angle": angle, "altitude": altitude},
        {
            "measured_path_angle": sampled(angle) * (1.0 + 0.05 * errors[:, 0]),
            "measured_altitude": sampled(altitude) * (1.0 + 0.02 * errors[:, 1]),
        },
        {"path_angle_noise": 0.05, "altitude_noise": 0.02},
        (0.0, 1e-15),
    )


def star_inertial():
    """The attitude after a small rotation in body axes."""
    angles, sigma = wave(1.2, 0.3, 1.3, 2.9), 0.02
    true = Rotation.from_euler("zyx", angles)
    error = Rotation.from_rotvec(sigma * Numbers(SEED, STREAM).normal(SAMPLES, 3))
    quaternion = true.as_quat(scalar_first=True)
    measured = (Rotation.from_quat(sampled(quaternion), scalar_first=True) * error).as_quat(scalar_first=True)
    signs = np.sign((measured * sampled(quaternion)).sum(axis=1))
    return check_sensor(
        "rotations by scipy; exact random numbers",
        {"quaternion": quaternion},
        {"measured_quaternion": signs[:, None] * measured},
        {"attitude_sigma": sigma},
        (1e-14, 0.0),
    )


def descent():
    """Position and velocity down through the limits of all lunar sensors, tens of km from the site."""
    position = np.array([4.0e4, -5.0e3, 5.0e3]) + np.outer(TIME, [-900.0, 100.0, -1500.0])
    return position, np.tile([-900.0, 100.0, -1500.0], (ROWS, 1)) + wave(20.0, 0.0, 1.0, 2.0)


def altitudes(position):
    return np.linalg.norm(position + np.array([0.0, 0.0, MOON_RADIUS]), axis=1) - MOON_RADIUS


def keep(rows, seen):
    """Outputs at every sample, the last seen one where nothing is seen, 0 before; and the count."""
    assert 0 < seen.sum() < SAMPLES
    count = np.cumsum(seen)
    return np.concatenate([np.zeros_like(rows[:1]), rows[seen]])[count], count


def radar_altimeter():
    """Altitude above a sphere, below a limit."""
    position, _ = descent()
    altitude = altitudes(sampled(position))
    measured = altitude + (0.005 * np.abs(altitude) + 2.0) * Numbers(SEED, STREAM).normal(SAMPLES)
    measured, count = keep(measured, altitude <= 4000.0)
    return check_sensor(
        "closed form with exact random numbers",
        {"position": position},
        {"measured_altitude": measured},
        {"range_error": 0.005, "noise_sigma": 2.0, "maximum_altitude": 4000.0, "moon_radius": MOON_RADIUS},
        (1e-9, 0.0),
        count,
    )


def terrain_camera():
    """Position within a band of altitudes."""
    position, _ = descent()
    seen = sampled(position)
    altitude = altitudes(seen)
    sigma = 0.002 * np.abs(altitude) + 2.0
    measured, count = keep(
        seen + sigma[:, None] * Numbers(SEED, STREAM).normal(SAMPLES, 3), (altitude >= 1500.0) & (altitude <= 4000.0)
    )
    limits = {"minimum_altitude": 1500.0, "maximum_altitude": 4000.0, "moon_radius": MOON_RADIUS}
    return check_sensor(
        "closed form with exact random numbers",
        {"position": position},
        {"measured_position": measured},
        {"altitude_error": 0.002, "noise_sigma": 2.0, **limits},
        (1e-10, 0.0),
        count,
    )


def doppler_velocimeter():
    """Velocity below a limit of altitude, with errors that grow with speed."""
    position, velocity = descent()
    seen = sampled(velocity)
    sigma = 0.003 * np.linalg.norm(seen, axis=1) + 0.1
    measured, count = keep(
        seen + sigma[:, None] * Numbers(SEED, STREAM).normal(SAMPLES, 3), altitudes(sampled(position)) <= 3000.0
    )
    return check_sensor(
        "closed form with exact random numbers",
        {"position": position, "velocity": velocity},
        {"measured_velocity": measured},
        {"speed_error": 0.003, "noise_sigma": 0.1, "maximum_altitude": 3000.0, "moon_radius": MOON_RADIUS},
        (1e-12, 0.0),
        count,
    )


def inertial_sensor():
    """Increments through a matrix of scale factors and misalignment, with bias and random walk."""
    sensed = np.outer(TIME, [1.5, -0.3, 2.5]) + wave(1.0, 0.0, 1.0, 2.0)
    bias_sigma, scale_sigma, turn_sigma, walk, period = 0.01, 0.003, 0.02, 0.005, EVERY * STEP
    numbers = Numbers(SEED, STREAM)
    bias, scale, turn = numbers.normal(3, 3).T * np.array([[bias_sigma], [scale_sigma], [turn_sigma]])
    skew = np.cross(turn, np.eye(3)).T
    matrix = (np.eye(3) + skew) @ np.diag(1.0 + scale)
    walks = walk * np.sqrt(period) * numbers.normal(SAMPLES - 1, 3)
    measured = np.diff(sampled(sensed), axis=0) @ matrix.T + bias * period + walks
    return check_sensor(
        "matrices by numpy; exact random numbers",
        {"sensed_velocity": sensed},
        {"velocity_increment": np.concatenate([np.zeros((1, 3)), measured])},
        {
            "bias_sigma": bias_sigma,
            "scale_factor_sigma": scale_sigma,
            "attitude_sigma": turn_sigma,
            "velocity_random_walk": walk,
        },
        (1e-14, 0.0),
        np.arange(SAMPLES),
    )


TRUTHS = {
    "attitude_sensor": attitude_sensor,
    "bank_sensor": bank_sensor,
    "doppler_velocimeter": doppler_velocimeter,
    "inertial_sensor": inertial_sensor,
    "infrared_vertical": infrared_vertical,
    "laser_ranger": laser_ranger,
    "planar_state_sensor": planar_state_sensor,
    "radar_altimeter": radar_altimeter,
    "rate_gyros": rate_gyros,
    "star_inertial": star_inertial,
    "terrain_camera": terrain_camera,
}
