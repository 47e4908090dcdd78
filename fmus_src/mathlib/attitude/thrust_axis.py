"""A thrust axis that is turned by angular accelerations. Kernel functions; no frame implied.

The axis d, a unit vector, turns with the angular rate w (rad/s) perpendicular to it: d' = w x d, and w' is the
acceleration (rad/s2) without its component along d, no longer than a limit (0: none). Roll about d does not exist.
"""

from ...kernel.integrators import runge_kutta_4
from ...kernel.records import Field, Record
from ..vectors import Vector3, across, cross, limit_length, norm


class AxisState(Record):
    """A thrust axis that turns."""

    axis = Field(Vector3, unit="1", description="direction of the axis, unit vector")
    rate = Field(Vector3, unit="rad/s", description="angular rate of the axis, perpendicular to it")


def axis_derivatives(t: float, s: AxisState, acceleration: Vector3, limit: float) -> AxisState:
    """Return the derivatives of axis and angular rate."""
    turning = across(acceleration, s.axis)
    if limit > 0.0:
        turning = limit_length(turning, limit)
    return AxisState(axis=cross(s.rate, s.axis), rate=turning)


def turn_axis(s: AxisState, acceleration: Vector3, limit: float, h: float) -> AxisState:
    """Return axis and angular rate h (s) later under a constant acceleration: one step of Runge-Kutta's fourth
    order."""
    end = runge_kutta_4(axis_derivatives, 0.0, s, h, acceleration, limit)
    length = norm(end.axis)
    if not length > 0.0:
        return s
    axis = end.axis / length
    return AxisState(axis=axis, rate=across(end.rate, axis))
