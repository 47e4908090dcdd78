"""The slot of allocation: from a guidance command to what engine and attitude do."""

from ..block import Block, Input, Output


class Allocation(Block, interface=True):
    """Thrust and thrust direction that the vehicle gives when guidance asks for an acceleration.

    Directions are unit vectors of the landing-site frame at command_time with their rates.
    """

    thrust_acceleration = Input(0.0, unit="m/s2", description="demanded thrust over mass")
    demanded_direction = Input(
        [0.0, 0.0, 1.0], unit="1", frame="landing site", description="demanded direction at demand_time"
    )
    demanded_direction_rate = Input([0.0, 0.0, 0.0], unit="1/s", frame="landing site", description="its derivative")
    demand_time = Input(0.0, unit="s", description="when the demand was computed")
    demanded_duration = Input(0.0, unit="s", description="how long to thrust from demand_time on")
    mass = Input(1.0, unit="kg", description="mass of the vehicle")
    thrust = Output(0.0, unit="N", direct=True, description="thrust")
    thrust_direction = Output(
        [0.0, 0.0, 1.0], unit="1", frame="landing site", direct=True, description="unit vector at command_time"
    )
    thrust_direction_rate = Output(
        [0.0, 0.0, 0.0], unit="1/s", frame="landing site", direct=True, description="its derivative"
    )
    command_time = Output(0.0, unit="s", direct=True, description="time that direction and duration count from")
    burn_duration = Output(0.0, unit="s", direct=True, description="how long to thrust from command_time on")
    status = Output(
        0,
        minimum=0,
        maximum=2,
        direct=True,
        description="0 good, 1 limited by thrust or slew rate, 2 the limits contradict each other",
    )
