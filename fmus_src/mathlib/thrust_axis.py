"""A thrust axis that is turned by angular accelerations. Kernel functions; no frame implied.

The axis d, a unit vector, turns with the angular rate w (rad/s) perpendicular to it: d' = w x d, and w' is the
acceleration (rad/s2) without its part along d, no longer than a limit (0: none). Roll about d does not exist.
"""

from .vectors import Vector3, across, cross, limit_length, norm


def axis_slopes(d: Vector3, w: Vector3, acceleration: Vector3, limit: float) -> tuple[Vector3, Vector3]:
    """The derivatives of axis and angular rate."""
    turning = across(acceleration, d)
    if limit > 0.0:
        turning = limit_length(turning, limit)
    return cross(w, d), turning


def turn_axis(d: Vector3, w: Vector3, acceleration: Vector3, limit: float, h: float) -> tuple[Vector3, Vector3]:
    """Axis and angular rate h (s) later under a constant acceleration: one step of Runge-Kutta's fourth order."""
    d1, w1 = axis_slopes(d, w, acceleration, limit)
    d2, w2 = axis_slopes(d + 0.5 * h * d1, w + 0.5 * h * w1, acceleration, limit)
    d3, w3 = axis_slopes(d + 0.5 * h * d2, w + 0.5 * h * w2, acceleration, limit)
    d4, w4 = axis_slopes(d + h * d3, w + h * w3, acceleration, limit)
    axis = d + h * (d1 + 2.0 * d2 + 2.0 * d3 + d4) / 6.0
    rate = w + h * (w1 + 2.0 * w2 + 2.0 * w3 + w4) / 6.0
    length = norm(axis)
    if not length > 0.0:
        return d, w
    axis = axis / length
    return axis, across(rate, axis)
