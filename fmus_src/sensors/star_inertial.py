"""Attitude sensor: star trackers combined with gyros, or a single star tracker."""

import math

from ..block import Output, Parameter, State
from ..interfaces.ports import body, inertial, robot, sampling
from ..interfaces.ports.space import SpaceEnvironment
from ..kernel.enumerations import Enumeration, member
from ..kernel.functions import asin, cos
from ..kernel.matrices import zeros
from ..mathlib.attitude.quaternion import from_rotation_vector, multiply, normalise, to_reference
from ..mathlib.estimation.sensor_errors import LATEST, make_room
from ..mathlib.rng import normals
from ..mathlib.vectors import Vector3, across, dot, norm
from .random_sensor import RandomSensor

TIME = 4  # column of the time in samples; columns 0 to 3 are the attitude
GOOD = 5


class StarTrackerStatus(Enumeration):
    """Status of the last sample."""

    GOOD = member("good")
    DAZZLED = member("Sun, Moon or limb too near to the boresight, no sample")
    TOO_FAST = member("angular velocity too high, no sample")


class StarInertial(RandomSensor):
    """Star tracker with a small white rotation error, exclusion angles and latency.

        q_m = q rotation(e)    e = attitude_sigma n

    e is in body axes; about the boresight roll_sigma, unless it is 0, replaces attitude_sigma. No sample is taken while
    the Sun is within sun_exclusion of the boresight, the Moon within moon_exclusion, or the limb of the central body
    within limb_exclusion, or while the angular velocity exceeds rate_limit; the value 0 switches a limit off. A sample
    arrives ``latency`` sample periods later, with the time at which it was taken. The first sample is at the start.
    Random numbers depend on seed, stream and sample number only.

    Frames: body; inertial.

    Assumes small errors without bias.

    Source: Somov, Butyrin, Somov and Somova, see docs/systems/robot_rendezvous.md; exclusions: this repository.
    """

    default_step = 0.125

    attitude_sigma = Parameter(
        4.84813681109536e-6, unit="rad", minimum=0.0, description="error of the measured attitude, 1 sigma per axis"
    )
    boresight = Parameter(
        [0.0, 0.0, 1.0], unit="1", frame="body", description="boresight of the star tracker, normalised by the block"
    )
    roll_sigma = Parameter(
        0.0,
        unit="rad",
        minimum=0.0,
        description="error of the measured attitude about the boresight, 1 sigma; 0: same as attitude_sigma",
    )
    sun_exclusion = Parameter(
        0.0,
        unit="rad",
        minimum=0.0,
        maximum=math.pi,
        description="least angle between boresight and Sun at which stars are measured; 0: no exclusion",
    )
    limb_exclusion = Parameter(
        0.0,
        unit="rad",
        minimum=0.0,
        maximum=0.5 * math.pi,
        description=(
            "least angle between boresight and the central body's limb at which stars are measured; 0: no exclusion"
        ),
    )
    moon_exclusion = Parameter(
        0.0,
        unit="rad",
        minimum=0.0,
        maximum=math.pi,
        description="least angle between boresight and Moon at which stars are measured; 0: no exclusion",
    )
    rate_limit = Parameter(
        0.0, unit="rad/s", minimum=0.0, description="largest angular rate at which stars are measured; 0: no limit"
    )
    body_radius = Parameter(
        6378137.0, unit="m", minimum=0.0, description="radius of the central body, for the exclusion of its limb"
    )
    latency = Parameter(0, minimum=0, maximum=LATEST, description="delay from measurement to output, in sample periods")
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.125)
    seed, stream = sampling.random_stream()
    quaternion = robot.QUATERNION.input("true attitude quaternion from body to inertial, scalar first")
    angular_velocity = body.ANGULAR_VELOCITY.input("true angular velocity of the body relative to the inertial frame")
    position = inertial.POSITION.input("true position relative to the centre of the central body")
    sun_direction = SpaceEnvironment.sun_direction.input(
        "direction from the spacecraft to the Sun, unit vector; 0: no Sun", start=[0.0] * 3
    )
    moon_position = SpaceEnvironment.moon_position.input()
    measured_quaternion = robot.MEASURED_QUATERNION.output(
        "measured attitude quaternion from body to inertial, scalar first", direct=True
    )
    sample_time = Output(0.0, unit="s", direct=True, description="time of measurement of the sample")
    sample_count = sampling.SAMPLE_COUNT.output()
    status = Output(StarTrackerStatus, direct=True)
    samples = State(
        zeros(LATEST + 1, 6),
        description="delayed samples, one per row, newest first: attitude quaternion, time in s, 1 if valid",
    )
    axis = State(
        [0.0] * 3,
        unit="1",
        frame="body",
        frozen=True,
        description="unit vector of the tracker's boresight; 0: boresight without length",
    )
    generator = sampling.GENERATOR.state()
    start_time = sampling.START_TIME.state()

    def draw_constants(self) -> None:
        if norm(self.boresight) > 0.0:
            self.axis = self.boresight / norm(self.boresight)

    def measure(self) -> None:
        """Take a sample at the start."""
        self.take(self.start_time)

    def step(self, t: float, h: float) -> None:
        self.take(t + h)

    def error(self, numbers: Vector3) -> Vector3:
        """Return the rotation vector (rad, body) of the error."""
        rotation = self.attitude_sigma * numbers
        if self.roll_sigma > 0.0:
            rotation = across(rotation, self.axis) + self.roll_sigma * dot(numbers, self.axis) * self.axis
        return rotation

    def is_within(self, aim_inertial: Vector3, direction: Vector3, angle: float) -> bool:
        """Return True if a direction is within an angle (rad) of ``aim_inertial``; False for an angle of 0."""
        if angle > 0.0:
            return dot(aim_inertial, direction) > cos(angle) * norm(direction)
        return False

    def assess(self) -> None:
        """Set the status of a sample taken now."""
        aim_inertial = to_reference(normalise(self.quaternion), self.axis)
        dazzled = self.is_within(aim_inertial, self.sun_direction, self.sun_exclusion)
        if self.is_within(aim_inertial, self.moon_position - self.position, self.moon_exclusion):
            dazzled = True
        distance = norm(self.position)
        if self.limb_exclusion > 0.0 and distance > self.body_radius:
            disk = asin(self.body_radius / distance)
            if self.is_within(aim_inertial, -self.position, disk + self.limb_exclusion):
                dazzled = True
        self.status = StarTrackerStatus.GOOD
        if dazzled:
            self.status = StarTrackerStatus.DAZZLED
        elif self.rate_limit > 0.0 and norm(self.angular_velocity) > self.rate_limit:
            self.status = StarTrackerStatus.TOO_FAST

    def take(self, t: float) -> None:
        """Take a sample at t (s), and output the delayed sample that is due."""
        numbers = normals(self.generator)
        rotation = self.error(numbers)
        self.assess()
        make_room(self.samples, 6)
        self.samples[0, GOOD] = 0.0
        if self.status == StarTrackerStatus.GOOD:
            self.samples[0, 0:4] = normalise(multiply(self.quaternion, from_rotation_vector(rotation)))
            self.samples[0, TIME] = t
            self.samples[0, GOOD] = 1.0
        if self.samples[self.latency, GOOD] > 0.0:
            self.measured_quaternion = self.samples[self.latency, 0:4]
            self.sample_time = self.samples[self.latency, TIME]
            self.sample_count = self.sample_count + 1
