"""The slot of attitude navigation: from star tracker and gyros to attitude and angular velocity."""

from ..block import Block, Input, Output, Parameter
from ..interfaces.ports import body, robot, sampling, satellite, space
from ..interfaces.ports.space import SpaceEnvironment
from ..kernel.enumerations import Enumeration, member


class AttitudeNavigationStatus(Enumeration):
    """State of the estimate."""

    GOOD = member("good")
    NO_GYROS = member("last gyro sample not finite, last rate used")
    NO_STARS = member("last star sample not finite and left out")
    NO_ATTITUDE = member("no attitude: last star sample shorter than 0.5 and left out")
    REJECTED = member("last sample beyond the gate and left out")
    NO_RECENT_STAR = member("no star sample for 30 s")
    UNKNOWN = member("no attitude measured yet")
    NO_DIRECTION = member("last direction to the Sun or of the field not finite or 0 and left out")
    TOO_LATE = member("last star sample older than eight cycles and left out")


class AttitudeNavigation(Block, interface=True):
    """Attitude and angular velocity as the satellite knows them.

    Samples of star tracker, gyros, Sun sensors and magnetometer come with a count that reports new ones. The true
    motion is connected too, for navigation without errors. The parameters are those that any navigation of the slot may
    need, so that one set of them serves all. Frames: body; inertial for the directions known on board; quaternions from
    body to inertial. Equations: docs/systems/satellite_pointing.md, docs/systems/earth_pointing.md.
    """

    default_step = 0.125

    star_sigma = Parameter(
        2.9088820866572157e-05,
        unit="rad",
        minimum=1e-12,
        description="error of a star sample, 1 sigma per axis; 6 arcsec",
    )
    gyro_random_walk = satellite.GYRO_RANDOM_WALK.parameter()
    bias_random_walk = satellite.BIAS_RANDOM_WALK.parameter()
    first_bias_sigma = Parameter(
        3e-6, unit="rad/s", minimum=0.0, description="bias of the gyros at the start, 1 sigma per axis"
    )
    boresight = Parameter(
        [0.0, 0.0, 1.0], unit="1", frame="body", description="boresight of the star tracker, of any length"
    )
    roll_sigma = Parameter(
        0.0, unit="rad", minimum=0.0, description="error of a star sample about the boresight; 0: star_sigma"
    )
    sun_sigma = Parameter(0.02, unit="rad", minimum=1e-12, description="error of the direction to the Sun, per axis")
    field_sigma = Parameter(0.02, unit="rad", minimum=1e-12, description="error of the field's direction, per axis")
    gate = Parameter(0.0, unit="1", minimum=0.0, description="largest normalised innovation squared; 0: no gate")
    rejects_to_restart = Parameter(
        20, minimum=1, description="samples beyond the gate in a row until the covariance restarts"
    )
    sample_period = sampling.SAMPLE_PERIOD.parameter(0.125, "navigation cycle; 0: every communication point")
    quaternion = robot.QUATERNION.input("true attitude, body to inertial, scalar first")
    angular_velocity = body.ANGULAR_VELOCITY.input("true angular velocity")
    measured_quaternion = robot.MEASURED_QUATERNION.input()
    star_count = Input(0, description="star samples so far; a change signals a new one")
    measured_angular_velocity = body.ANGULAR_VELOCITY.input("measured by the gyros")
    gyro_count = Input(0, description="gyro samples so far; a change signals a new one")
    star_time = Input(-1.0, unit="s", description="time of the star sample; below 0: now")
    measured_sun = Input([0.0, 0.0, 0.0], unit="1", frame="body", description="measured direction to the Sun")
    sun_count = Input(0, description="samples of the Sun so far; a change signals a new one")
    sun_direction = SpaceEnvironment.sun_direction.input("to the Sun, as known on board", start=[0.0] * 3)
    measured_field = space.MAGNETIC_FIELD.input("measured field")
    field_count = Input(0, description="samples of the field so far; a change signals a new one")
    magnetic_field = SpaceEnvironment.magnetic_field.input("magnetic field, as known on board")
    estimated_quaternion = robot.QUATERNION.output(direct=True)
    estimated_angular_velocity = body.ANGULAR_VELOCITY.output("estimated angular velocity", direct=True)
    estimated_bias = satellite.BIAS.output("estimated bias of the gyros", direct=True)
    attitude_sigma = Output(
        [0.0, 0.0, 0.0],
        unit="rad",
        frame="body",
        direct=True,
        description="standard deviation of the estimated attitude; 0: not known",
    )
    bias_sigma = satellite.BIAS.output("standard deviation of the estimated bias; 0: not known", direct=True)
    innovation_square = sampling.INNOVATION_SQUARE.output(direct=True)
    attitude_known = Output(False, direct=True, description="true: an attitude was measured")
    status = Output(AttitudeNavigationStatus, direct=True)
