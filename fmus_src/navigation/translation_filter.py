"""Filter of measured relative positions for errors of position and velocity relative to a plan."""

import math

from ..block import Block, Output, Parameter, State
from ..interfaces.ports import body, inertial, landing, robot, sampling
from ..interfaces.ports.robot import FilterMethod, SampleStatus
from ..kernel.matrices import zeros
from ..mathlib.attitude.quaternion import is_attitude, normalise, to_reference
from ..mathlib.estimation.tracking import RATE, TRACKED, measure_chain, predict_pair
from ..mathlib.vectors import Vector3, is_finite, norm, vector

# Inputs with direct effect on outputs: all except the force, which acted in the last step.
AT_ONCE = (
    "relative_position",
    "sample_count",
    "planned_relative_position",
    "planned_velocity",
    "translation_count",
    "quaternion",
)


class TranslationFilter(Block):
    """Filter of the robot's errors of position and velocity relative to its plan.

    method 0: mean of the samples since the last sample of translation control; the velocity error is the difference of
    the last two means divided by the time between them.

    method 1: Kalman filter of the position error x and velocity error v, equal for all inertial axes, propagated by the
    commanded force P of the jets minus the planned acceleration:

        x' = v    v' = R(q) P/m - a_p + w    S_w = process_noise + (ε P/m)^2 τ

    with force_error ε and force_error_time τ. w is white noise of spectral density S_w. allocated_force refers to the
    last step. The standard deviation of a measurement is far_sigma, and near_sigma at ranges below near_range. Samples
    that are not finite are skipped and reported; without a valid attitude the last valid one rotates the force.

    Frames: inertial, except for the force, in body axes.

    Assumes equal errors in all axes, and a known mass.

    Source: Bar-Shalom, Li and Kirubarajan 2001, section 6.2.2. See docs/theory/rendezvous.md.
    """

    default_step = 0.125

    method = Parameter(
        FilterMethod, start=FilterMethod.KALMAN, description="estimation method of the position and velocity errors"
    )
    mass = landing.MASS.parameter(1000.0, "mass of the robot", minimum=1e-3)
    far_sigma = robot.FAR_SIGMA.parameter()
    near_sigma = robot.NEAR_SIGMA.parameter()
    near_range = robot.NEAR_RANGE.parameter()
    first_velocity_sigma = Parameter(
        0.02,
        unit="m/s",
        minimum=0.0,
        description="initial error of the velocity relative to the plan, 1 sigma per axis",
    )
    process_noise = Parameter(
        1e-13, unit="m2/s3", minimum=0.0, description="spectral density of the robot's acceleration noise"
    )
    force_error = Parameter(0.001, unit="1", minimum=0.0, description="relative error of the commanded force, 1 sigma")
    force_error_time = Parameter(10.0, unit="s", minimum=0.0, description="correlation time of the force error")
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.125, "sample period of the filter; 0: a sample at every communication point"
    )
    relative_position = inertial.POSITION.input("measured position of the object relative to the robot")
    sample_count = sampling.SAMPLE_COUNT.input(
        "number of ranger samples since the start; a change signals a new sample"
    )
    planned_relative_position = inertial.POSITION.input("planned position of the object relative to the robot")
    planned_velocity = inertial.VELOCITY.input("planned velocity of the robot")
    translation_count = robot.TRANSLATION_COUNT.input(
        "number of translation control samples since the start; a change signals a new sample"
    )
    quaternion = robot.QUATERNION.input("estimated attitude quaternion from body to inertial, scalar first")
    allocated_force = body.FORCE.input("force commanded to the jets since the last communication point")
    position_error = inertial.POSITION.output("error of the robot's position relative to its plan", direct=AT_ONCE)
    velocity_error = inertial.VELOCITY.output("error of the robot's velocity relative to its plan", direct=AT_ONCE)
    position_error_sigma = Output(
        0.0,
        unit="m",
        direct=AT_ONCE,
        description="standard deviation of position_error per axis; 0: unknown",
    )
    velocity_error_sigma = Output(
        0.0,
        unit="m/s",
        direct=AT_ONCE,
        description="standard deviation of velocity_error per axis; 0: unknown",
    )
    innovation_square = sampling.INNOVATION_SQUARE.output(direct=AT_ONCE)
    samples_taken = sampling.SAMPLES_TAKEN.output(direct=AT_ONCE)
    status = Output(SampleStatus, direct=AT_ONCE)
    covariance = State(
        zeros(2, 2), frozen=True, description="covariance matrix of position and velocity of one axis, SI units"
    )
    last_time = State(0.0, unit="s", description="time of the last filter step")
    start_time = sampling.START_TIME.state()
    last_velocity = inertial.VELOCITY.state("planned velocity of the robot at the last filter step")
    last_quaternion = State(
        [1.0, 0.0, 0.0, 0.0],
        unit="1",
        description="estimated attitude quaternion from body to inertial at the last filter step",
    )
    counted = State(0, description="sample_count of the last sample used")
    ticks = State(0, description="translation_count of the last translation control sample")
    tick_time = State(0.0, unit="s", description="time of the last computed mean")
    total = inertial.POSITION.state("sum of the measured position errors since the last translation control sample")
    summed = State(0, description="number of samples in the sum of position errors")
    means = State(0, description="number of means computed since the start")

    def initialize(self) -> None:
        self.last_time = self.start_time
        self.tick_time = self.start_time
        self.ticks = self.translation_count
        self.last_velocity = self.planned_velocity
        self.remember_attitude()
        self.covariance[RATE, RATE] = self.first_velocity_sigma * self.first_velocity_sigma
        self.take_sample()
        if self.method == FilterMethod.MEAN:
            self.output_mean(self.start_time)
        self.publish()

    def remember_attitude(self) -> None:
        """Store a valid attitude for the next step."""
        if is_attitude(self.quaternion):
            self.last_quaternion = self.quaternion

    def sigma_now(self) -> float:
        """Return the standard deviation (m) of a sample at the range of the last sample."""
        if norm(self.relative_position) < self.near_range:
            return self.near_sigma
        return self.far_sigma

    def predict(self, h: float) -> None:
        """Propagate estimate and covariance by h (s)."""
        middle = normalise(self.last_quaternion)
        if is_attitude(self.quaternion):
            middle = normalise(self.last_quaternion + self.quaternion)
        force_inertial = to_reference(middle, self.allocated_force)
        uncertain = self.force_error * norm(force_inertial) / self.mass
        density = self.process_noise + uncertain * uncertain * self.force_error_time
        self.covariance = predict_pair(self.covariance, density, h)
        gained = force_inertial / self.mass * h - (self.planned_velocity - self.last_velocity)
        self.position_error = self.position_error + h * (self.velocity_error + 0.5 * gained)
        self.velocity_error = self.velocity_error + gained

    def take_sample(self) -> None:
        """Process the sample if it is new."""
        if self.sample_count == self.counted:
            return
        self.counted = self.sample_count
        error = self.planned_relative_position - self.relative_position
        if not is_finite(error):
            self.status = SampleStatus.NOT_FINITE
            return
        self.status = SampleStatus.GOOD
        self.samples_taken = self.samples_taken + 1
        if self.method == FilterMethod.MEAN:
            self.total = self.total + error
            self.summed = self.summed + 1
        elif self.samples_taken == 1:
            sigma = self.sigma_now()
            self.covariance[TRACKED, TRACKED] = sigma * sigma
            self.covariance[TRACKED, RATE] = 0.0
            self.covariance[RATE, TRACKED] = 0.0
            self.position_error = error
        else:
            self.correct(error)

    def correct(self, error: Vector3) -> None:
        """Correct the Kalman filter by a measured position error (m)."""
        sigma = self.sigma_now()
        gain, self.covariance, variance = measure_chain(self.covariance, sigma * sigma)
        innovation = error - self.position_error
        square = innovation * innovation / variance
        self.innovation_square = 0.0 + square.x + square.y + square.z
        self.position_error = self.position_error + gain[TRACKED, 0] * innovation
        self.velocity_error = self.velocity_error + gain[RATE, 0] * innovation

    def output_mean(self, time: float) -> None:
        """Output the mean of the samples since the last sample of translation control, at ``time`` (s)."""
        if self.summed == 0:
            return
        elapsed = time - self.tick_time
        mean = self.total / float(self.summed)
        if self.means > 0 and elapsed > 0.0:
            self.velocity_error = (mean - self.position_error) / elapsed
        self.position_error = mean
        self.total = vector(0.0, 0.0, 0.0)
        self.summed = 0
        self.means = self.means + 1
        self.tick_time = time

    def publish(self) -> None:
        """Output the standard deviations."""
        if self.method != FilterMethod.MEAN:
            self.position_error_sigma = math.sqrt(self.covariance[TRACKED, TRACKED])
            self.velocity_error_sigma = math.sqrt(self.covariance[RATE, RATE])

    def step(self, t: float, h: float) -> None:
        elapsed = t + h - self.last_time
        if self.method != FilterMethod.MEAN:
            self.predict(elapsed)
        self.take_sample()
        if self.translation_count != self.ticks:
            self.ticks = self.translation_count
            if self.method == FilterMethod.MEAN:
                self.output_mean(t + h)
        if self.method != FilterMethod.MEAN and not is_attitude(self.quaternion):
            self.status = SampleStatus.NO_ATTITUDE
        self.last_velocity = self.planned_velocity
        self.remember_attitude()
        self.last_time = t + h
        self.publish()
