"""Attitude from star tracker and gyros: a multiplicative extended Kalman filter."""

import math

from ..block import State
from ..interfaces.ports import body, sampling
from ..kernel.matrices import identity, zeros
from ..mathlib.attitude.quaternion import (
    difference,
    from_rotation_vector,
    is_attitude,
    multiply,
    normalise,
    to_rotation_vector,
)
from ..mathlib.estimation.attitude_errors import BIAS, ROTATION, predict_attitude, standard_deviations
from ..mathlib.estimation.kalman import update
from ..mathlib.vectors import Vector3, is_finite, vector
from .attitude_navigation import AttitudeNavigation, AttitudeNavigationStatus


class AttitudeNavigationFilter(AttitudeNavigation):
    """Multiplicative extended Kalman filter of attitude and gyro bias.

    The attitude turns with the mean of the last two gyro samples less the bias, or with the last one until the next.
    A star sample corrects it by a small rotation in body axes, and the bias; the first one is the first attitude. The
    covariance is 6 x 6; three components are taken in one after another, as exact as at once. A sample that is not
    finite, or no attitude, is left out and reported. Assumes errors as declared, alike about all axes.
    Source: Lefferts, Markley and Shuster 1982; Crassidis and Junkins 2012, section 7.2.
    """

    rate = body.ANGULAR_VELOCITY.state("last finite gyro sample")
    covariance = State(zeros(6, 6), frozen=True, description="of the errors of attitude and bias, SI")
    start_time = sampling.START_TIME.state()
    last_time = State(0.0, unit="s", description="time of the last cycle")
    star_counted = State(0, description="star_count of the last sample")
    gyro_counted = State(0, description="gyro_count of the last sample")
    begun = State(False, description="an attitude was measured")

    def initialize(self) -> None:
        self.last_time = self.start_time
        self.star_counted = self.star_count - 1
        self.gyro_counted = self.gyro_count - 1
        sigma = self.first_bias_sigma
        self.covariance[ROTATION, ROTATION] = identity(3)
        self.covariance[BIAS, BIAS] = sigma * sigma * identity(3)
        self.rate = self.gyro_rate()
        self.take_star_sample()
        self.report()

    def gyro_rate(self) -> Vector3:
        """The gyros' new sample if there is one that is finite, or else the last one that was."""
        self.status = AttitudeNavigationStatus.GOOD
        if self.gyro_count == self.gyro_counted:
            return self.rate
        self.gyro_counted = self.gyro_count
        if is_finite(self.measured_angular_velocity):
            return self.measured_angular_velocity
        self.status = AttitudeNavigationStatus.NO_GYROS
        return self.rate

    def predict(self, h: float) -> None:
        """Propagate by the gyros over h (s)."""
        rate = self.gyro_rate()
        turn = h * (0.5 * (self.rate + rate) - self.estimated_bias)
        self.rate = rate
        self.estimated_quaternion = normalise(multiply(self.estimated_quaternion, from_rotation_vector(turn)))
        self.covariance = predict_attitude(self.covariance, turn, self.gyro_random_walk, self.bias_random_walk, h)

    def take_star_sample(self) -> None:
        """Take a new star sample in, if there is one."""
        if self.star_count == self.star_counted:
            return
        self.star_counted = self.star_count
        if not (math.isfinite(self.measured_quaternion.w) and is_finite(self.measured_quaternion[1:4])):
            self.status = AttitudeNavigationStatus.NO_STARS
        elif not is_attitude(self.measured_quaternion):
            self.status = AttitudeNavigationStatus.NO_ATTITUDE
        elif self.begun:
            self.correct()
        else:
            self.begun = True
            self.estimated_quaternion = normalise(self.measured_quaternion)
            self.covariance[ROTATION, ROTATION] = self.star_sigma * self.star_sigma * identity(3)

    def correct(self) -> None:
        """Correct attitude and bias by the measured quaternion."""
        measured = normalise(self.measured_quaternion)
        innovation = to_rotation_vector(difference(self.estimated_quaternion, measured))
        x = zeros(6, 1)
        self.innovation_square = 0.0
        for k in range(3):
            h = zeros(1, 6)
            h[0, k] = 1.0
            x, self.covariance, square = update(x, self.covariance, h, self.star_sigma * self.star_sigma, innovation[k])
            self.innovation_square = self.innovation_square + square
        turn = from_rotation_vector(vector(x[0, 0], x[1, 0], x[2, 0]))
        self.estimated_quaternion = normalise(multiply(self.estimated_quaternion, turn))
        self.estimated_bias = self.estimated_bias + vector(x[3, 0], x[4, 0], x[5, 0])

    def report(self) -> None:
        """Put angular velocity and standard deviations on the outputs."""
        self.estimated_angular_velocity = self.rate - self.estimated_bias
        self.attitude_sigma = standard_deviations(self.covariance, 0)
        self.bias_sigma = standard_deviations(self.covariance, 3)

    def step(self, t: float, h: float) -> None:
        self.predict(t + h - self.last_time)
        self.last_time = t + h
        self.take_star_sample()
        self.report()
