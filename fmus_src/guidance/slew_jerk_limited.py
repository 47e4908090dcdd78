"""Time-optimal slew within limits of rate, acceleration and jerk, between attitudes and angular velocities."""

from ..block import Output, Parameter, State
from ..interfaces.ports import sampling
from ..kernel.enumerations import Enumeration, member
from ..kernel.records import Field, Record, replace
from ..mathlib.attitude.quaternion import difference, from_rotation_vector, multiply, normalise, to_rotation_vector
from ..mathlib.jerk_limited import JerkLimits, RateProfile, follow_profile, plan_axis, plan_ramp, plan_turn
from ..mathlib.vectors import Vector3, Vector4, across, dot, norm, vector
from .slew_guidance import SlewGuidance, SlewProgress

ALIGNED = 1e-9  # rad, rotation that has no axis; also the fraction of rate_limit allowed across the axis


class SlewStatus(Enumeration):
    """Feasibility of the start and end angular velocities."""

    GOOD = member("good")
    BEYOND_RATE_LIMIT = member("no plan: a rate at the start or end beyond rate_limit")


class SlewLeg(Record):
    """Rotation about a body-fixed axis."""

    quaternion = Field(
        Vector4,
        unit="1",
        description="attitude quaternion at the start of the rotation, from body to inertial, scalar first",
    )
    axis = Field(Vector3, unit="1", frame="body", description="rotation axis, unit vector; 0: no rotation")
    profile = Field(RateProfile, description="profile of the rotation angle")


