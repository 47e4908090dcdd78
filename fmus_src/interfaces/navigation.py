"""The slot of navigation: from measurements to the estimate that guidance flies on."""

from ..block import Block, Input, Output, Parameter
from .ports import landing, sampling


class Navigation(Block, interface=True):
    """Position and velocity of a lander as known on board.

    Measurements come from sensor blocks, each with a count that distinguishes a new sample from a held one. The true
    motion is connected as well: for ideal navigation, for blocks with internal sensors, and for the initial estimate of
    filters. All blocks of the slot have all inputs and parameters, so that they are interchangeable.

    Frame: landing site (x north, y west, z up).
    """

    moon_radius = landing.MOON_RADIUS.parameter(description="radius of the Moon at the site")
    gravitational_parameter = landing.GRAVITATIONAL_PARAMETER.parameter()
    first_position_sigma = Parameter(
        500.0, unit="m", minimum=0.0, description="initial position error, 1 sigma per axis"
    )
    first_velocity_sigma = Parameter(
        1.0, unit="m/s", minimum=0.0, description="initial velocity error, 1 sigma per axis"
    )
    position = landing.POSITION.input("true position")
    velocity = landing.VELOCITY.input("true velocity")
    specific_force = landing.ACCELERATION.input("true mean of thrust over mass since the last communication point")
    velocity_increment = landing.VELOCITY.input(
        "measured integral of specific force between the last two inertial samples"
    )
    inertial_count = Input(0, description="number of inertial samples so far")
    measured_altitude = landing.MEASURED_ALTITUDE.input()
    altitude_count = Input(0, description="number of altitude samples so far")
    measured_velocity = landing.VELOCITY.input("measured velocity")
    velocity_count = Input(0, description="number of velocity samples so far")
    measured_position = landing.POSITION.input("measured position")
    position_count = Input(0, description="number of position samples so far")
    free_flight = landing.FREE_FLIGHT.input()
    estimated_position = landing.POSITION.output(direct=True)
    estimated_velocity = landing.VELOCITY.output(direct=True)
    position_estimate_sigma = landing.POSITION.output(
        "standard deviation of the position estimate per axis; 0: unknown", direct=True
    )
    velocity_estimate_sigma = landing.VELOCITY.output(
        "standard deviation of the velocity estimate per axis; 0: unknown", direct=True
    )
    estimate_covariance = landing.ESTIMATE_COVARIANCE.output(direct=True)
    sample_count = sampling.SAMPLE_COUNT.output(direct=True)
    status = Output(0, direct=True, description="status of the estimate; 0 good")
