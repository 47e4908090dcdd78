"""Interface of navigation, which computes the estimate for guidance from measurements."""

from ..block import Block, Input, Output, Parameter
from .ports import landing, sampling


class Navigation(Block, interface=True):
    """Estimated position and velocity of a lander.

    Measurements come from sensor blocks, each with a count that distinguishes new samples from held ones. The true
    motion is also connected; it serves ideal navigation, blocks with internal sensors, and the initial estimate of
    filters. All blocks of the slot have the same inputs and parameters, so they are interchangeable.

    Frame: landing site (x north, y west, z up).
    """

    moon_radius = landing.MOON_RADIUS.parameter(description="distance of the landing site from the Moon's centre")
    gravitational_parameter = landing.GRAVITATIONAL_PARAMETER.parameter()
    first_position_sigma = Parameter(
        500.0, unit="m", minimum=0.0, description="initial error of the estimated position, 1 sigma per axis"
    )
    first_velocity_sigma = Parameter(
        1.0, unit="m/s", minimum=0.0, description="initial error of the estimated velocity, 1 sigma per axis"
    )
    position = landing.POSITION.input("true position of the lander relative to the landing site")
    velocity = landing.VELOCITY.input("true velocity of the lander relative to the landing site")
    specific_force = landing.ACCELERATION.input(
        "true specific force of the lander (thrust over mass), mean since the last communication point"
    )
    velocity_increment = landing.VELOCITY.input(
        "measured time integral of specific force between the last two inertial samples"
    )
    inertial_count = Input(
        0, description="number of inertial sensor samples since the start; a change signals a new sample"
    )
    measured_altitude = landing.MEASURED_ALTITUDE.input()
    altitude_count = Input(0, description="number of altimeter samples since the start; a change signals a new sample")
    measured_velocity = landing.VELOCITY.input("measured velocity of the lander relative to the landing site")
    velocity_count = Input(
        0, description="number of velocimeter samples since the start; a change signals a new sample"
    )
    measured_position = landing.POSITION.input("measured position of the lander relative to the landing site")
    position_count = Input(0, description="number of camera samples since the start; a change signals a new sample")
    free_flight = landing.FREE_FLIGHT.input()
    estimated_position = landing.POSITION.output(
        "estimated position of the lander relative to the landing site", direct=True
    )
    estimated_velocity = landing.VELOCITY.output(
        "estimated velocity of the lander relative to the landing site", direct=True
    )
    position_estimate_sigma = landing.POSITION.output(
        "standard deviation of the estimated position per axis; 0: unknown", direct=True
    )
    velocity_estimate_sigma = landing.VELOCITY.output(
        "standard deviation of the estimated velocity per axis; 0: unknown", direct=True
    )
    estimate_covariance = landing.ESTIMATE_COVARIANCE.output(direct=True)
    sample_count = sampling.SAMPLE_COUNT.output(direct=True)
    status = Output(0, direct=True, description="status of the estimate: 0 good")
