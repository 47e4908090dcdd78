"""The slot of allocation: from a guidance command to what engine and attitude do."""

from ..block import Block, Input, Output
from ..kernel.enumerations import Enumeration, member
from .ports import landing


class AllocationStatus(Enumeration):
    """Presence of the demand."""

    GOOD = member("good")
    LIMITED = member("limited by thrust or slew rate")
    CONTRADICTORY = member("the limits contradict each other")


class Allocation(Block, interface=True):
    """Thrust and thrust direction that the vehicle gives when guidance asks for an acceleration.

    Directions are unit vectors of the landing-site frame at command_time with their rates.
    """

    thrust_acceleration = landing.THRUST_ACCELERATION.input("demanded thrust over mass")
    demanded_direction = landing.DIRECTION.input("demanded direction at demand_time")
    demanded_direction_rate = landing.DIRECTION_RATE.input()
    demand_time = Input(0.0, unit="s", description="when the demand was computed")
    demanded_duration = Input(0.0, unit="s", description="how long to thrust from demand_time on")
    mass = landing.MASS.input("mass of the vehicle")
    thrust = landing.THRUST.output("thrust", direct=True)
    thrust_direction = landing.DIRECTION.output(direct=True)
    thrust_direction_rate = landing.DIRECTION_RATE.output(direct=True)
    command_time = landing.COMMAND_TIME.output(direct=True)
    burn_duration = landing.BURN_DURATION.output(direct=True)
    status = Output(AllocationStatus, direct=True)
