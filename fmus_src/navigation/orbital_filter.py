"""Observer of the orbital attitude by a Kalman filter driven by the gyros."""

import math

from ..block import Parameter, State
from ..interfaces.ports import body
from ..kernel.matrices import block, identity, zeros
from ..kernel.records import replace
from ..mathlib.estimation.kalman import predict, update
from ..mathlib.orbits.attitude import ANGLES, PITCH, ROLL, YAW, angle_rate_derivatives, angle_rates, evaluate_angles
from ..mathlib.vectors import Vector3, vector
from ..units import deg
from .attitude_observer import AttitudeObserver, ObserverStatus

BIASES = block(3, 3)  # indices of the gyro biases in the covariance, after the angles


class OrbitalFilter(AttitudeObserver):
    """Extended Kalman filter of angles and gyro biases, propagated by the gyros.

    Over a sample period the angles are propagated with the mean of two gyro samples minus the bias, plus a correction c
    of this mean for a pulse of length τ and sign s with torque M:

        c = J^-1 M s τ (T - τ)/(2 T)

    Roll and pitch correct angles and biases. Rates are propagated by the pulses and corrected by the gyros with
    rate_gain. While yaw is small, it is indistinguishable from the roll gyro's bias over ω_0: the initial bias limits
    the accuracy of the yaw estimate unless the body rotates about the yaw axis.

    Source: Bar-Shalom, Li and Kirubarajan 2001, section 10.3. See docs/systems/orbital_attitude.md.
    """

    first_yaw_sigma = Parameter(
        deg(10.0), unit="rad", minimum=0.0, description="initial error of the estimated yaw, 1 sigma"
    )
    rate_gain = Parameter(
        0.15,
        unit="1",
        minimum=0.0,
        maximum=1.0,
        description="weight of a gyro sample in the estimated angular velocity",
    )
    bias = body.ANGULAR_VELOCITY.state("estimated bias of the gyros")
    covariance = State(
        [0.0] * 36, columns=6, frozen=True, description="covariance matrix of attitude angles and gyro biases, SI units"
    )

    def begin(self) -> bool:
        self.covariance[ANGLES, ANGLES] = self.vertical_sigma * self.vertical_sigma * identity(3)
        self.covariance[BIASES, BIASES] = self.gyro_bias_sigma * self.gyro_bias_sigma * identity(3)
        self.covariance[YAW, YAW] = self.first_yaw_sigma * self.first_yaw_sigma
        return True

    def predict_covariance(self, angles: Vector3, w: Vector3) -> None:
        """Propagate the covariance over a sample period, linearised at its middle angles (rad) and rates (rad/s)."""
        period = self.sample_period
        by_angles, by_rates = angle_rate_derivatives(evaluate_angles(angles), w, self.orbital_rate)
        f = identity(6)  # 1 + T df/dx, with rates minus biases
        f[ANGLES, ANGLES] = identity(3) + period * by_angles
        f[ANGLES, BIASES] = -period * by_rates
        walk = self.gyro_sigma * period
        q = zeros(6, 6)
        q[ANGLES, ANGLES] = walk * walk * identity(3)
        self.covariance = predict(self.covariance, f, q)

    def advance(self, w: Vector3) -> None:
        """Propagate angles and covariance over a sample period at the mean angular velocity w (rad/s, body)."""
        half = 0.5 * self.sample_period
        angles = self.estimate.angles
        middle = angles + half * angle_rates(evaluate_angles(angles), w, self.orbital_rate)
        self.predict_covariance(middle, w)
        turned = angles + self.sample_period * angle_rates(evaluate_angles(middle), w, self.orbital_rate)
        self.estimate = replace(self.estimate, angles=turned)

    def correct(self) -> None:
        """Update the estimate by measured roll and pitch."""
        x = zeros(6, 1)
        x[ANGLES, 0] = self.estimate.angles
        x[BIASES, 0] = self.bias
        variance = self.vertical_sigma * self.vertical_sigma
        of_roll = zeros(1, 6)
        of_roll[0, ROLL] = 1.0
        of_pitch = zeros(1, 6)
        of_pitch[0, PITCH] = 1.0
        x, self.covariance, _ = update(x, self.covariance, of_roll, variance, self.measured_roll)
        x, self.covariance, _ = update(x, self.covariance, of_pitch, variance, self.measured_pitch)
        self.estimate = replace(self.estimate, angles=x[ANGLES, 0])
        self.bias = x[BIASES, 0]

    def coning_correction(self) -> Vector3:
        """Return the mean angular velocity (rad/s, body) over a sample period with pulses minus the mean of the
        rates at both ends.
        """
        px, py, pz = self.fired_pulses
        period = self.sample_period
        after = vector(period - abs(px), period - abs(py), period - abs(pz))
        return self.inverse_inertia @ (self.jet_torque * self.fired_pulses * after / (2.0 * period))

    def observe(self) -> None:
        gained = self.sample_period * (self.inverse_inertia @ self.mean_torque(self.fired_pulses))
        mean = 0.5 * (self.last_rates + self.measured_angular_velocity)
        self.advance(mean + self.coning_correction() - self.bias)
        self.correct()
        expected = self.estimate.angular_velocity + gained
        rates = expected + self.rate_gain * (self.measured_angular_velocity - self.bias - expected)
        self.estimate = replace(self.estimate, angular_velocity=rates)

    def coast(self) -> None:
        carried = self.propagate_estimate(True)
        self.advance(0.5 * (self.estimate.angular_velocity + carried.angular_velocity))
        self.estimate = carried

    def bound(self) -> None:
        """Set the gyro bias and the standard deviation of yaw; yaw itself is not limited."""
        self.estimated_gyro_bias = self.bias
        variance = self.covariance[YAW, YAW]
        if variance > 0.0:
            self.yaw_sigma = math.sqrt(variance)
        elif self.usable:
            self.yaw_sigma = 0.0
            self.status = ObserverStatus.NOT_POSITIVE
