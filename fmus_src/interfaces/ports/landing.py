"""Ports of a lunar landing: vectors in the landing-site frame, commands, vehicle and Moon."""

from ...bundles import Bundle
from ...kernel.enumerations import Enumeration, member
from ...ports import Port

UNLIMITED = 1e9  # s; longer than any flight


class CommandSource(Enumeration):
    """Source of the current command."""

    NOBODY = member("none")
    OWN = member("sequencer")
    BRAKING = member("braking guidance")
    HOVER = member("hover guidance")


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
ANGULAR_ACCELERATION = Port(
    [0.0, 0.0, 0.0], unit="rad/s2", frame="landing site", description="angular acceleration of the thrust axis"
)
ANGULAR_RATE = Port([0.0, 0.0, 0.0], unit="rad/s", frame="landing site", description="angular rate of the thrust axis")
BIAS_SIGMA = Port(1e-3, unit="m/s2", minimum=0.0, description="initial bias of each accelerometer, 1 sigma")
BURN_DURATION = Port(0.0, unit="s", description="commanded burn duration, from command_time on")
COMMAND_TIME = Port(
    0.0, unit="s", description="reference time of the commanded thrust direction, from which burn_duration counts"
)
DIRECTION = Port(
    [0.0, 0.0, 1.0],
    unit="1",
    frame="landing site",
    description="commanded thrust direction at command_time, unit vector",
)
DIRECTION_RATE = Port(
    [0.0, 0.0, 0.0], unit="1/s", frame="landing site", description="time derivative of the commanded thrust direction"
)
ENGINE_ON = Port(False, description="true: engine burning")
ESTIMATE_COVARIANCE = Port(
    [0.0] * 21,
    frame="landing site",
    description=(
        "covariance of the errors of estimated position and velocity, SI units, upper triangle by rows; 0: unknown"
    ),
)
FINISHED = Port(False, description="true: flight finished, simulation to be ended")
FREE_FLIGHT = Port(False, description="true: free flight without thrust; specific force taken as 0")
GRAVITATIONAL_PARAMETER = Port(4.9028e12, unit="m3/s2", minimum=0.0, description="gravitational parameter of the Moon")
GRAVITY = Port(
    1.62, unit="m/s2", minimum=0.0, description="constant gravitational acceleration along -z of the landing site frame"
)
GROUND_CONTACT = Port(False, description="true: lander in contact with the ground")
HANDOVER_ALTITUDE_HIGH = Port(
    1800.0, unit="m", description="highest altitude at which braking is handed over to the next phase"
)
HANDOVER_ALTITUDE_LOW = Port(
    1200.0, unit="m", description="lowest altitude at which braking is handed over to the next phase"
)
HANDOVER_SPEED = Port(
    5.9, unit="m/s", minimum=0.0, description="speed below which braking is handed over to the next phase"
)
HORIZONTAL_SPEED = Port(0.0, unit="m/s", description="speed of the lander perpendicular to the local vertical")
HOVER_PLAN = Port(0, description="plan_number of the plan that the command of the hover guidance follows")
INITIAL_MASS = Port(940.0, unit="kg", minimum=1e-3, description="initial mass of the lander with propellant")
MASS = Port(1.0, unit="kg", description="mass of the lander")
MAXIMUM_ALTITUDE = Port(2e4, unit="m", description="highest altitude at which the sensor measures")
MAXIMUM_THRUST = Port(5099.0, unit="N", minimum=0.0, description="largest thrust of the engine")
MEASURED_ALTITUDE = Port(0.0, unit="m", description="measured altitude above the sphere of moon_radius")
MEASURED_PATH_ANGLE = Port(
    -1.6, unit="rad", description="measured angle from the local vertical to the velocity, unwrapped"
)
MINIMUM_THRUST = Port(0.0, unit="N", minimum=0.0, description="least thrust of the burning engine")
MOON_RADIUS = Port(1.7374e6, unit="m", minimum=1.0, description="distance of the landing site from the Moon's centre")
NOISE_SIGMA = Port(1.0, unit="m", minimum=0.0, description="constant part of the altitude measurement error, 1 sigma")
PLAN_NUMBER = Port(0, description="number of the requested plan; a change starts the plan")
POSITION = Port(
    [0.0, 0.0, 0.0], unit="m", frame="landing site", description="position of the lander relative to the landing site"
)
POSITION_SIGMA = Port(
    2.0, unit="m", minimum=0.0, description="constant part of the position measurement error, 1 sigma per axis"
)
PREDICTED_PROPELLANT = Port(0.0, unit="kg", description="predicted propellant consumption of the plan")
PROBE_CONTACT = Port(False, description="true: landing probe in contact with the ground")
PROBE_LENGTH = Port(1.5, unit="m", minimum=0.0, description="altitude below which the landing probe touches the ground")
SCALE_FACTOR_SIGMA = Port(
    3e-4, unit="1", minimum=0.0, description="constant scale factor error of each accelerometer, 1 sigma"
)
SPECIFIC_IMPULSE = Port(319.0, unit="s", minimum=1e-3, description="specific impulse of the engine")
THRUST = Port(0.0, unit="N", description="commanded thrust of the engine")
THRUST_ACCELERATION = Port(0.0, unit="m/s2", description="commanded thrust acceleration (thrust over mass)")
THRUST_ANGLE = Port(0.0, unit="rad", description="angle from the local vertical to the thrust")
THRUST_LAG = Port(0.0, unit="s", minimum=0.0, description="time constant of the engine's thrust; 0: no lag")
TILT = Port(0.0, unit="rad", description="tilt: angle between thrust axis and local vertical")
TIME_TO_GO = Port(0.0, unit="s", description="time to go until the target state is reached")
UNIFORM_GRAVITY = Port(
    0.0,
    unit="m/s2",
    minimum=0.0,
    description="uniform gravitational acceleration along -z; 0: central gravity of the Moon",
)
VELOCITY = Port(
    [0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="velocity of the lander relative to the landing site"
)
VELOCITY_RANDOM_WALK = Port(
    1e-4, minimum=0.0, description="velocity random walk of each accelerometer, m/s per square root of s"
)
VELOCITY_SIGMA = Port(
    0.05, unit="m/s", minimum=0.0, description="constant part of the velocity measurement error, 1 sigma per axis"
)
VERTICAL_SPEED = Port(
    0.0, unit="m/s", description="component of the lander's velocity along the local vertical, positive upwards"
)


class ThrustCommand(Bundle):
    """Command from a guidance to engine and attitude control."""

    thrust_acceleration = THRUST_ACCELERATION
    thrust_direction = Port(
        [0.0, 0.0, 0.0],
        unit="1",
        frame="landing site",
        description="commanded thrust direction at command_time, unit vector; 0: no direction",
    )
    thrust_direction_rate = DIRECTION_RATE
    command_time = COMMAND_TIME
    burn_duration = BURN_DURATION
