"""Interface of attitude navigation, which estimates attitude and angular velocity from star tracker and gyros."""

from ..block import Block, Input, Output, Parameter
from ..interfaces.ports import body, robot, sampling, satellite, space
from ..interfaces.ports.space import SpaceEnvironment
from ..kernel.enumerations import Enumeration, member


class AttitudeNavigationStatus(Enumeration):
    """Status of the estimate."""

    GOOD = member("good")
    NO_GYROS = member("last gyro sample not finite, last rate used")
    NO_STARS = member("last star sample not finite and skipped")
    NO_ATTITUDE = member("no attitude: last star sample shorter than 0.5 and skipped")
    REJECTED = member("last sample beyond the gate and skipped")
    NO_RECENT_STAR = member("no star sample for 30 s")
    UNKNOWN = member("no attitude measured yet")
    NO_DIRECTION = member("last direction to the Sun or of the field not finite or 0 and skipped")
    TOO_LATE = member("last star sample older than eight sample periods and skipped")


class AttitudeNavigation(Block, interface=True):
    """Estimated attitude and angular velocity of a satellite.

    Each sensor (star tracker, gyros, Sun sensors, magnetometer) has a count that signals a new sample. The true motion
    is connected for navigation without errors. All blocks of the slot have the same parameters.

    Frames: body; inertial for modelled directions; quaternions from body to inertial.

    See docs/systems/satellite_pointing.md and docs/systems/earth_pointing.md.
    """

    default_step = 0.125

    star_sigma = Parameter(
        2.9088820866572157e-05,
        unit="rad",
        minimum=1e-12,
        description="error of an attitude measured by the star tracker, 1 sigma per axis",
    )
    gyro_random_walk = satellite.GYRO_RANDOM_WALK.parameter()
    bias_random_walk = satellite.BIAS_RANDOM_WALK.parameter()
    first_bias_sigma = Parameter(3e-6, unit="rad/s", minimum=0.0, description="initial gyro bias, 1 sigma per axis")
    boresight = Parameter(
        [0.0, 0.0, 1.0], unit="1", frame="body", description="boresight of the star tracker, normalised by the block"
    )
    roll_sigma = Parameter(
        0.0,
        unit="rad",
        minimum=0.0,
        description="error of a measured attitude about the star tracker's boresight, 1 sigma; 0: same as star_sigma",
    )
    sun_sigma = Parameter(
        0.02, unit="rad", minimum=1e-12, description="error of the measured direction to the Sun, 1 sigma per axis"
    )
    field_sigma = Parameter(
        0.02,
        unit="rad",
        minimum=1e-12,
        description="error of the measured direction of the magnetic field, 1 sigma per axis",
    )
    gate = Parameter(
        0.0,
        unit="1",
        minimum=0.0,
        description="largest normalised innovation squared of an accepted sample; 0: all samples accepted",
    )
    rejects_to_restart = Parameter(
        20, minimum=1, description="number of consecutive rejected samples after which the covariance is reset"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(
        0.125, "sample period of the navigation; 0: a sample at every communication point"
    )
    quaternion = robot.QUATERNION.input("true attitude quaternion from body to inertial, scalar first")
    angular_velocity = body.ANGULAR_VELOCITY.input("true angular velocity of the body relative to the inertial frame")
    measured_quaternion = robot.MEASURED_QUATERNION.input()
    star_count = Input(0, description="number of star tracker samples since the start; a change signals a new sample")
    measured_angular_velocity = body.ANGULAR_VELOCITY.input(
        "angular velocity relative to the inertial frame measured by the gyros"
    )
    gyro_count = Input(0, description="number of gyro samples since the start; a change signals a new sample")
    star_time = Input(
        -1.0, unit="s", description="time of measurement of the star tracker's sample; below 0: the current time"
    )
    measured_sun = Input(
        [0.0, 0.0, 0.0],
        unit="1",
        frame="body",
        description="measured direction from the spacecraft to the Sun, unit vector",
    )
    sun_count = Input(0, description="number of Sun sensor samples since the start; a change signals a new sample")
    sun_direction = SpaceEnvironment.sun_direction.input(
        "modelled direction from the spacecraft to the Sun, unit vector", start=[0.0] * 3
    )
    measured_field = space.MAGNETIC_FIELD.input("measured magnetic flux density")
    field_count = Input(0, description="number of magnetometer samples since the start; a change signals a new sample")
    magnetic_field = SpaceEnvironment.magnetic_field.input("modelled magnetic flux density at the spacecraft")
    estimated_quaternion = robot.QUATERNION.output(direct=True)
    estimated_angular_velocity = body.ANGULAR_VELOCITY.output(
        "estimated angular velocity of the body relative to the inertial frame", direct=True
    )
    estimated_bias = satellite.BIAS.output("estimated bias of the gyros", direct=True)
    attitude_sigma = Output(
        [0.0, 0.0, 0.0],
        unit="rad",
        frame="body",
        direct=True,
        description="standard deviation of the estimated attitude per axis; 0: unknown",
    )
    bias_sigma = satellite.BIAS.output(
        "standard deviation of the estimated gyro bias per axis; 0: unknown", direct=True
    )
    innovation_square = sampling.INNOVATION_SQUARE.output(direct=True)
    attitude_known = Output(False, direct=True, description="true: attitude measured at least once since the start")
    status = Output(AttitudeNavigationStatus, direct=True)
