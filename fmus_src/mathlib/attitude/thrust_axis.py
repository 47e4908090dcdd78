"""Thrust axis turned by angular accelerations. Kernel functions; no particular frame is assumed.

The axis d, a unit vector, turns at the angular rate w (rad/s) perpendicular to it: d' = w x d. w' is the angular
acceleration (rad/s2) without its component along d, limited in magnitude (a limit of 0: unlimited). Roll about d is not
modelled.
"""

from ...kernel.integrators import runge_kutta_4
from ...kernel.records import Field, Record
from ..vectors import Vector3, across, cross, limit_length, norm


class AxisState(Record):
    """Direction and angular rate of a thrust axis."""

    axis = Field(Vector3, unit="1", description="direction of the axis, unit vector")
    rate = Field(Vector3, unit="rad/s", description="angular rate of the axis, perpendicular to it")


def axis_derivatives(t: float, s: AxisState, acceleration: Vector3, limit: float) -> AxisState:
    """Return the time derivatives of axis and angular rate."""
    turning = across(acceleration, s.axis)
    if limit > 0.0:
        turning = limit_length(turning, limit)
    return AxisState(axis=cross(s.rate, s.axis), rate=turning)


def turn_axis(s: AxisState, acceleration: Vector3, limit: float, h: float) -> AxisState:
    """Return axis and rate after h (s) of constant angular acceleration, by one fourth-order Runge-Kutta step."""
    end = runge_kutta_4(axis_derivatives, 0.0, s, h, acceleration, limit)
    length = norm(end.axis)
    if not length > 0.0:
        return s
    axis = end.axis / length
    return AxisState(axis=axis, rate=across(end.rate, axis))
