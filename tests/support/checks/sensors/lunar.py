"""Truths of the sensors of a descent to the Moon."""

import numpy as np

from tests.support.checks.check import STEP
from tests.support.checks.mrg32k3a import Numbers
from tests.support.checks.sensors.sampled import (
    EVERY,
    ROWS,
    SAMPLES,
    SEED,
    STREAM,
    TIME,
    check_sensor,
    keep,
    sampled,
    wave,
)

MOON_RADIUS = 1.7374e6


def descent():
    """Return position and velocity down through the limits of all lunar sensors, tens of km from the site."""
    position = np.array([4.0e4, -5.0e3, 5.0e3]) + np.outer(TIME, [-900.0, 100.0, -1500.0])
    return position, np.tile([-900.0, 100.0, -1500.0], (ROWS, 1)) + wave(20.0, 0.0, 1.0, 2.0)


def altitudes(position):
    return np.linalg.norm(position + np.array([0.0, 0.0, MOON_RADIUS]), axis=1) - MOON_RADIUS


def radar_altimeter():
    """Measure the altitude above a sphere, below a limit."""
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
    """Measure the position within a band of altitudes."""
    position, _ = descent()
    observed = sampled(position)
    altitude = altitudes(observed)
    sigma = 0.002 * np.abs(altitude) + 2.0
    measured, count = keep(
        observed + sigma[:, None] * Numbers(SEED, STREAM).normal(SAMPLES, 3),
        (altitude >= 1500.0) & (altitude <= 4000.0),
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
    """Measure the velocity below a limit of altitude, with errors that grow with speed."""
    position, velocity = descent()
    observed = sampled(velocity)
    sigma = 0.003 * np.linalg.norm(observed, axis=1) + 0.1
    measured, count = keep(
        observed + sigma[:, None] * Numbers(SEED, STREAM).normal(SAMPLES, 3), altitudes(sampled(position)) <= 3000.0
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
    """Measure increments through a matrix of scale factors and misalignment, with bias and random walk."""
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
    "radar_altimeter": radar_altimeter,
    "terrain_camera": terrain_camera,
    "doppler_velocimeter": doppler_velocimeter,
    "inertial_sensor": inertial_sensor,
}
