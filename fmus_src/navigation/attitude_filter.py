"""Filter of measured quaternions for errors of attitude and angular velocity relative to a plan."""

import math

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import body, robot, sampling
from ..interfaces.ports.robot import FilterMethod, SampleStatus
from ..kernel.matrices import zeros
from ..mathlib.attitude.quaternion import (
    angle_error,
    difference,
    from_rotation_vector,
    is_attitude,
    multiply,
    normalise,
    to_body,
    to_rotation_vector,
)
from ..mathlib.estimation.tracking import DISTURBANCE, RATE, TRACKED, measure_chain, predict_triple
from ..mathlib.vectors import cross, dot, is_finite, vector

# Inputs with direct effect on outputs: all except the jets' torque, which acted in the last step.
AT_ONCE = ("measured_quaternion", "sample_count", "planned_quaternion", "planned_angular_velocity", "gyro_momentum")


class AttitudeFilter(Block):
    """Filter of the errors of attitude and angular velocity relative to a plan, in body axes.

    With the error quaternion (e_0, e) = planned^-1 estimated, the attitude error is 2 e_0 e.

    method 0: mean of the last mean_samples errors; the rate error is the difference of the last two means divided by
    the time between them.

    method 1: Kalman filter of attitude, angular velocity and disturbance, equal for all axes. Between samples the
    angular momentum G is conserved except for the torque M of the jets and the disturbance d:

        G^+ = C (G + (M + J d) h/2) + (M + J d) h/2    ω^+ = J^-1 (G^+ - H^+)

    with the rotation C to the new body axes and the gyros' momentum H from the gimbal angles. jet_torque and jet_force
    refer to the last step. When the jets' force changes, the variance of the disturbance grows by the square of
    jet_torque_error times the change; process_noise and disturbance_noise model all other changes.

    Samples that are not finite or not an attitude are skipped and reported; without a planned attitude the errors keep
    their values.

    Frame: body; quaternions from body to inertial.

    Assumes small errors relative to the plan, and known inertia and jets.

    Source: Bar-Shalom, Li and Kirubarajan 2001, section 6.2; Lefferts, Markley and Shuster 1982 (error in body axes).
    See docs/theory/rendezvous.md.
    """

    default_step = 0.125

    method = Parameter(
        FilterMethod, start=FilterMethod.KALMAN, description="estimation method of the attitude and rate errors"
    )
    mean_samples = Parameter(
        2, minimum=1, description="number of sensor samples per mean, as many as in one attitude control period"
    )
    inertia = Parameter(
        [812.0, 587.0, 910.0],
        unit="kg.m2",
        minimum=1e-3,
        description="principal moments of inertia of the robot about x, y and z",
    )
    attitude_sigma = Parameter(
        4.84813681109536e-6, unit="rad", minimum=1e-12, description="error of a measured attitude, 1 sigma per axis"
    )
    first_rate_sigma = Parameter(
        1e-4,
        unit="rad/s",
        minimum=0.0,
        description="initial error of the angular velocity relative to the plan, 1 sigma per axis",
    )
    process_noise = Parameter(
        1e-16, minimum=0.0, description="spectral density of the angular acceleration noise, rad2/s3"
    )
    first_disturbance_sigma = Parameter(
        0.0, unit="rad/s2", minimum=0.0, description="initial angular acceleration of the disturbance, 1 sigma per axis"
    )
    disturbance_noise = Parameter(
        1e-18,
        minimum=0.0,
        description="spectral density of the white noise in the disturbance's time derivative, rad2/s5",
    )
    jet_torque_error = Parameter(
        1e-4, unit="m", minimum=0.0, description="error of jet_torque per change of jet_force, 1 sigma per axis"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.125, "sample period of the filter; 0: a sample at every communication point"
    )
    measured_quaternion = robot.MEASURED_QUATERNION.input()
    sample_count = sampling.SAMPLE_COUNT.input(
        "number of sensor samples since the start; a change signals a new sample"
    )
    planned_quaternion = robot.PLANNED_QUATERNION.input()
    planned_angular_velocity = body.ANGULAR_VELOCITY.input(
        "planned angular velocity of the robot relative to the inertial frame"
    )
    gyro_momentum = body.ANGULAR_MOMENTUM.input("angular momentum of the gyro cluster, computed from its gimbal angles")
    jet_torque = body.TORQUE.input("mean torque of the jets since the last communication point")
    jet_force = body.FORCE.input("mean force of the jets since the last communication point")
    attitude_error = body.ROTATION.output(
        "error of the estimated attitude relative to the plan: rotation axis times sine of the angle", direct=AT_ONCE
    )
    rate_error = body.ANGULAR_VELOCITY.output("estimated minus planned angular velocity", direct=AT_ONCE)
    quaternion = robot.QUATERNION.output(direct=AT_ONCE)
    disturbance = body.ANGULAR_ACCELERATION.output(
        "estimated angular acceleration that neither gyros nor commanded jets cause", direct=AT_ONCE
    )
    attitude_error_sigma = Output(
        0.0, unit="rad", direct=AT_ONCE, description="standard deviation of attitude_error per axis; 0: unknown"
    )
    rate_error_sigma = Output(
        0.0, unit="rad/s", direct=AT_ONCE, description="standard deviation of rate_error per axis; 0: unknown"
    )
    innovation_square = sampling.INNOVATION_SQUARE.output(direct=AT_ONCE)
    samples_taken = sampling.SAMPLES_TAKEN.output(direct=AT_ONCE)
    status = Output(SampleStatus, direct=AT_ONCE)
    angular_velocity = body.ANGULAR_VELOCITY.state(
        "angular velocity relative to the inertial frame estimated by the Kalman filter"
    )
    covariance = State(
        zeros(3, 3),
        frozen=True,
        description="covariance matrix of attitude, angular rate and disturbance of one axis, SI units",
    )
    last_time = State(0.0, unit="s", description="time of the last filter step")
    start_time = sampling.START_TIME.state()
    last_momentum = body.ANGULAR_MOMENTUM.state("angular momentum of the gyro cluster at the last filter step")
    last_force = body.FORCE.state("mean force of the jets used at the last filter step")
    counted = State(0, description="sample_count of the last sample used")
    mean_time = State(0.0, unit="s", description="time of the last computed mean")
    total = body.ROTATION.state("sum of the measured attitude errors since the last mean")
    summed = State(0, description="number of samples in the sum of attitude errors")
    means = State(0, description="number of means computed since the start")

    def initialize(self) -> None:
        self.last_time = self.start_time
        self.mean_time = self.start_time
        self.last_momentum = self.gyro_momentum
        self.angular_velocity = self.planned_angular_velocity
        if is_attitude(self.planned_quaternion):
            self.quaternion = self.planned_quaternion
        self.covariance[RATE, RATE] = self.first_rate_sigma * self.first_rate_sigma
        self.covariance[DISTURBANCE, DISTURBANCE] = self.first_disturbance_sigma * self.first_disturbance_sigma
        self.take_sample()
        if self.summed > 0:
            self.output_mean(self.start_time)
        self.publish()

    def increase_disturbance_variance(self) -> None:
        """Increase the variance of the disturbance according to the change of the jets' force."""
        jump = self.jet_force - self.last_force
        self.last_force = self.jet_force
        scale = 3.0 * self.jet_torque_error / (self.inertia.x + self.inertia.y + self.inertia.z)
        self.covariance[DISTURBANCE, DISTURBANCE] += scale * scale * dot(jump, jump)

    def predict(self, h: float) -> None:
        """Propagate estimate and covariance by h (s); only jets and disturbance change the total angular momentum."""
        momentum_body = self.inertia * self.angular_velocity + self.last_momentum
        # half of the change by jets and disturbance over h; the rotation has the rate of the middle
        impulse_body = 0.5 * h * (self.jet_torque + self.inertia * self.disturbance)
        selected = 0.5 * (h * cross(self.angular_velocity, momentum_body) + self.gyro_momentum - self.last_momentum)
        rotation = from_rotation_vector(h * (self.angular_velocity + (impulse_body - selected) / self.inertia))
        self.quaternion = normalise(multiply(self.quaternion, rotation))
        momentum_body = to_body(rotation, momentum_body + impulse_body) + impulse_body
        self.angular_velocity = (momentum_body - self.gyro_momentum) / self.inertia
        self.increase_disturbance_variance()
        self.covariance = predict_triple(self.covariance, self.process_noise, self.disturbance_noise, h)

    def take_sample(self) -> None:
        """Process the sample if it is new."""
        if self.sample_count == self.counted:
            return
        self.counted = self.sample_count
        if not (math.isfinite(self.measured_quaternion.w) and is_finite(self.measured_quaternion[1:4])):
            self.status = SampleStatus.NOT_FINITE
            return
        compared = self.method != FilterMethod.MEAN or is_attitude(self.planned_quaternion)
        if not (compared and is_attitude(self.measured_quaternion)):
            self.status = SampleStatus.NO_ATTITUDE
            return
        self.status = SampleStatus.GOOD
        self.samples_taken = self.samples_taken + 1
        if self.method == FilterMethod.MEAN:
            self.total = self.total + angle_error(self.planned_quaternion, self.measured_quaternion)
            self.summed = self.summed + 1
        elif self.samples_taken == 1:
            self.quaternion = normalise(self.measured_quaternion)
            self.covariance[TRACKED, :] = vector(0.0, 0.0, 0.0)
            self.covariance[:, TRACKED] = vector(0.0, 0.0, 0.0)
            self.covariance[TRACKED, TRACKED] = self.attitude_sigma * self.attitude_sigma
        else:
            self.correct()

    def correct(self) -> None:
        """Correct the Kalman filter by the measured quaternion."""
        innovation = to_rotation_vector(difference(self.quaternion, self.measured_quaternion))
        gain, self.covariance, variance = measure_chain(self.covariance, self.attitude_sigma * self.attitude_sigma)
        square = innovation * innovation / variance
        self.innovation_square = 0.0 + square.x + square.y + square.z
        self.angular_velocity = self.angular_velocity + gain[RATE, 0] * innovation
        self.disturbance = self.disturbance + gain[DISTURBANCE, 0] * innovation
        turned = from_rotation_vector(gain[TRACKED, 0] * innovation)
        self.quaternion = normalise(multiply(self.quaternion, turned))

    def output_mean(self, time: float) -> None:
        """Output the mean of the samples since the previous mean, at ``time`` (s)."""
        elapsed = time - self.mean_time
        mean = self.total / float(self.summed)
        if self.means > 0 and elapsed > 0.0:
            self.rate_error = (mean - self.attitude_error) / elapsed
        self.attitude_error = mean
        self.total = vector(0.0, 0.0, 0.0)
        self.summed = 0
        self.means = self.means + 1
        self.mean_time = time

    def publish(self) -> None:
        """Output errors and standard deviations."""
        if not is_attitude(self.planned_quaternion):
            self.status = SampleStatus.NO_ATTITUDE
            return
        if self.method == FilterMethod.MEAN:
            # the estimated attitude is the planned attitude rotated by the error
            self.quaternion = multiply(self.planned_quaternion, from_rotation_vector(self.attitude_error))
            return
        self.attitude_error = angle_error(self.planned_quaternion, self.quaternion)
        rotation = difference(self.planned_quaternion, self.quaternion)
        self.rate_error = self.angular_velocity - to_body(rotation, self.planned_angular_velocity)
        self.attitude_error_sigma = math.sqrt(self.covariance[TRACKED, TRACKED])
        self.rate_error_sigma = math.sqrt(self.covariance[RATE, RATE])

    def step(self, t: float, h: float) -> None:
        if self.method != FilterMethod.MEAN:
            self.predict(t + h - self.last_time)
        self.take_sample()
        if self.summed >= self.mean_samples:
            self.output_mean(t + h)
        self.last_momentum = self.gyro_momentum
        self.last_time = t + h
        self.publish()
