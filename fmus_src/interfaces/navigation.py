"""The slot of navigation: from measurements to the estimate that guidance flies on."""

from ..block import Block, Input, Output, Parameter


class Navigation(Block, interface=True):
    """Position and velocity as the vehicle knows them.

    Measurements come from sensor blocks, each with a count that tells a new sample from a held one.
    The true motion is connected too: ideal navigation passes it on, blocks with sensors of their own
    measure it, and filters take it once, with errors, as what is known at the start. A block that does
    not need one of the inputs or parameters leaves it alone, so that all of them swap in one system.
    Frame: landing site (x north, y west, z up), as the plant's.
    """

    moon_radius = Parameter(1.7374e6, unit="m", minimum=1.0, description="radius of the Moon at the site")
    gravitational_parameter = Parameter(4.9028e12, unit="m3/s2", minimum=0.0, description="of the Moon")
    first_position_sigma = Parameter(
        500.0, unit="m", minimum=0.0, description="first error of position, 1 sigma per axis"
    )
    first_velocity_sigma = Parameter(
        1.0, unit="m/s", minimum=0.0, description="first error of velocity, 1 sigma per axis"
    )
    position = Input([0.0, 0.0, 0.0], unit="m", frame="landing site", description="true position")
    velocity = Input([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="true velocity")
    specific_force = Input(
        [0.0, 0.0, 0.0],
        unit="m/s2",
        frame="landing site",
        description="true mean of thrust over mass since the last point",
    )
    velocity_increment = Input(
        [0.0, 0.0, 0.0],
        unit="m/s",
        frame="landing site",
        description="measured integral of specific force between the last two inertial samples",
    )
    inertial_count = Input(0, description="inertial samples taken")
    measured_altitude = Input(0.0, unit="m", description="altitude above the sphere of moon_radius")
    altitude_count = Input(0, description="altitude samples taken")
    measured_velocity = Input([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="measured velocity")
    velocity_count = Input(0, description="velocity samples taken")
    measured_position = Input([0.0, 0.0, 0.0], unit="m", frame="landing site", description="measured position")
    position_count = Input(0, description="position samples taken")
    free_flight = Input(
        False, description="no thrust: the specific force is 0 and the inertial sensor's errors do not count"
    )
    estimated_position = Output([0.0, 0.0, 0.0], unit="m", frame="landing site", direct=True, description="position")
    estimated_velocity = Output([0.0, 0.0, 0.0], unit="m/s", frame="landing site", direct=True, description="velocity")
    position_estimate_sigma = Output(
        [0.0, 0.0, 0.0],
        unit="m",
        frame="landing site",
        direct=True,
        description="standard deviation of the estimate's error; 0: not known",
    )
    velocity_estimate_sigma = Output(
        [0.0, 0.0, 0.0],
        unit="m/s",
        frame="landing site",
        direct=True,
        description="standard deviation of the estimate's error; 0: not known",
    )
    estimate_covariance = Output(
        [0.0] * 21,
        frame="landing site",
        direct=True,
        description="covariance of the error of position and velocity, SI; rows of the upper triangle; 0: not known",
    )
    sample_count = Output(0, direct=True, description="samples taken; tells a new one from a held one")
    status = Output(0, direct=True, description="0 good")
