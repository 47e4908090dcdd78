"""Wheel allocation with the smallest largest torque."""

from ..mathlib.actuators.wheels import minimax_shift
from .wheel_allocation import WheelAllocation


class WheelAllocationMinimax(WheelAllocation):
    """Of all motor torques that give torque_command those whose largest size is smallest.

    So every torque within the array's envelope is given: up to half as much again as by the pseudo-inverse, for a
    torque along a spin axis of a pyramid. Null motion leads the wheels to those speeds with their momentum whose
    largest size is smallest; null_speed does not count. Source: Markley, Reynolds, Liu and Lebsock 2010, "Maximum
    torque and momentum envelopes for reaction wheel arrays".
    """

    def distribute(self) -> None:
        smallest = -(self.inverse_axes @ self.torque_command)
        self.wheel_torques = smallest + minimax_shift(smallest, self.null) * self.null
        self.speed_change = minimax_shift(self.wheel_speeds, self.null) * self.null
