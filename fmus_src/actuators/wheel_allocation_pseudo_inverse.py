"""Wheel allocation by the pseudo-inverse."""

from .wheel_allocation import WheelAllocation


class WheelAllocationPseudoInverse(WheelAllocation):
    """Motor torques by the pseudo-inverse, with the least sum of squares.

        u = -A^T (A A^T)^-1 torque_command

    Null motion drives the wheel speeds to null_speed along the null direction, away from zero speed, where friction
    changes sign: in a pyramid without momentum the wheels turn at null_speed in alternating directions, the first one
    forwards.

    Source: Schaub and Junkins 2018, section 8.
    """

    def distribute(self) -> None:
        self.wheel_torques = -(self.inverse_axes @ self.torque_command)
        self.speed_change = 2.0 * self.null_speed * self.null - self.wheel_speeds
