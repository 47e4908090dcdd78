"""The slot of navigation: from measurements to the estimate that guidance flies on."""

from ..block import Block, Input, Output, Parameter
from .ports import landing, sampling


class Navigation(Block, interface=True):
    """Position and velocity as the vehicle knows them.

    Measurements come from sensor blocks, each with a count that tells a new sample from a held one.
    The true motion is connected too: ideal navigation passes it on, blocks with sensors of their own
    measure it, and filters take it once, with errors, as what is known at the start. A block that does
    not need one of the inputs or parameters leaves it alone, so that all of them swap in one system.
    Frame: landing site (x north, y west, z up), as the plant's.
    """

    moon_radius = landing.MOON_RADIUS.parameter(description="radius of the Moon at the site")
    gravitational_parameter = landing.GRAVITATIONAL_PARAMETER.parameter()
    first_position_sigma = Parameter(
        500.0, unit="m", minimum=0.0, description="first error of position, 1 sigma per axis"
    )
    first_velocity_sigma = Parameter(
        1.0, unit="m/s", minimum=0.0, description="first error of velocity, 1 sigma per axis"
    )
    position = landing.POSITION.input("true position")
    velocity = landing.VELOCITY.input("true velocity")
    specific_force = landing.ACCELERATION.input("true mean of thrust over mass since the last point")
    velocity_increment = landing.VELOCITY.input(
        "measured integral of specific force between the last two inertial samples"
    )
    inertial_count = Input(0, description="inertial samples taken")
    measured_altitude = landing.MEASURED_ALTITUDE.input()
    altitude_count = Input(0, description="altitude samples taken")
    measured_velocity = landing.VELOCITY.input("measured velocity")
    velocity_count = Input(0, description="velocity samples taken")
    measured_position = landing.POSITION.input("measured position")
    position_count = Input(0, description="position samples taken")
    free_flight = landing.FREE_FLIGHT.input()
    estimated_position = landing.POSITION.output(direct=True)
    estimated_velocity = landing.VELOCITY.output(direct=True)
    position_estimate_sigma = landing.POSITION.output(
        "standard deviation of the estimate's error; 0: not known", direct=True
    )
    velocity_estimate_sigma = landing.VELOCITY.output(
        "standard deviation of the estimate's error; 0: not known", direct=True
    )
    estimate_covariance = landing.ESTIMATE_COVARIANCE.output(direct=True)
    sample_count = sampling.SAMPLE_COUNT.output(direct=True)
    status = Output(0, direct=True, description="0 good")
