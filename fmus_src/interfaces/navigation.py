"""The slot of navigation: from the vehicle's true motion to the estimate that guidance flies on."""

from ..block import Block, Input, Output


class Navigation(Block, interface=True):
    """Position and velocity as the vehicle knows them, from its true motion and its sensors' errors.

    Frame: landing site (x north, y west, z up), as the plant's.
    """

    position = Input([0.0, 0.0, 0.0], unit="m", frame="landing site", description="true position")
    velocity = Input([0.0, 0.0, 0.0], unit="m/s", frame="landing site", description="true velocity")
    specific_force = Input(
        [0.0, 0.0, 0.0],
        unit="m/s2",
        frame="landing site",
        description="true mean of thrust over mass since the last point",
    )
    estimated_position = Output([0.0, 0.0, 0.0], unit="m", frame="landing site", direct=True, description="position")
    estimated_velocity = Output([0.0, 0.0, 0.0], unit="m/s", frame="landing site", direct=True, description="velocity")
    sample_count = Output(0, direct=True, description="samples taken; tells a new one from a held one")
    status = Output(0, direct=True, description="0 good")
