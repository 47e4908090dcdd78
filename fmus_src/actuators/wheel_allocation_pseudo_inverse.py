"""Wheel allocation by the pseudo-inverse."""

from .wheel_allocation import WheelAllocation


class WheelAllocationPseudoInverse(WheelAllocation):
    """Motor torques -A' (A A')^-1 torque_command: of all that give the torque those with the smallest sum of squares.

    Null motion leads the wheels' speeds to null_speed along the null direction, which keeps them away from rest, where
    friction changes sign. Its elements are of size 1/2 for a pyramid: each wheel of a body without momentum turns at
    null_speed, alternately forwards and backwards, the first one forwards.
    Source: Schaub and Junkins 2018, section 8.
    """

    def distribute(self) -> None:
        self.wheel_torques = -(self.inverse_axes @ self.torque_command)
        self.speed_change = 2.0 * self.null_speed * self.null - self.wheel_speeds
