"""Braking trajectory to the landing site with sensor measurements: plain numpy, independent of the components.

The position is a cubic in time from 265 km before the site, 18.15 km high and at 1689 m/s, to 1.5 km above it at
rest, so position and velocity are closed forms, and the specific force is acceleration minus central gravity.
Frame: landing site (x north, y west, z up); the Moon's centre is 1737.4 km below. m, m/s, s, rad.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

MOON_RADIUS = 1.7374e6
MU = 4.9028e12
CENTRE = np.array([0.0, 0.0, -MOON_RADIUS])
DURATION = 280.0
STEP = 0.1
STEPS = 2800
BIAS = 1e-3
SCALE_FACTOR = 3e-4
RANDOM_WALK = 1e-4
ATTITUDE = np.radians(0.02)

_ANGLE = 2.65e5 / MOON_RADIUS
_START = np.array(
    [(MOON_RADIUS + 18148.0) * np.sin(_ANGLE), 5e3, (MOON_RADIUS + 18148.0) * np.cos(_ANGLE) - MOON_RADIUS]
)
_SPEED = 1689.0 * np.array([-np.cos(_ANGLE), -0.01, np.sin(_ANGLE)])
_WAY = np.array([0.0, 0.0, 1500.0]) - _START - _SPEED * DURATION
_FIRST = 6.0 * _WAY / DURATION**2 + 2.0 * _SPEED / DURATION  # acceleration at the start, and its constant rate
_RATE = -12.0 * _WAY / DURATION**3 - 6.0 * _SPEED / DURATION**2


def position(t):
    """Return rows of positions at times t."""
    t = np.asarray(t)[..., None]
    return _START + _SPEED * t + _FIRST * t**2 / 2 + _RATE * t**3 / 6


def velocity(t):
    t = np.asarray(t)[..., None]
    return _SPEED + _FIRST * t + _RATE * t**2 / 2


def altitude(t):
    return np.linalg.norm(position(t) - CENTRE, axis=-1) - MOON_RADIUS


def specific_force(t):
    centred = position(t) - CENTRE
    gravity = -MU * centred / np.linalg.norm(centred, axis=-1, keepdims=True) ** 3
    return _FIRST + _RATE * np.asarray(t)[..., None] - gravity


def increments(step=STEP):
    """Return integrals of the specific force over each step, by Gauss and Legendre's rule with five points."""
    points, weights = np.polynomial.legendre.leggauss(5)
    starts = np.arange(round(DURATION / step)) * step
    return sum(
        0.5 * step * weight * specific_force(starts + 0.5 * step * (1.0 + point))
        for point, weight in zip(points, weights, strict=True)
    )


@dataclass
class Measurements:
    """Rows for every communication point from the start on, and where new samples are (bool)."""

    increment: np.ndarray
    altitude: np.ndarray
    velocity: np.ndarray
    position: np.ndarray
    new_altitude: np.ndarray
    new_velocity: np.ndarray
    new_position: np.ndarray


def measurements(seed=0, scale=1.0):
    """Return the sensors' measurements in one flight, with errors ``scale`` times those specified; 0 is perfect."""
    random = np.random.default_rng(seed)
    k = np.arange(STEPS + 1)
    t = k * STEP
    height = altitude(t)
    bias, factor, tilt = (scale * sigma * random.normal(size=3) for sigma in (BIAS, SCALE_FACTOR, ATTITUDE))
    walk = scale * RANDOM_WALK * np.sqrt(STEP) * random.normal(size=(STEPS, 3))
    turned = Rotation.from_rotvec(tilt).apply(increments() * (1.0 + factor))

    def noisy(truth, sigma):
        return truth + scale * np.reshape(sigma, (-1, *[1] * (truth.ndim - 1))) * random.normal(size=truth.shape)

    return Measurements(
        increment=np.vstack([np.zeros(3), turned + bias * STEP + walk]),
        altitude=noisy(height, 0.005 * height + 1.0),
        velocity=noisy(velocity(t), 0.001 * np.linalg.norm(velocity(t), axis=1) + 0.05),
        position=noisy(position(t), 0.0015 * height + 2.0),
        new_altitude=(k % 10 == 0) & (height <= 2e4),
        new_velocity=(k % 2 == 0) & (height <= 5e3),
        new_position=(k % 50 == 0) & (height <= 2e4) & (height >= 500.0),
    )
