"""Orbital attitude by a Kalman filter that the gyros drive."""

import math

from ..block import Parameter, State
from ..interfaces.ports import body
from ..kernel.matrices import element, identity, row, set_element, set_isotropic, set_row
from ..kernel.records import replace
from ..mathlib.estimation.kalman import predict, update
from ..mathlib.orbits.attitude import ANGLES, YAW, angle_rate_derivatives, angle_rates, apply_matrix
from ..mathlib.vectors import Vector3, vector
from ..units import deg
from .attitude_observer import AttitudeObserver, ObserverStatus

BIASES = 3  # after the angles in the covariance


class OrbitalFilter(AttitudeObserver):
    """Extended Kalman filter of angles and gyro biases; the gyros are its motion, so inertia and thrust hardly matter.

    Over a tick the mean of two samples of the gyros, less the bias, turns the angles; what the mean misses of a pulse
    is added from its length. Roll and pitch correct angles and biases. Rates follow the pulses and lean on
    the gyros with rate_gain. Yaw and the bias of the roll gyro over w0 look the same to all sensors while yaw is
    small: their sum is known no better than the bias at the start, unless the body turns about yaw.
    Equations: docs/systems/orbital_attitude.md. Source: Bar-Shalom, Li and Kirubarajan 2001, section 10.3.
    """

    first_yaw_sigma = Parameter(deg(10.0), unit="rad", minimum=0.0, description="of yaw at the start")
    rate_gain = Parameter(0.15, unit="1", minimum=0.0, maximum=1.0, description="of a sample in the estimated rates")
    bias = body.ANGULAR_VELOCITY.state("estimated bias of the gyros")
    covariance = State([0.0] * 36, columns=6, frozen=True, description="of angles and biases, SI")

    def begin(self) -> bool:
        set_isotropic(self.covariance, 6, ANGLES, ANGLES, self.vertical_sigma * self.vertical_sigma)
        set_isotropic(self.covariance, 6, BIASES, BIASES, self.gyro_bias_sigma * self.gyro_bias_sigma)
        set_element(self.covariance, 6, YAW, YAW, self.first_yaw_sigma * self.first_yaw_sigma)
        return True

    def predict_covariance(self, angles: Vector3, w: Vector3) -> None:
        """The covariance a tick ahead, at angles (rad) and rates (rad/s) of its middle."""
        period = self.sample_period
        by_angles = [0.0] * 9
        by_rates = [0.0] * 9
        transition = [0.0] * 36
        noise = [0.0] * 36
        unmoved = [0.0] * 6
        angle_rate_derivatives(angles, w, self.orbital_rate, by_angles, by_rates)
        walk = self.gyro_sigma * period
        identity(transition, 6)
        for i in range(3):  # F = 1 + T df/dx, with the rates less the biases
            angles_row = row(transition, 6, i, ANGLES) + period * row(by_angles, 3, i, 0)
            set_row(transition, 6, i, ANGLES, angles_row)
            set_row(transition, 6, i, BIASES, -period * row(by_rates, 3, i, 0))
        set_isotropic(noise, 6, ANGLES, ANGLES, walk * walk)
        predict(unmoved, self.covariance, transition, noise, 6)

    def advance(self, w: Vector3) -> None:
        """Angles and covariance a tick ahead, at the mean angular velocity w (rad/s, body)."""
        half = 0.5 * self.sample_period
        angles = self.estimate.angles
        middle = angles + half * angle_rates(angles, w, self.orbital_rate)
        self.predict_covariance(middle, w)
        turned = angles + self.sample_period * angle_rates(middle, w, self.orbital_rate)
        self.estimate = replace(self.estimate, angles=turned)

    def correct(self) -> None:
        """Take roll and pitch in."""
        x = [0.0] * 6
        for k in range(3):
            x[k] = self.estimate.angles[k]
            x[3 + k] = self.bias[k]
        variance = self.vertical_sigma * self.vertical_sigma
        of_roll = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        of_pitch = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]
        update(x, self.covariance, of_roll, variance, self.measured_roll, 6)
        update(x, self.covariance, of_pitch, variance, self.measured_pitch, 6)
        self.estimate = replace(self.estimate, angles=vector(*x[0:3]))
        self.bias = vector(*x[3:6])

    def coning_correction(self) -> Vector3:
        """What the mean of the rates at both ends of a tick misses of its pulses (rad/s, body)."""
        px, py, pz = self.fired_pulses
        period = self.sample_period
        after = vector(period - abs(px), period - abs(py), period - abs(pz))
        return apply_matrix(self.inverse_inertia, self.jet_torque * self.fired_pulses * after / (2.0 * period))

    def observe(self) -> None:
        gained = self.sample_period * apply_matrix(self.inverse_inertia, self.mean_torque(self.fired_pulses))
        mean = 0.5 * (self.last_rates + self.measured_angular_velocity)
        self.advance(mean + self.coning_correction() - self.bias)
        self.correct()
        expected = self.estimate.angular_velocity + gained
        rates = expected + self.rate_gain * (self.measured_angular_velocity - self.bias - expected)
        self.estimate = replace(self.estimate, angular_velocity=rates)

    def coast(self) -> None:
        carried = self.carry(True)
        self.advance(0.5 * (self.estimate.angular_velocity + carried.angular_velocity))
        self.estimate = carried

    def bound(self) -> None:
        """The filter's yaw is free; put out what it knows of it."""
        self.estimated_gyro_bias = self.bias
        variance = element(self.covariance, 6, YAW, YAW)
        if variance > 0.0:
            self.yaw_sigma = math.sqrt(variance)
        elif self.usable:
            self.yaw_sigma = 0.0
            self.status = ObserverStatus.NOT_POSITIVE
