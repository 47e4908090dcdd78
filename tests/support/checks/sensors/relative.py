"""Truths of sensors of axes, angles and ranges."""

import numpy as np

from tests.support.checks.check import STEP
from tests.support.checks.mrg32k3a import Numbers
from tests.support.checks.sensors.sampled import (
    EVERY,
    SAMPLES,
    SEED,
    STREAM,
    TIME,
    check_sensor,
    sampled,
    wave,
)


def attitude_sensor():
    """Rotate the axis by a constant and a new small rotation, to first order."""
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
    """Add bias and white error."""
    bank, bias, sigma = wave(0.8, 0.2)[:, 0], -0.01, 0.02
    return check_sensor(
        "closed form with exact random numbers",
        {"bank": bank},
        {"measured_bank": sampled(bank) + bias + sigma * Numbers(SEED, STREAM).normal(SAMPLES)},
        {"bias": bias, "sigma": sigma},
        (1e-15, 0.0),
    )


def infrared_vertical():
    """Sum errors of a first-order Gauss-Markov process from all their past."""
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
    """Measure coarse from the limit of range on, fine below."""
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
    """Add uniform relative errors."""
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


TRUTHS = {
    "attitude_sensor": attitude_sensor,
    "bank_sensor": bank_sensor,
    "infrared_vertical": infrared_vertical,
    "laser_ranger": laser_ranger,
    "planar_state_sensor": planar_state_sensor,
}
