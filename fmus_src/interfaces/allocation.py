"""Interface of allocations, which convert the guidance command into commands of engine and attitude."""

from ..block import Block, Input, Output
from ..kernel.enumerations import Enumeration, member
from .ports import landing


class AllocationStatus(Enumeration):
    """Status of the allocation."""

    GOOD = member("good")
    LIMITED = member("limited by thrust or slew rate")
    CONTRADICTORY = member("contradictory limits")


class Allocation(Block, interface=True):
    """Thrust and thrust direction of a vehicle for a commanded thrust acceleration.

    Frame: landing site. Directions are unit vectors at command_time; their rates extrapolate them to later times.
    """

    thrust_acceleration = landing.THRUST_ACCELERATION.input(
        "thrust acceleration (thrust over mass) commanded by the guidance"
    )
    demanded_direction = landing.DIRECTION.input(
        "commanded thrust direction of the guidance at demand_time, unit vector"
    )
    demanded_direction_rate = landing.DIRECTION_RATE.input(
        "time derivative of the thrust direction commanded by the guidance"
    )
    demand_time = Input(0.0, unit="s", description="reference time of the command of the guidance")
    demanded_duration = Input(0.0, unit="s", description="burn duration commanded by the guidance, from demand_time on")
    mass = landing.MASS.input("mass of the vehicle")
    thrust = landing.THRUST.output("thrust of the engine after allocation", direct=True)
    thrust_direction = landing.DIRECTION.output(
        "thrust direction at command_time after allocation, unit vector", direct=True
    )
    thrust_direction_rate = landing.DIRECTION_RATE.output(
        "time derivative of the thrust direction after allocation", direct=True
    )
    command_time = landing.COMMAND_TIME.output(direct=True)
    burn_duration = landing.BURN_DURATION.output("burn duration after allocation, from command_time on", direct=True)
    status = Output(AllocationStatus, direct=True)
