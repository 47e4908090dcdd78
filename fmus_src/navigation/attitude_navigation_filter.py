"""Multiplicative extended Kalman filter of attitude from star tracker, gyros, Sun sensors and magnetometer."""

import math

from ..block import Output, State
from ..interfaces.ports import sampling
from ..kernel.matrices import Matrix, identity, zeros
from ..mathlib.attitude.quaternion import (
    difference,
    from_rotation_vector,
    is_attitude,
    multiply,
    normalise,
    to_rotation_vector,
)
from ..mathlib.attitude.triad import triad
from ..mathlib.estimation.attitude_errors import BIAS, ROTATION
from ..mathlib.estimation.directions import innovation, sensitivity, squared_distance, update_three
from ..mathlib.vectors import Vector3, Vector4, across, cross, dot, is_finite, norm, smallest_component, vector
from .attitude_navigation import AttitudeNavigationStatus
from .multiplicative_filter import MultiplicativeFilter

STAR, SUN, FIELD = 0, 1, 2  # sensors with separate counts of rejected samples
TURNS = 8  # sample periods by which a star sample may be delayed
COARSE = 30.0  # s without a star sample, after which the status is coarse
TRIAD_SINE = 0.17  # sine of the least angle between two directions for an attitude


class AttitudeNavigationFilter(MultiplicativeFilter):
    """Multiplicative extended Kalman filter of attitude and gyro bias.

    A star sample corrects attitude and bias by a small rotation in body axes; the first one initialises the attitude.
    The assumed standard deviation is star_sigma per axis; about the boresight roll_sigma replaces it unless it is 0. A
    sample with a star_time up to eight sample periods ago is first propagated by the gyros; older samples are skipped.
    A measured direction y, to the Sun or of the magnetic field, with the modelled direction u in inertial axes,
    corrects the attitude about the axes across y:

        z = y - R^T u    H = [R^T u]    d^2 = z^T (H P H^T + σ^2)^-1 z

    Before the first star sample both directions in one sample period give the initial attitude (TRIAD). Components are
    processed one after another; the covariance is 6 x 6. A sample is skipped and reported if it is not finite, is not
    an attitude, is a direction of length 0, or has d^2 beyond ``gate``; after rejects_to_restart samples of a sensor in
    a row beyond the gate, the attitude covariance is reset.

    Assumes independent errors with the declared standard deviations.

    Source: Lefferts, Markley and Shuster 1982; Crassidis and Junkins 2012, section 7.2; Black 1964 (TRIAD); Markley and
    Crassidis 2014, sections 5.1 and 6.2.
    """

    rejected = Output(0, direct=True, description="number of samples rejected by the gate since the start")
    star_counted = State(0, description="star_count of the last star tracker sample used")
    sun_counted = State(0, description="sun_count of the last Sun sensor sample used")
    field_counted = State(0, description="field_count of the last magnetometer sample used")
    rejected_in_row = State(
        [0] * 3,
        description="numbers of consecutive samples rejected by the gate: star tracker, Sun sensors, magnetometer",
    )
    last_star = State(0.0, unit="s", description="time of the last accepted star tracker sample")
    turns = State(
        zeros(TURNS, 3),
        unit="rad",
        frame="body",
        description="rotation vectors over the last sample periods, integrated from the gyros, newest first",
    )
    turn_starts = State([0.0] * TURNS, unit="s", description="start times of the stored rotations, newest first")
    turn_ends = State([0.0] * TURNS, unit="s", description="end times of the stored rotations, newest first")

    def initialize(self) -> None:
        self.star_counted = 0  # a count of 0 means no sample; any other count is a new sample
        self.sun_counted = self.sun_count
        self.field_counted = self.field_count
        self.last_star = self.start_time
        for k in range(TURNS):
            self.turn_starts[k] = self.start_time
            self.turn_ends[k] = self.start_time
        self.begin()
        self.take_samples(self.start_time)

    def remember_turn(self, start: float, end: float) -> None:
        """Store ``turn``, the rotation between two times (s), as the newest one."""
        for i in range(TURNS - 1):
            k = TURNS - 1 - i
            self.turns[k, 0:3] = self.turns[k - 1, 0:3]
            self.turn_starts[k] = self.turn_starts[k - 1]
            self.turn_ends[k] = self.turn_ends[k - 1]
        self.turns[0, 0:3] = self.turn
        self.turn_starts[0] = start
        self.turn_ends[0] = end

    def propagate_by_gyros(self, q: Vector4) -> Vector4:
        """Return the attitude ``q`` at star_time, propagated to the present by the gyros at a constant rate in each
        sample period; ``q`` itself if star_time is negative.
        """
        if self.star_time < 0.0:
            return q
        for i in range(TURNS):
            k = TURNS - 1 - i
            if self.turn_ends[k] > self.star_time + sampling.TIME_ROUNDING:
                fraction = 1.0
                if self.turn_starts[k] < self.star_time - sampling.TIME_ROUNDING:
                    fraction = (self.turn_ends[k] - self.star_time) / (self.turn_ends[k] - self.turn_starts[k])
                q = multiply(q, from_rotation_vector(fraction * self.turns[k, 0:3]))
        return normalise(q)

    def restart(self, variance: float) -> None:
        """Reset the attitude covariance to a variance (rad^2) per axis, without correlation with the bias."""
        self.covariance[ROTATION, ROTATION] = variance * identity(3)
        self.covariance[ROTATION, BIAS] = zeros(3, 3)
        self.covariance[BIAS, ROTATION] = zeros(3, 3)

    def accept(self, sensor: int, h: Matrix, variances: Vector3, z: Vector3) -> bool:
        """Process three components unless they are beyond the gate; return True if they are within it."""
        if self.gate > 0.0:
            square = squared_distance(self.covariance, h, variances, z)
            if square > self.gate:
                self.status = AttitudeNavigationStatus.REJECTED
                self.rejected = self.rejected + 1
                self.rejected_in_row[sensor] = self.rejected_in_row[sensor] + 1
                if self.rejected_in_row[sensor] >= self.rejects_to_restart:
                    self.rejected_in_row[sensor] = 0
                    self.restart(1.0)
                return False
        self.rejected_in_row[sensor] = 0
        x, self.covariance, self.innovation_square = update_three(zeros(6, 1), self.covariance, h, variances, z)
        self.correct(x)
        return True

    def take_star_sample(self, t: float) -> None:
        """Process the star sample if it is new."""
        if self.star_count == self.star_counted:
            return
        self.star_counted = self.star_count
        if not (math.isfinite(self.measured_quaternion.w) and is_finite(self.measured_quaternion[1:4])):
            self.status = AttitudeNavigationStatus.NO_STARS
            return
        if not is_attitude(self.measured_quaternion):
            self.status = AttitudeNavigationStatus.NO_ATTITUDE
            return
        if self.star_time >= 0.0 and self.star_time < self.turn_starts[TURNS - 1] - sampling.TIME_ROUNDING:
            self.status = AttitudeNavigationStatus.TOO_LATE
            return
        measured = self.propagate_by_gyros(normalise(self.measured_quaternion))
        if not self.begun:
            self.begun = True
            self.last_star = t
            self.estimated_quaternion = measured
            sigma = self.star_sigma
            if self.roll_sigma > sigma:
                sigma = self.roll_sigma
            self.restart(sigma * sigma)
            return
        rotation = to_rotation_vector(difference(self.estimated_quaternion, measured))
        h = zeros(3, 6)
        h[0:3, ROTATION] = identity(3)
        variance = self.star_sigma * self.star_sigma
        variances = vector(variance, variance, variance)
        if self.roll_sigma > 0.0 and norm(self.boresight) > 0.0:
            axis = self.boresight / norm(self.boresight)
            k, _ = smallest_component(axis)
            side = identity(3)[0:3, k]
            side = across(side, axis) / norm(across(side, axis))
            other = cross(axis, side)
            h[0, 0:3] = side
            h[1, 0:3] = other
            h[2, 0:3] = axis
            variances = vector(variance, variance, self.roll_sigma * self.roll_sigma)
            rotation = vector(dot(side, rotation), dot(other, rotation), dot(axis, rotation))
        good = self.accept(STAR, h, variances, rotation)
        if good:
            self.last_star = t

    def take_direction(self, sensor: int, measured: Vector3, reference: Vector3, sigma: float) -> None:
        """Process a measured direction (body) with its reference (inertial), both finite and not 0."""
        z = innovation(self.estimated_quaternion, reference, measured)
        h = sensitivity(measured / norm(measured) - z)
        variances = sigma * sigma * vector(1.0, 1.0, 1.0)
        self.accept(sensor, h, variances, z)

    def is_new(self, counted: bool, measured: Vector3, reference: Vector3) -> bool:
        """Return True for a new, usable direction; set the status if it or its reference is not finite or 0."""
        if not counted:
            return False
        if is_finite(measured) and is_finite(reference) and norm(measured) > 0.0 and norm(reference) > 0.0:
            return True
        self.status = AttitudeNavigationStatus.NO_DIRECTION
        return False

    def take_directions(self) -> None:
        """Process new directions, or initialise the attitude from them."""
        sun = self.is_new(self.sun_count != self.sun_counted, self.measured_sun, self.sun_direction)
        field = self.is_new(self.field_count != self.field_counted, self.measured_field, self.magnetic_field)
        self.sun_counted = self.sun_count
        self.field_counted = self.field_count
        if self.begun:
            if sun:
                self.take_direction(SUN, self.measured_sun, self.sun_direction, self.sun_sigma)
            if field:
                self.take_direction(FIELD, self.measured_field, self.magnetic_field, self.field_sigma)
        elif sun and field:
            first = triad(self.measured_sun, self.measured_field, self.sun_direction, self.magnetic_field, TRIAD_SINE)
            if first.exists:
                self.begun = True
                self.estimated_quaternion = first.quaternion
                variance = self.sun_sigma * self.sun_sigma + self.field_sigma * self.field_sigma
                self.restart(variance / (TRIAD_SINE * TRIAD_SINE))

    def take_samples(self, t: float) -> None:
        """Process all new samples, and set the outputs."""
        self.take_star_sample(t)
        self.take_directions()
        self.attitude_known = self.begun
        if self.status == AttitudeNavigationStatus.GOOD:
            if not self.begun:
                self.status = AttitudeNavigationStatus.UNKNOWN
            elif t - self.last_star > COARSE:
                self.status = AttitudeNavigationStatus.NO_RECENT_STAR
        self.report()

    def step(self, t: float, h: float) -> None:
        self.predict(t + h - self.last_time)
        self.remember_turn(self.last_time, t + h)
        self.last_time = t + h
        self.take_samples(t + h)
