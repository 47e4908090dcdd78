"""Truth of the filter of the orbital attitude: filterpy's extended Kalman filter, derivatives by complex steps."""

import math

import numpy as np
from filterpy.kalman import ExtendedKalmanFilter

from tests.support.checks.check import STEP, Check
from tests.support.checks.navigation.orbital_samples import BODY, GOOD, NO_NEW, NOT_FINITE, Samples
from tests.support.flights.orbital_motion import DEGREE, INERTIA, JET_TORQUE, derivatives_of, rates_of

FIRST_YAW_SIGMA, RATE_GAIN = 10.0 * DEGREE, 0.15


class AttitudeKalman:
    """The filter by filterpy: angles and biases in ``filter``, and the angular velocity.

    A sample is (roll, pitch, w). Equations: docs/systems/orbital_attitude.md.
    """

    def __init__(self, sample, vertical_sigma, gyro_sigma, gyro_bias_sigma, tick):
        self.tick = tick
        self.filter = ExtendedKalmanFilter(6, 1)
        self.filter.x = np.array([sample[0], 0.0, sample[1], 0.0, 0.0, 0.0])
        sigmas = [vertical_sigma, FIRST_YAW_SIGMA, vertical_sigma, *[gyro_bias_sigma] * 3]
        self.filter.P = np.diag(np.square(sigmas))
        self.filter.Q = np.diag([(gyro_sigma * tick) ** 2] * 3 + [0.0] * 3)
        self.filter.R = np.array([[vertical_sigma**2]])
        self.rates = self.before = np.array(sample[2])

    def advance(self, w):
        """Predict a tick at the mean angular velocity w by the midpoint rule."""
        start = np.concatenate([self.filter.x[:3], w])
        middle = np.concatenate([start[:3] + self.tick / 2.0 * rates_of(start)[:3], w])
        derivatives = self.tick * derivatives_of(rates_of, middle)[:3]
        self.filter.F = np.eye(6)
        self.filter.F[:3] += derivatives * np.repeat([1.0, -1.0], 3)
        ahead = np.append(start[:3] + self.tick * rates_of(middle)[:3], self.filter.x[3:])
        self.filter.predict()
        self.filter.x = ahead

    def step(self, sample, pulses, torque=0.0):
        """Step over a tick with pulses (s) and a constant torque (N m), to a sample."""
        pulses, measured = np.array(pulses), np.array(sample[2])
        gained = np.linalg.solve(INERTIA, JET_TORQUE * pulses + torque * self.tick)
        coning = JET_TORQUE * pulses * (self.tick - np.abs(pulses)) / (2.0 * self.tick)
        self.advance((self.before + measured) / 2.0 + np.linalg.solve(INERTIA, coning) - self.filter.x[3:])
        for index, angle in ((0, sample[0]), (2, sample[1])):
            row = np.eye(6)[index : index + 1]
            self.filter.update(np.array([angle]), lambda x, row=row: row, lambda x, row=row: row @ x)
        self.rates = (1.0 - RATE_GAIN) * (self.rates + gained) + RATE_GAIN * (measured - self.filter.x[3:])
        self.before = measured

    def coast(self, carried):
        """Coast over a tick without a sample, to the angles and rates of the motion."""
        self.advance((self.rates + carried[3:]) / 2.0)
        self.filter.x[:3], self.rates = carried[:3], carried[3:]


def orbital_filter():
    """Check samples with noise and a bias; two missing, the last not finite."""
    sigmas = {"vertical_sigma": 0.05 * DEGREE, "gyro_sigma": 0.002 * DEGREE, "gyro_bias_sigma": 1e-5}
    samples = Samples(0.05 * DEGREE, 0.002 * DEGREE)
    samples.measured[:, 2:] += [1e-5, -2e-5, 1.5e-5]
    observed = [(*row[:2], row[2:]) for row in samples.measured]
    kalman = AttitudeKalman(observed[0], **sigmas, tick=STEP)
    rows = []

    def note(status):
        yaw_sigma = math.sqrt(kalman.filter.P[1, 1])
        rows.append([kalman.filter.x[:3], kalman.rates, kalman.filter.x[3:], yaw_sigma, status])

    note(GOOD)
    for row, status in enumerate(samples.status[:-1]):
        if status == GOOD:
            kalman.step(observed[row], samples.pulses[row], samples.torque[row])
        else:
            kalman.coast(samples.carry(row, np.concatenate([kalman.filter.x[:3], kalman.rates]), True))
        note(status)
    assert set(samples.status) == {GOOD, NO_NEW, NOT_FINITE}
    tolerances = {
        "estimated_angles": (1e-11, 0.0),
        "estimated_angular_velocity": (1e-13, 0.0),
        "estimated_gyro_bias": (1e-15, 0.0),
        "yaw_sigma": (0.0, 1e-12),
        "status": (0.0, 0.0),
    }
    columns = [np.array(column) for column in zip(*rows, strict=True)]
    return Check(
        truth="filterpy with derivatives by complex steps; without samples direction cosines by DOP853 at 1e-13",
        step=STEP,
        inputs=samples.inputs(),
        outputs=dict(zip(tolerances, columns, strict=True)),
        tolerances=tolerances,
        parameters={**BODY, **sigmas, "first_yaw_sigma": FIRST_YAW_SIGMA, "rate_gain": RATE_GAIN},
    )
