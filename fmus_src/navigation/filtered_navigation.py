"""What Kalman filters around an inertial navigation have in common: everything but the covariance's algebra."""

import math

from ..block import Output, Parameter, State
from ..interfaces.ports import landing, sampling
from ..kernel.enumerations import Enumeration, member
from ..kernel.matrices import element
from ..mathlib.estimation.inertial import STATES, sensor_addition, start_errors
from ..mathlib.lunar.gravity import from_centre
from ..mathlib.vectors import Vector3, norm, vector
from ..units import deg
from .inertial_navigation import InertialNavigation

ALTITUDE = 0
VELOCITY = 1
POSITION = 2


class FilterStatus(Enumeration):
    """What became of the last samples."""

    GOOD = member("good")
    REJECTED = member("a sensor's last sample was rejected")
    LOCKED_OUT = member("its last rejection_limit")
    NOT_POSITIVE = member("variance negative")


class FilteredNavigation(InertialNavigation, interface=True):
    """Inertial navigation whose errors an extended Kalman filter estimates from altitude, velocity and position.

    Fifteen states: errors of position and velocity, and the inertial sensor's bias, scale factors and
    misalignment, b + diag(k) f + w x f, which are taken off the measured specific force f. With
    scale_factor_sigma and attitude_sigma 0 nine states are left: position, velocity and bias. Every sigma and random
    walk of a sensor is an assumption and need not be the sensor's own. Samples are taken in at every communication
    point, scalar by scalar, altitude first, then velocity, then position. A scalar whose innovation is beyond
    innovation_gate of its own sigmas is rejected. The filter cannot tell a wrong sensor from
    a wrong estimate: a sensor whose samples are rejected rejection_limit times in a row is reported by
    the status and, with reacquire, believed again after the covariance has grown to fit it.
    In free flight the inertial sensor's errors are not taken off and add nothing to the covariance. With
    gravity_gradient velocity errors also grow by the difference of gravity that a position error makes, which
    counts where nothing is measured for a good part of an orbit.
    Frame: landing site. Equations: docs/systems/lunar_navigation.md.
    Source: Bar-Shalom, Li and Kirubarajan 2001, sections 5.4 and 10.3; Groves 2013, chapter 14.
    Assumes that sensors' errors are white, but for the inertial sensor's constants.
    """

    to_write = ("predict", "weigh", "take_in")

    bias_sigma = landing.BIAS_SIGMA.parameter()
    scale_factor_sigma = landing.SCALE_FACTOR_SIGMA.parameter()
    attitude_sigma = Parameter(
        deg(0.02), unit="rad", minimum=0.0, description="attitude knowledge, 1 sigma per axis, constant"
    )
    velocity_random_walk = landing.VELOCITY_RANDOM_WALK.parameter()
    bias_random_walk = Parameter(
        0.0, minimum=0.0, description="inertial sensor: random walk of bias, m/s2 per square root of s"
    )
    altitude_relative_sigma = Parameter(
        0.005, unit="1", minimum=0.0, description="error of a measured altitude, part of the altitude"
    )
    altitude_sigma = Parameter(1.0, unit="m", minimum=0.0, description="error of a measured altitude, constant part")
    velocity_relative_sigma = Parameter(
        0.001, unit="1", minimum=0.0, description="error of a measured velocity per axis, part of the speed"
    )
    velocity_sigma = landing.VELOCITY_SIGMA.parameter()
    position_relative_sigma = Parameter(
        0.0015, unit="1", minimum=0.0, description="error of a measured position per axis, part of the altitude"
    )
    position_sigma = landing.POSITION_SIGMA.parameter()
    gravity_gradient = Parameter(False, description="the covariance grows by the gradient of gravity, too")
    innovation_gate = Parameter(
        5.0, unit="1", minimum=0.0, description="reject scalars beyond so many sigmas of the innovation; 0: none"
    )
    rejection_limit = Parameter(5, minimum=1, description="samples of a sensor rejected in a row until status is 2")
    reacquire = Parameter(False, description="then let the covariance grow to fit the sensor, and believe it")
    estimated_bias = landing.ACCELERATION.output(
        "constant part of what the inertial sensor adds to the specific force", direct=True
    )
    innovation_square = sampling.INNOVATION_SQUARE.output(
        "normalised innovation squared of the last scalar, rejected or not", direct=True
    )
    altitude_innovation_square = Output(
        0.0, unit="1", direct=True, description="normalised innovation squared of the last altitude, one scalar"
    )
    velocity_innovation_square = Output(
        0.0, unit="1", direct=True, description="normalised innovation squared of the last velocity, three scalars"
    )
    position_innovation_square = Output(
        0.0, unit="1", direct=True, description="normalised innovation squared of the last position, three scalars"
    )
    rejected_count = Output(0, direct=True, description="scalars rejected by the gate")
    status = Output(FilterStatus, direct=True)
    sensor_errors = State([0.0] * 9, description="bias (m/s2), scale factor and misalignment (rad) per axis, estimated")
    covariance = State([0.0] * 225, frozen=True, description="covariance of the fifteen states, row order, SI")
    rejected_in_a_row = State([0] * 3, description="samples with a scalar rejected: altitude, velocity, position")

    def predict(self, h: float) -> None:
        """Predict the covariance h (s) ahead under the specific force."""

    def weigh(self, row: list, ph: list, variance: float) -> float:
        """Variance of a scalar's innovation; the covariance times the row of 15 in ph."""
        return 0.0

    def take_in(self, row: list, ph: list, innovation: float, s: float, variance: float, correction: list) -> None:
        """Update the covariance; correction (15 zeros) = what the innovation adds to the states."""

    def initialize(self) -> None:
        self.know()
        start_errors(
            self.covariance,
            self.first_position_sigma,
            self.first_velocity_sigma,
            self.bias_sigma,
            self.scale_factor_sigma,
            self.attitude_sigma,
        )
        self.measure()
        self.publish()

    def compensate(self) -> None:
        """Take the estimated errors of the inertial sensor off the specific force."""
        if not self.free_flight:
            bias = vector(*self.sensor_errors[0:3])
            scale_factor = vector(*self.sensor_errors[3:6])
            rotation = vector(*self.sensor_errors[6:9])
            self.force = self.force - sensor_addition(bias, scale_factor, rotation, self.force)

    def local_gradient(self) -> tuple[Vector3, float]:
        """Unit vector away from the Moon's centre; size of the gradient of gravity (1/s2), 0 where it is left out."""
        up = from_centre(self.estimated_position, self.moon_radius)
        distance = norm(up)
        if self.gravity_gradient and distance > 0.0:
            return up / distance, self.gravitational_parameter / (distance * distance * distance)
        return up, 0.0

    def altitude(self, row: list) -> float:
        """Estimated altitude (m); row[0:3] = its derivative by position."""
        up = from_centre(self.estimated_position, self.moon_radius)
        distance = norm(up)
        if distance > 0.0:
            up = up / distance
        for i in range(3):
            row[i] = up[i]
        return distance - self.moon_radius

    def consider(self, sensor: int, row: list, innovation: float, sigma: float) -> float:
        """Take a scalar in, or reject it; returns its normalised innovation squared."""
        variance = sigma * sigma
        ph = [0.0] * 15
        s = self.weigh(row, ph, variance)
        if not s > 0.0:
            return 0.0  # no error in estimate or sensor: nothing to learn
        square = innovation * innovation / s
        self.innovation_square = square
        if self.innovation_gate > 0.0 and not square <= self.innovation_gate * self.innovation_gate:
            trusted = self.reacquire and self.rejected_in_a_row[sensor] >= self.rejection_limit
            if not trusted or not math.isfinite(square) or s <= variance:
                self.rejected_count = self.rejected_count + 1
                return square
            growth = (innovation * innovation - variance) / (s - variance)  # makes it a one-sigma innovation
            for i in range(225):
                self.covariance[i] = growth * self.covariance[i]
            s = self.weigh(row, ph, variance)
        correction = [0.0] * 15
        self.take_in(row, ph, innovation, s, variance, correction)
        self.estimated_position = self.estimated_position + vector(*correction[0:3])
        self.estimated_velocity = self.estimated_velocity + vector(*correction[3:6])
        for i in range(9):
            self.sensor_errors[i] = self.sensor_errors[i] + correction[6 + i]
        return square

    def note(self, sensor: int, rejected_before: int) -> None:
        """Count a sample just taken, and whether some of it was rejected."""
        self.sample_count = self.sample_count + 1
        if self.rejected_count > rejected_before:
            self.rejected_in_a_row[sensor] = self.rejected_in_a_row[sensor] + 1
        else:
            self.rejected_in_a_row[sensor] = 0

    def measure(self) -> None:
        """Take the new samples in."""
        radial = [0.0] * 15
        before = self.rejected_count
        if self.altitude_count != self.altitude_taken:
            self.altitude_taken = self.altitude_count
            altitude = self.altitude(radial)
            sigma = self.altitude_relative_sigma * abs(altitude) + self.altitude_sigma
            innovation = self.measured_altitude - altitude
            self.altitude_innovation_square = self.consider(ALTITUDE, radial, innovation, sigma)
            self.note(ALTITUDE, before)
        before = self.rejected_count
        if self.velocity_count != self.velocity_taken:
            self.velocity_taken = self.velocity_count
            sigma = self.velocity_relative_sigma * norm(self.estimated_velocity) + self.velocity_sigma
            total = 0.0
            for i in range(3):
                row = [0.0] * 15
                row[3 + i] = 1.0
                square = self.consider(VELOCITY, row, self.measured_velocity[i] - self.estimated_velocity[i], sigma)
                total = total + square
            self.velocity_innovation_square = total
            self.note(VELOCITY, before)
        before = self.rejected_count
        if self.position_count != self.position_taken:
            self.position_taken = self.position_count
            altitude = self.altitude(radial)
            sigma = self.position_relative_sigma * abs(altitude) + self.position_sigma
            total = 0.0
            for i in range(3):
                row = [0.0] * 15
                row[i] = 1.0
                square = self.consider(POSITION, row, self.measured_position[i] - self.estimated_position[i], sigma)
                total = total + square
            self.position_innovation_square = total
            self.note(POSITION, before)

    def publish(self) -> None:
        """Put sigmas, covariance, bias and status on the outputs."""
        self.status = FilterStatus.GOOD
        self.estimated_bias = vector(*self.sensor_errors[0:3])
        for i in range(3):
            if self.rejected_in_a_row[i] >= self.rejection_limit:
                self.status = FilterStatus.LOCKED_OUT
            elif self.rejected_in_a_row[i] > 0 and self.status == FilterStatus.GOOD:
                self.status = FilterStatus.REJECTED
        k = 0
        for i in range(6):
            for j in range(i, 6):
                self.estimate_covariance[k] = element(self.covariance, STATES, i, j)
                k = k + 1
        for i in range(STATES):
            if not element(self.covariance, STATES, i, i) >= 0.0:
                self.status = FilterStatus.NOT_POSITIVE
        sigmas = [0.0] * 6
        for i in range(6):
            variance = element(self.covariance, STATES, i, i)
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
