"""Rotations from one direction to another. Kernel functions; no particular frame is assumed."""

from ...kernel.functions import atan2, cos, sin
from ...kernel.records import Field, Record
from ..vectors import Vector3, add_along, clip, cross, dot, norm, smallest_component

ALIGNED = 1e-12  # sine below which two directions count as parallel


class TurningDirection(Record):
    """Rotating direction and its rate."""

    direction = Field(Vector3, unit="1", description="direction at the reference time, unit vector")
    rate = Field(Vector3, unit="1/s", description="time derivative of the direction")


def turn_towards(direction: Vector3, goal: Vector3, largest: float) -> tuple[Vector3, float]:
    """Return a unit vector turned towards ``goal`` by at most ``largest`` (rad), and the remaining angle (rad).

    ``goal`` is a unit vector. For opposite vectors the rotation is towards the coordinate axis farthest from them.
    """
    cosine = clip(dot(direction, goal), -1.0, 1.0)
    side = goal - cosine * direction
    sine = norm(side)
    angle = atan2(sine, cosine)
    if angle <= largest:
        return goal, 0.0
    if cosine < 0.0 and sine < 1e-6:
        k, smallest = smallest_component(direction)
        side = add_along(-smallest * direction, k, 1.0)
        sine = norm(side)
    turned = cos(largest) * direction + sin(largest) * side / sine
    return turned / norm(turned), angle - largest


def rotation_between(start: Vector3, goal: Vector3) -> tuple[Vector3, float]:
    """Return the axis (unit vector) and angle (rad) of the shortest rotation from one direction to another.

    For parallel directions the axis is perpendicular to both. The lengths must not be 0.
    """
    size = norm(start) * norm(goal)
    axis = cross(start, goal)
    sine = norm(axis) / size
    angle = atan2(sine, dot(start, goal) / size)
    if sine < ALIGNED:
        k, smallest = smallest_component(start)
        axis = add_along(-(smallest / dot(start, start)) * start, k, 1.0)
    return axis / norm(axis), angle
