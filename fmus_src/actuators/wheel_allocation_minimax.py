"""Wheel allocation that minimises the largest motor torque."""

from ..mathlib.actuators.wheels import minimax_shift
from .wheel_allocation import WheelAllocation


class WheelAllocationMinimax(WheelAllocation):
    """Motor torques with the least maximum magnitude for the commanded torque.

        min max |u_i|    -A u = torque_command

    Every torque within the array's envelope is attained; along a spin axis of a pyramid this is up to 1.5 times the
    limit of the pseudo-inverse. Null motion drives the wheels to the speeds that have the same momentum and the least
    maximum; null_speed has no effect.

    Source: Markley, Reynolds, Liu and Lebsock 2010, "Maximum torque and momentum envelopes for reaction wheel arrays".
    """

    def distribute(self) -> None:
        smallest = -(self.inverse_axes @ self.torque_command)
        self.wheel_torques = smallest + minimax_shift(smallest, self.null) * self.null
        self.speed_change = minimax_shift(self.wheel_speeds, self.null) * self.null
