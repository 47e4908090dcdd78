"""Landing on the Moon: vectors of the landing-site frame, and the command, mass and Moon of a lander."""

from ...bundles import Bundle
from ...kernel.enumerations import Enumeration, member
from ...ports import Port

UNLIMITED = 1e9  # s; longer than any flight


class CommandSource(Enumeration):
    """Whose command counts."""

    NOBODY = member("none")
    OWN = member("own")
    BRAKING = member("braking")
    HOVER = member("hover")


class HoverMode(Enumeration):
    """Task of the hover guidance."""

    IDLE = member("idle")
    HOLD = member("hold")
    PROGRAMME = member("programme")
    SLOW = member("slow transfer")
    CAPTURE = member("capture")
    DESCEND = member("descend")


class TerminalStatus(Enumeration):
    """Outcome of the last solution."""

    GOOD = member("good")
    CLAMPED = member("clamped")
    NOT_CONVERGED = member("not converged")
    NO_SOLUTION = member("no solution")


class HoverStatus(Enumeration):
    """Outcome of the last plan."""

    GOOD = member("good")
    NO_PROGRAMME = member("no programme, polynomial flown")
    BEYOND_LIMITS = member("capture breaks a limit")
    NO_PLAN = member("no plan possible: holds")


ACCELERATION = Port([0.0, 0.0, 0.0], unit="m/s2", frame="landing site", description="acceleration")
ACTIVE = Port(True, description="false: no command; where it becomes true, a plan starts")
ALTITUDE = Port(0.0, unit="m", description="above the sphere of moon_radius")
ANGULAR_ACCELERATION = Port([0.0, 0.0, 0.0], unit="rad/s2", frame="landing site", description="angular acceleration")
ANGULAR_RATE = Port([0.0, 0.0, 0.0], unit="rad/s", frame="landing site", description="angular rate")
BIAS_SIGMA = Port(1e-3, unit="m/s2", minimum=0.0, description="inertial sensor: bias at the start, 1 sigma per axis")
BURN_DURATION = Port(0.0, unit="s", description="how long to thrust from command_time on")
COMMAND_TIME = Port(0.0, unit="s", description="time that direction and duration count from")
DIRECTION = Port([0.0, 0.0, 1.0], unit="1", frame="landing site", description="unit vector at command_time")
DIRECTION_RATE = Port([0.0, 0.0, 0.0], unit="1/s", frame="landing site", description="its derivative")
ENGINE_ON = Port(False, description="thrust is given")
ESTIMATE_COVARIANCE = Port(
    [0.0] * 21,
    frame="landing site",
    description="covariance of the error of position and velocity, SI; rows of the upper triangle; 0: not known",
)
FINISHED = Port(False, description="the flight is over")
FREE_FLIGHT = Port(
    False, description="no thrust: the specific force is 0 and the inertial sensor's errors do not count"
)
GRAVITATIONAL_PARAMETER = Port(4.9028e12, unit="m3/s2", minimum=0.0, description="of the Moon")
GRAVITY = Port(1.62, unit="m/s2", minimum=0.0, description="gravity, constant, along -z")
GROUND_CONTACT = Port(False, description="the ground was reached")
HANDOVER_ALTITUDE_HIGH = Port(1800.0, unit="m", description="highest altitude to finish at")
HANDOVER_ALTITUDE_LOW = Port(1200.0, unit="m", description="lowest altitude to finish at")
HANDOVER_SPEED = Port(5.9, unit="m/s", minimum=0.0, description="finished below it")
HORIZONTAL_SPEED = Port(0.0, unit="m/s", description="length of velocity across the local vertical")
HOVER_PLAN = Port(0, description="plan_number that the hover guidance's command belongs to")
INITIAL_MASS = Port(940.0, unit="kg", minimum=1e-3, description="mass at the start")
MASS = Port(1.0, unit="kg", description="mass")
MAXIMUM_ALTITUDE = Port(2e4, unit="m", description="measures at this altitude and below")
MAXIMUM_THRUST = Port(5099.0, unit="N", minimum=0.0, description="largest thrust")
MEASURED_ALTITUDE = Port(0.0, unit="m", description="altitude above the sphere of moon_radius")
MEASURED_PATH_ANGLE = Port(-1.6, unit="rad", description="from the local vertical to the velocity, unwrapped")
MINIMUM_THRUST = Port(0.0, unit="N", minimum=0.0, description="least thrust while burning")
MOON_RADIUS = Port(1.7374e6, unit="m", minimum=1.0, description="of the sphere that the site lies on")
NOISE_SIGMA = Port(1.0, unit="m", minimum=0.0, description="constant part of the error, 1 sigma")
PLAN_NUMBER = Port(0, description="of the plan requested; a change starts it")
POSITION = Port([0.0, 0.0, 0.0], unit="m", frame="landing site", description="position")
POSITION_SIGMA = Port(2.0, unit="m", minimum=0.0, description="error of a measured position per axis, constant part")
PREDICTED_PROPELLANT = Port(0.0, unit="kg", description="that the plan takes")
PROBE_CONTACT = Port(False, description="the probe has touched the ground")
PROBE_LENGTH = Port(1.5, unit="m", minimum=0.0, description="altitude at which the probe touches the ground")
SCALE_FACTOR_SIGMA = Port(
    3e-4, unit="1", minimum=0.0, description="inertial sensor: scale factor error, 1 sigma per axis, constant"
)
SPECIFIC_IMPULSE = Port(319.0, unit="s", minimum=1e-3, description="of the engine")
THRUST = Port(0.0, unit="N", description="commanded thrust")
THRUST_ACCELERATION = Port(0.0, unit="m/s2", description="thrust over mass")
THRUST_ANGLE = Port(0.0, unit="rad", description="from the local vertical to the thrust")
THRUST_LAG = Port(0.0, unit="s", minimum=0.0, description="time constant of thrust; 0: none")
TILT = Port(0.0, unit="rad", description="angle of the thrust axis from the local vertical")
TIME_TO_GO = Port(0.0, unit="s", description="time left to the target state")
UNIFORM_GRAVITY = Port(0.0, unit="m/s2", minimum=0.0, description="gravity along -z; 0: central field")
VELOCITY = Port([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="velocity")
VELOCITY_RANDOM_WALK = Port(
    1e-4, minimum=0.0, description="inertial sensor: random walk of velocity, m/s per square root of s"
)
VELOCITY_SIGMA = Port(0.05, unit="m/s", minimum=0.0, description="error of a measured velocity per axis, constant part")
VERTICAL_SPEED = Port(0.0, unit="m/s", description="velocity along the local vertical, upwards")


class ThrustCommand(Bundle):
    """Demand of a guidance on engine and attitude."""

    thrust_acceleration = THRUST_ACCELERATION
    thrust_direction = Port(
        [0.0, 0.0, 0.0], unit="1", frame="landing site", description="unit vector at command_time; 0: none"
    )
    thrust_direction_rate = DIRECTION_RATE
    command_time = COMMAND_TIME
    burn_duration = BURN_DURATION
