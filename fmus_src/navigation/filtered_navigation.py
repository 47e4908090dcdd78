"""Base of navigation with an inertial sensor and a Kalman filter; subclasses define the covariance computations."""

import math

from ..block import Output, Parameter, State
from ..interfaces.ports import landing, sampling
from ..kernel.enumerations import Enumeration, member
from ..kernel.matrices import Matrix, block, zeros
from ..mathlib.estimation.inertial import MOTION_STATES, POSITION, STATES, VELOCITY, sensor_addition, start_errors
from ..mathlib.lunar.gravity import from_centre
from ..mathlib.vectors import Vector3, norm, vector
from ..units import deg
from .inertial_navigation import InertialNavigation

SENSOR_ERRORS = block(6, 9)  # indices of these states
ALTIMETER = 0
VELOCIMETER = 1
CAMERA = 2


class FilterStatus(Enumeration):
    """Status of the last samples."""

    GOOD = member("good")
    REJECTED = member("last sample of a sensor rejected")
    LOCKED_OUT = member("last rejection_limit samples of a sensor rejected")
    NOT_POSITIVE = member("variance negative")


class FilteredNavigation(InertialNavigation, interface=True):
    """Inertial navigation corrected by an extended Kalman filter from altitude, velocity and position.

    The fifteen states are the errors of position and velocity, and the inertial sensor's bias b, scale factors k and
    misalignment w. The estimated sensor errors are subtracted from the measured specific force f. Errors propagate as

        a = b + diag(k) f + w × f    δr^+ = δr + h δv - (h^2/2) a    δv^+ = δv - h a

    If scale_factor_sigma and attitude_sigma are 0, nine states remain. All sigmas and random walks are assumptions of
    the filter, independent of the values in the sensors. Samples are processed at every communication point, scalar by
    scalar: altitude, velocity, position. A scalar is rejected if its innovation exceeds innovation_gate standard
    deviations; rejection_limit consecutive rejections of a sensor set the status and, with reacquire, increase the
    covariance so that the sample is accepted. With gravity_gradient the gradient of gravity enters the propagation,
    which matters for long coasts without measurements. In free flight the inertial sensor's errors have no effect.

    Frame: landing site.

    Assumes white sensor errors, except the constant errors of the inertial sensor.

    Source: Bar-Shalom, Li and Kirubarajan 2001, sections 5.4 and 10.3; Groves 2013, chapter 14. See
    docs/systems/lunar_navigation.md.
    """

    to_write = ("predict", "variance_of_innovation", "correct")

    bias_sigma = landing.BIAS_SIGMA.parameter()
    scale_factor_sigma = landing.SCALE_FACTOR_SIGMA.parameter()
    attitude_sigma = Parameter(
        deg(0.02),
        unit="rad",
        minimum=0.0,
        description="constant attitude error of the accelerometer triad, 1 sigma per axis",
    )
    velocity_random_walk = landing.VELOCITY_RANDOM_WALK.parameter()
    bias_random_walk = Parameter(
        0.0, minimum=0.0, description="random walk of the accelerometer bias, m/s2 per square root of s"
    )
    altitude_relative_sigma = Parameter(
        0.005,
        unit="1",
        minimum=0.0,
        description="altitude measurement error proportional to altitude, as a fraction of the altitude, 1 sigma",
    )
    altitude_sigma = Parameter(
        1.0, unit="m", minimum=0.0, description="constant part of the altitude measurement error, 1 sigma"
    )
    velocity_relative_sigma = Parameter(
        0.001,
        unit="1",
        minimum=0.0,
        description="velocity measurement error proportional to speed, as a fraction of it, 1 sigma per axis",
    )
    velocity_sigma = landing.VELOCITY_SIGMA.parameter()
    position_relative_sigma = Parameter(
        0.0015,
        unit="1",
        minimum=0.0,
        description="position measurement error proportional to altitude, as a fraction of it, 1 sigma per axis",
    )
    position_sigma = landing.POSITION_SIGMA.parameter()
    gravity_gradient = Parameter(False, description="true: gravity gradient included in the covariance propagation")
    innovation_gate = Parameter(
        5.0,
        unit="1",
        minimum=0.0,
        description=(
            "largest innovation of an accepted scalar measurement, in standard deviations; 0: all measurements accepted"
        ),
    )
    rejection_limit = Parameter(
        5, minimum=1, description="number of consecutive rejected samples of a sensor at which status becomes 2"
    )
    reacquire = Parameter(
        False,
        description="true: covariance increased until a sensor that was rejected rejection_limit times is accepted",
    )
    estimated_bias = landing.ACCELERATION.output("estimated bias of the measured specific force", direct=True)
    innovation_square = sampling.INNOVATION_SQUARE.output(
        "normalised innovation squared of the last scalar measurement, accepted or rejected", direct=True
    )
    altitude_innovation_square = Output(
        0.0, unit="1", direct=True, description="normalised innovation squared of the last altitude sample"
    )
    velocity_innovation_square = Output(
        0.0,
        unit="1",
        direct=True,
        description="normalised innovation squared of the last velocity sample, sum over three components",
    )
    position_innovation_square = Output(
        0.0,
        unit="1",
        direct=True,
        description="normalised innovation squared of the last position sample, sum over three components",
    )
    rejected_count = Output(
        0, direct=True, description="number of scalar measurements rejected by the gate since the start"
    )
    status = Output(FilterStatus, direct=True)
    sensor_errors = State(
        zeros(9, 1),
        description=(
            "estimated errors of the inertial sensor, three axes each: bias (m/s2), scale factor, misalignment (rad)"
        ),
    )
    covariance = State(
        zeros(15, 15), frozen=True, description="covariance matrix of the fifteen filter states, SI units"
    )
    rejected_in_a_row = State(
        [0] * 3, description="numbers of consecutive samples with a rejected component: altitude, velocity, position"
    )

    def predict(self, h: float) -> None:
        """Propagate the covariance by h (s) under the specific force."""

    def variance_of_innovation(self, row: Matrix, variance: float) -> float:
        """Return the variance of a scalar's innovation; ``row`` contains its derivatives with respect to the states."""
        return 0.0

    def correct(self, row: Matrix, innovation: float, s: float, variance: float) -> Matrix:
        """Update the covariance; return the corrections of the states by the innovation, as a column."""
        return zeros(STATES, 1)

    def initialize(self) -> None:
        self.initialise_estimate()
        self.covariance = start_errors(
            self.first_position_sigma,
            self.first_velocity_sigma,
            self.bias_sigma,
            self.scale_factor_sigma,
            self.attitude_sigma,
        )
        self.measure()
        self.publish()

    def compensate(self) -> None:
        """Subtract the estimated errors of the inertial sensor from the specific force."""
        if not self.free_flight:
            bias = self.sensor_errors[0:3, 0]
            scale_factor = self.sensor_errors[3:6, 0]
            rotation = self.sensor_errors[6:9, 0]
            self.force = self.force - sensor_addition(bias, scale_factor, rotation, self.force)

    def local_gradient(self) -> tuple[Vector3, float]:
        """Return the upward direction and the gravity gradient (1/s2), which is 0 if it is neglected."""
        up = from_centre(self.estimated_position, self.moon_radius)
        distance = norm(up)
        if self.gravity_gradient and distance > 0.0:
            return up / distance, self.gravitational_parameter / (distance * distance * distance)
        return up, 0.0

    def altitude(self, row: Matrix) -> float:
        """Return the estimated altitude (m); set ``row`` to its derivatives with respect to the states."""
        up = from_centre(self.estimated_position, self.moon_radius)
        distance = norm(up)
        if distance > 0.0:
            up = up / distance
        row[0, POSITION] = up
        return distance - self.moon_radius

    def process_scalar(self, sensor: int, row: Matrix, innovation: float, sigma: float) -> float:
        """Process or reject a scalar; return its normalised innovation squared."""
        variance = sigma * sigma
        s = self.variance_of_innovation(row, variance)
        if not s > 0.0:
            return 0.0  # neither estimate nor sensor has an error
        square = innovation * innovation / s
        self.innovation_square = square
        if self.innovation_gate > 0.0 and not square <= self.innovation_gate * self.innovation_gate:
            trusted = self.reacquire and self.rejected_in_a_row[sensor] >= self.rejection_limit
            if not trusted or not math.isfinite(square) or s <= variance:
                self.rejected_count = self.rejected_count + 1
                return square
            growth = (innovation * innovation - variance) / (s - variance)  # makes the innovation one sigma
            self.covariance = growth * self.covariance
            s = self.variance_of_innovation(row, variance)
        correction = self.correct(row, innovation, s, variance)
        self.estimated_position = self.estimated_position + correction[POSITION, 0]
        self.estimated_velocity = self.estimated_velocity + correction[VELOCITY, 0]
        self.sensor_errors = self.sensor_errors + correction[SENSOR_ERRORS, :]
        return square

    def count_sample(self, sensor: int, rejected_before: int) -> None:
        """Count a processed sample, and update the sensor's number of consecutive rejections."""
        self.sample_count = self.sample_count + 1
        if self.rejected_count > rejected_before:
            self.rejected_in_a_row[sensor] = self.rejected_in_a_row[sensor] + 1
        else:
            self.rejected_in_a_row[sensor] = 0

    def measure(self) -> None:
        """Process the new samples."""
        radial = zeros(1, STATES)
        before = self.rejected_count
        if self.altitude_count != self.altitude_taken:
            self.altitude_taken = self.altitude_count
            altitude = self.altitude(radial)
            sigma = self.altitude_relative_sigma * abs(altitude) + self.altitude_sigma
            innovation = self.measured_altitude - altitude
            self.altitude_innovation_square = self.process_scalar(ALTIMETER, radial, innovation, sigma)
            self.count_sample(ALTIMETER, before)
        before = self.rejected_count
        if self.velocity_count != self.velocity_taken:
            self.velocity_taken = self.velocity_count
            sigma = self.velocity_relative_sigma * norm(self.estimated_velocity) + self.velocity_sigma
            total = 0.0
            for i in range(3):
                row = zeros(1, STATES)
                row[0, 3 + i] = 1.0
                square = self.process_scalar(
                    VELOCIMETER, row, self.measured_velocity[i] - self.estimated_velocity[i], sigma
                )
                total = total + square
            self.velocity_innovation_square = total
            self.count_sample(VELOCIMETER, before)
        before = self.rejected_count
        if self.position_count != self.position_taken:
            self.position_taken = self.position_count
            altitude = self.altitude(radial)
            sigma = self.position_relative_sigma * abs(altitude) + self.position_sigma
            total = 0.0
            for i in range(3):
                row = zeros(1, STATES)
                row[0, i] = 1.0
                square = self.process_scalar(CAMERA, row, self.measured_position[i] - self.estimated_position[i], sigma)
                total = total + square
            self.position_innovation_square = total
            self.count_sample(CAMERA, before)

    def publish(self) -> None:
        """Output sigmas, covariance, bias and status."""
        self.status = FilterStatus.GOOD
        self.estimated_bias = self.sensor_errors[0:3, 0]
        for i in range(3):
            if self.rejected_in_a_row[i] >= self.rejection_limit:
                self.status = FilterStatus.LOCKED_OUT
            elif self.rejected_in_a_row[i] > 0 and self.status == FilterStatus.GOOD:
                self.status = FilterStatus.REJECTED
        k = 0
        for i in range(MOTION_STATES):
            for j in range(i, MOTION_STATES):
                self.estimate_covariance[k] = self.covariance[i, j]
                k = k + 1
        for i in range(STATES):
            if not self.covariance[i, i] >= 0.0:
                self.status = FilterStatus.NOT_POSITIVE
        sigmas = [0.0] * 6
        for i in range(6):
            variance = self.covariance[i, i]
            if variance > 0.0:
                sigmas[i] = math.sqrt(variance)
        self.position_estimate_sigma = vector(*sigmas[0:3])
        self.velocity_estimate_sigma = vector(*sigmas[3:6])

    def step(self, t: float, h: float) -> None:
        self.sense(h)
        self.compensate()
        self.move(h)
        self.predict(h)
        self.measure()
        self.publish()
