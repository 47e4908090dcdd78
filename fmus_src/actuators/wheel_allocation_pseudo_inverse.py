"""Wheel allocation by the pseudo-inverse."""

from .wheel_allocation import WheelAllocation


class WheelAllocationPseudoInverse(WheelAllocation):
    """Motor torques by the pseudo-inverse, of least sum of squares.

        u = -A^T (A A^T)^-1 torque_command

    Null motion leads the wheel speeds to null_speed along the null direction, away from rest, where friction changes
    sign: in a pyramid without momentum each wheel turns at null_speed, alternately forwards and backwards, the first
    forwards.

    Source: Schaub and Junkins 2018, section 8.
    """

    def distribute(self) -> None:
        self.wheel_torques = -(self.inverse_axes @ self.torque_command)
        self.speed_change = 2.0 * self.null_speed * self.null - self.wheel_speeds
