"""Landing on the Moon: vectors of the landing-site frame, and the command, mass and Moon of a lander."""

from ...bundles import Bundle
from ...kernel.enumerations import Enumeration, member
from ...ports import Port

UNLIMITED = 1e9  # s; longer than any flight


class CommandSource(Enumeration):
    """Source of the command in force."""

    NOBODY = member("none")
    OWN = member("own")
    BRAKING = member("braking")
    HOVER = member("hover")


class HoverMode(Enumeration):
    """Mode of the hover guidance."""

    IDLE = member("idle")
    HOLD = member("hold")
    PROGRAMME = member("programme")
    SLOW = member("slow transfer")
    CAPTURE = member("capture")
    DESCEND = member("descend")


class TerminalStatus(Enumeration):
    """Status of the last solution."""

    GOOD = member("good")
    CLAMPED = member("clamped")
    NOT_CONVERGED = member("not converged")
    NO_SOLUTION = member("no solution")


class HoverStatus(Enumeration):
    """Status of the last plan."""

    GOOD = member("good")
    NO_PROGRAMME = member("no programme, polynomial flown")
    BEYOND_LIMITS = member("limit exceeded by the capture")
    NO_PLAN = member("no feasible plan, position held")


ACCELERATION = Port([0.0, 0.0, 0.0], unit="m/s2", frame="landing site", description="acceleration")
ACTIVE = Port(True, description="true: guidance active; a change to true starts a plan")
ALTITUDE = Port(0.0, unit="m", description="altitude above the sphere of moon_radius")
ANGULAR_ACCELERATION = Port([0.0, 0.0, 0.0], unit="rad/s2", frame="landing site", description="angular acceleration")
ANGULAR_RATE = Port([0.0, 0.0, 0.0], unit="rad/s", frame="landing site", description="angular rate")
BIAS_SIGMA = Port(1e-3, unit="m/s2", minimum=0.0, description="initial bias of the inertial sensor, 1 sigma per axis")
BURN_DURATION = Port(0.0, unit="s", description="burn duration from command_time on")
COMMAND_TIME = Port(0.0, unit="s", description="reference time of direction and duration")
DIRECTION = Port(
    [0.0, 0.0, 1.0], unit="1", frame="landing site", description="thrust direction at command_time, unit vector"
)
DIRECTION_RATE = Port(
    [0.0, 0.0, 0.0], unit="1/s", frame="landing site", description="time derivative of the thrust direction"
)
ENGINE_ON = Port(False, description="true: engine on")
ESTIMATE_COVARIANCE = Port(
    [0.0] * 21,
    frame="landing site",
    description="covariance of the position and velocity errors, SI, rows of the upper triangle; 0: unknown",
)
FINISHED = Port(False, description="true: flight finished")
FREE_FLIGHT = Port(False, description="true: no thrust, specific force 0 and inertial sensor errors without effect")
GRAVITATIONAL_PARAMETER = Port(4.9028e12, unit="m3/s2", minimum=0.0, description="gravitational parameter of the Moon")
GRAVITY = Port(1.62, unit="m/s2", minimum=0.0, description="constant gravity along -z")
GROUND_CONTACT = Port(False, description="true: ground contact")
HANDOVER_ALTITUDE_HIGH = Port(1800.0, unit="m", description="upper altitude limit of the hand-over")
HANDOVER_ALTITUDE_LOW = Port(1200.0, unit="m", description="lower altitude limit of the hand-over")
HANDOVER_SPEED = Port(5.9, unit="m/s", minimum=0.0, description="speed below which the hand-over takes place")
HORIZONTAL_SPEED = Port(0.0, unit="m/s", description="horizontal speed relative to the local vertical")
HOVER_PLAN = Port(0, description="plan_number of the hover guidance's command")
INITIAL_MASS = Port(940.0, unit="kg", minimum=1e-3, description="initial mass")
MASS = Port(1.0, unit="kg", description="mass")
MAXIMUM_ALTITUDE = Port(2e4, unit="m", description="largest altitude of the sensor's range")
MAXIMUM_THRUST = Port(5099.0, unit="N", minimum=0.0, description="largest thrust")
MEASURED_ALTITUDE = Port(0.0, unit="m", description="measured altitude above the sphere of moon_radius")
MEASURED_PATH_ANGLE = Port(-1.6, unit="rad", description="angle of the velocity from the local vertical, unwrapped")
MINIMUM_THRUST = Port(0.0, unit="N", minimum=0.0, description="least thrust while burning")
MOON_RADIUS = Port(1.7374e6, unit="m", minimum=1.0, description="radius of the sphere through the site")
NOISE_SIGMA = Port(1.0, unit="m", minimum=0.0, description="constant part of the measurement error, 1 sigma")
PLAN_NUMBER = Port(0, description="number of the requested plan; a change starts it")
POSITION = Port([0.0, 0.0, 0.0], unit="m", frame="landing site", description="position")
POSITION_SIGMA = Port(
    2.0, unit="m", minimum=0.0, description="constant part of the position measurement error, 1 sigma per axis"
)
PREDICTED_PROPELLANT = Port(0.0, unit="kg", description="predicted propellant of the plan")
PROBE_CONTACT = Port(False, description="true: contact of the probe with the ground")
PROBE_LENGTH = Port(1.5, unit="m", minimum=0.0, description="altitude at which the probe touches the ground")
SCALE_FACTOR_SIGMA = Port(
    3e-4, unit="1", minimum=0.0, description="scale factor error of the inertial sensor, 1 sigma per axis, constant"
)
SPECIFIC_IMPULSE = Port(319.0, unit="s", minimum=1e-3, description="specific impulse of the engine")
THRUST = Port(0.0, unit="N", description="commanded thrust")
THRUST_ACCELERATION = Port(0.0, unit="m/s2", description="thrust over mass")
THRUST_ANGLE = Port(0.0, unit="rad", description="angle of thrust from the local vertical")
THRUST_LAG = Port(0.0, unit="s", minimum=0.0, description="time constant of the thrust; 0: none")
TILT = Port(0.0, unit="rad", description="angle of the thrust axis from the local vertical")
TIME_TO_GO = Port(0.0, unit="s", description="time to go to the target state")
UNIFORM_GRAVITY = Port(0.0, unit="m/s2", minimum=0.0, description="uniform gravity along -z; 0: central gravity")
VELOCITY = Port([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="velocity")
VELOCITY_RANDOM_WALK = Port(
    1e-4, minimum=0.0, description="velocity random walk of the inertial sensor, m/s per square root of s"
)
VELOCITY_SIGMA = Port(
    0.05, unit="m/s", minimum=0.0, description="constant part of the velocity measurement error, 1 sigma per axis"
)
VERTICAL_SPEED = Port(0.0, unit="m/s", description="vertical velocity, upwards")


class ThrustCommand(Bundle):
    """Command of a guidance to engine and attitude control."""

    thrust_acceleration = THRUST_ACCELERATION
    thrust_direction = Port(
        [0.0, 0.0, 0.0],
        unit="1",
        frame="landing site",
        description="thrust direction at command_time, unit vector; 0: none",
    )
    thrust_direction_rate = DIRECTION_RATE
    command_time = COMMAND_TIME
    burn_duration = BURN_DURATION
