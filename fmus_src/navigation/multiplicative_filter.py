"""Base of multiplicative filters: attitude and gyro bias, propagated by gyros."""

from ..block import State
from ..interfaces.ports import body, sampling
from ..kernel.matrices import Matrix, identity, zeros
from ..mathlib.attitude.quaternion import from_rotation_vector, multiply, normalise
from ..mathlib.estimation.attitude_errors import BIAS, ROTATION, predict_attitude, standard_deviations
from ..mathlib.vectors import Vector3, is_finite, vector
from .attitude_navigation import AttitudeNavigation, AttitudeNavigationStatus


class MultiplicativeFilter(AttitudeNavigation, interface=True):
    """Multiplicative filter: prediction by gyros, correction by a small rotation in body axes and a change of bias.

    The attitude is propagated with the mean of the last two gyro samples minus the bias, or, while no new sample has
    arrived, with the last sample minus the bias. With mean rate ω, angle random walk σ_v, rate random walk σ_u and
    cross-product matrix [·]:

        δθ' = -[ω] δθ - δb    δb' = 0
        Q_11 = σ_v^2 h + σ_u^2 h^3/3    Q_12 = -σ_u^2 h^2/2    Q_22 = σ_u^2 h

    Source: Lefferts, Markley and Shuster 1982; Crassidis and Junkins 2012, section 7.2.
    """

    rate = body.ANGULAR_VELOCITY.state("last finite angular velocity measured by the gyros")
    covariance = State(
        zeros(6, 6), frozen=True, description="covariance matrix of attitude error and gyro bias error, SI units"
    )
    start_time = sampling.START_TIME.state()
    last_time = State(0.0, unit="s", description="time of the last filter update")
    gyro_counted = State(0, description="gyro_count of the last gyro sample used")
    begun = State(False, description="true: filter initialised with a first attitude measurement")
    turn = body.ROTATION.state("rotation vector since the last update, integrated from the gyros")

    def begin(self) -> None:
        """Initialise the filter without an attitude."""
        self.last_time = self.start_time
        self.gyro_counted = self.gyro_count - 1
        sigma = self.first_bias_sigma
        self.covariance[ROTATION, ROTATION] = identity(3)
        self.covariance[BIAS, BIAS] = sigma * sigma * identity(3)
        self.rate = self.gyro_rate()

    def gyro_rate(self) -> Vector3:
        """Return the new gyro sample (rad/s, body) if it is finite, otherwise the last finite sample."""
        self.status = AttitudeNavigationStatus.GOOD
        if self.gyro_count == self.gyro_counted:
            return self.rate
        self.gyro_counted = self.gyro_count
        if is_finite(self.measured_angular_velocity):
            return self.measured_angular_velocity
        self.status = AttitudeNavigationStatus.NO_GYROS
        return self.rate

    def predict(self, h: float) -> None:
        """Propagate attitude and covariance by h (s) with the gyros."""
        rate = self.gyro_rate()
        self.turn = h * (0.5 * (self.rate + rate) - self.estimated_bias)
        self.rate = rate
        self.estimated_quaternion = normalise(multiply(self.estimated_quaternion, from_rotation_vector(self.turn)))
        self.covariance = predict_attitude(self.covariance, self.turn, self.gyro_random_walk, self.bias_random_walk, h)

    def correct(self, x: Matrix) -> None:
        """Correct attitude and bias by estimated errors (6 x 1)."""
        turn = from_rotation_vector(vector(x[0, 0], x[1, 0], x[2, 0]))
        self.estimated_quaternion = normalise(multiply(self.estimated_quaternion, turn))
        self.estimated_bias = self.estimated_bias + vector(x[3, 0], x[4, 0], x[5, 0])

    def report(self) -> None:
        """Output angular velocity and standard deviations."""
        self.estimated_angular_velocity = self.rate - self.estimated_bias
        self.attitude_sigma = standard_deviations(self.covariance, 0)
        self.bias_sigma = standard_deviations(self.covariance, 3)