class SlewJerkLimited(SlewGuidance):
    """Time-optimal turn within limits of rate, acceleration and jerk, from one angular velocity to another.

    If both angular velocities lie along the eigenaxis or are 0, the turn is about the eigenaxis, with the sense and
    number of whole revolutions that take the least time. Otherwise it consists of three elementary rotations, each of
    least time: the start rate is stopped about its axis, the attitude turns the shorter way, and the end rate is
    reached about its axis. The limits hold for the magnitudes; a faster turn then exists. A change Δ of rate within
    limits A and J of acceleration and jerk takes

        T(Δ) = Δ/A + A/J    if Δ >= A^2/J
        T(Δ) = 2 sqrt(Δ/J)    if Δ < A^2/J

    Until slew_start the reference rotates at start_angular_velocity from the first estimated attitude; after the end,
    at the target attitude, at end_angular_velocity. Accelerations are 0 at both ends, the jerk is not. A boundary rate
    beyond rate_limit is infeasible: status 1, and the reference stays at the first estimated attitude.

    Source: Biagiotti and Melchiorri 2008, section 3.4; elementary rotations after Somov, Butyrin and Somova 2016.
    """

    jerk_limit = Parameter(1e-4, unit="rad/s3", minimum=1e-15, description="largest angular jerk of the slew")
    start_angular_velocity = Parameter(
        [0.0, 0.0, 0.0],
        unit="rad/s",
        frame="body",
        description="angular velocity of the reference attitude before the slew",
    )
    end_angular_velocity = Parameter(
        [0.0, 0.0, 0.0],
        unit="rad/s",
        frame="body",
        description="angular velocity of the reference attitude after the slew",
    )
    status = Output(SlewStatus, direct=True)
    first_quaternion = State(
        [1.0, 0.0, 0.0, 0.0],
        unit="1",
        description=(
            "reference attitude quaternion at the start of the simulation, from body to inertial, scalar first"
        ),
    )
    last_quaternion = State(
        [1.0, 0.0, 0.0, 0.0],
        unit="1",
        description="reference attitude quaternion at the end of the slew, from body to inertial, scalar first",
    )
    stop = State(SlewLeg, description="rotation that brings the body to rest from its start angular velocity")
    turn = State(SlewLeg, description="rotation from rest to rest")
    spin = State(SlewLeg, description="rotation from rest to the end angular velocity")

    def plan(self) -> None:
        self.first_quaternion = self.start_quaternion
        self.duration = 0.0
        self.slew_angle = 0.0
        first = norm(self.start_angular_velocity)
        last = norm(self.end_angular_velocity)
        self.status = SlewStatus.GOOD
        if first > self.rate_limit or last > self.rate_limit:
            self.status = SlewStatus.BEYOND_RATE_LIMIT
            return
        limits = JerkLimits(rate=self.rate_limit, acceleration=self.acceleration_limit, jerk=self.jerk_limit)
        begin = rotated(self.first_quaternion, self.slew_start * self.start_angular_velocity)
        end = normalise(self.target_quaternion)
        rotation = to_rotation_vector(difference(begin, end))
        axis = self.choose_axis(rotation)
        if norm(across(self.start_angular_velocity, axis)) + norm(across(self.end_angular_velocity, axis)) <= (
            ALIGNED * self.rate_limit
        ):
            standing = SlewLeg(quaternion=begin, axis=axis, profile=plan_ramp(0.0, 0.0, limits))
            along_first = dot(self.start_angular_velocity, axis)
            along_last = dot(self.end_angular_velocity, axis)
            profile = plan_turn(dot(rotation, axis), along_first, along_last, limits)
            self.stop = standing
            self.turn = replace(standing, profile=profile)
            self.spin = replace(standing, quaternion=end_of(self.turn))
        else:
            first_axis = unit(self.start_angular_velocity)
            last_axis = unit(self.end_angular_velocity)
            self.stop = SlewLeg(quaternion=begin, axis=first_axis, profile=plan_ramp(first, 0.0, limits))
            spin = plan_ramp(0.0, last, limits)
            stopped = end_of(self.stop)
            rotation = to_rotation_vector(difference(stopped, rotated(end, -spin.angle * last_axis)))
            profile = plan_axis(norm(rotation), 0.0, 0.0, limits)
            self.turn = SlewLeg(quaternion=stopped, axis=unit(rotation), profile=profile)
            self.spin = SlewLeg(quaternion=end_of(self.turn), axis=last_axis, profile=spin)
        self.last_quaternion = end_of(self.spin)
        self.slew_angle = abs(self.stop.profile.angle) + abs(self.turn.profile.angle) + abs(self.spin.profile.angle)
        self.duration = self.stop.profile.duration + self.turn.profile.duration + self.spin.profile.duration

    def choose_axis(self, rotation: Vector3) -> Vector3:
        """Return the unit axis of a rotation vector (rad); for zero rotation the axis of a boundary rate, or else 0."""
        if norm(rotation) > ALIGNED:
            return unit(rotation)
        if norm(self.start_angular_velocity) > 0.0:
            return unit(self.start_angular_velocity)
        return unit(self.end_angular_velocity)

    def follow(self, time: float) -> None:
        leg = self.turn
        elapsed = time - self.stop.profile.duration
        if elapsed < 0.0:
            leg = self.stop
            elapsed = time
        elif elapsed >= self.turn.profile.duration:
            leg = self.spin
            elapsed = elapsed - self.turn.profile.duration
        self.start_quaternion = leg.quaternion
        self.eigenaxis = leg.axis
        motion = follow_profile(leg.profile, elapsed)
        self.progress = SlewProgress(angle=motion.angle, rate=motion.rate)

    def coast(self, quaternion: Vector4, velocity: Vector3, time: float) -> None:
        """Set the reference to a rotation at constant angular velocity (rad/s) for ``time`` (s) from an attitude."""
        self.start_quaternion = quaternion
        self.eigenaxis = unit(velocity)
        rate = norm(velocity)
        self.progress = SlewProgress(angle=rate * time, rate=rate)

    def proceed(self, time: float) -> None:
        elapsed = time - self.start_time - self.slew_start
        if self.status != SlewStatus.GOOD:
            self.coast(self.first_quaternion, vector(0.0, 0.0, 0.0), 0.0)
        elif elapsed <= sampling.TIME_ROUNDING:
            self.coast(self.first_quaternion, self.start_angular_velocity, time - self.start_time)
        elif elapsed >= self.duration - sampling.TIME_ROUNDING:
            self.coast(self.last_quaternion, self.end_angular_velocity, elapsed - self.duration)
        else:
            self.follow(elapsed)

    def refer(self, time: float, period: float) -> None:
        self.set_phase(time)
        self.proceed(time + period)
        later = self.progress.rate * self.eigenaxis
        self.set_attitude(time)
        self.reference.reference_angular_acceleration = vector(0.0, 0.0, 0.0)
        if period > 0.0:
            change = later - self.reference.reference_angular_velocity
            self.reference.reference_angular_acceleration = change / period


def unit(v: Vector3) -> Vector3:
    """Return the unit vector along v, or 0 for v = 0."""
    length = norm(v)
    if length > 0.0:
        return v / length
    return vector(0.0, 0.0, 0.0)


def rotated(quaternion: Vector4, rotation: Vector3) -> Vector4:
    """Return an attitude rotated by a rotation vector (rad) in body axes."""
    return multiply(quaternion, from_rotation_vector(rotation))


def end_of(leg: SlewLeg) -> Vector4:
    """Return the attitude at the end of an elementary rotation."""
    return rotated(leg.quaternion, leg.profile.angle * leg.axis)
