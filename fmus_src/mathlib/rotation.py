"""Rotations from one direction to another. Kernel functions; no frame implied."""

import math

from .vectors import clip, cross, dot, norm

ALIGNED = 1e-12  # sine below which two directions count as parallel


def turn_towards(direction: list, goal: list, largest: float) -> float:
    """Turn a unit vector towards a unit vector goal by at most ``largest`` (rad), in place.

    Returns the angle (rad) that is left. Opposite vectors turn about the axis farthest from them.
    """
    cosine = clip(dot(direction, goal), -1.0, 1.0)
    side = [0.0] * 3
    for i in range(3):
        side[i] = goal[i] - cosine * direction[i]
    sine = norm(side)
    angle = math.atan2(sine, cosine)
    if angle <= largest:
        for i in range(3):
            direction[i] = goal[i]
        return 0.0
    if cosine < 0.0 and sine < 1e-6:
        k = 0
        for i in range(3):
            if abs(direction[i]) < abs(direction[k]):
                k = i
        for i in range(3):
            side[i] = -direction[k] * direction[i]
        side[k] = side[k] + 1.0
        sine = norm(side)
    c = math.cos(largest)
    s = math.sin(largest)
    for i in range(3):
        direction[i] = c * direction[i] + s * side[i] / sine
    length = norm(direction)
    for i in range(3):
        direction[i] = direction[i] / length
    return angle - largest


def rotation_between(start: list, goal: list, axis: list) -> float:
    """axis[3] (unit) and the angle (rad, returned) of the shortest rotation from one direction to another.

    Parallel directions turn about an axis perpendicular to them. Neither may have length 0.
    """
    size = norm(start) * norm(goal)
    cross(start, goal, axis)
    sine = norm(axis) / size
    angle = math.atan2(sine, dot(start, goal) / size)
    if sine < ALIGNED:
        k = 0
        for i in range(3):
            if abs(start[i]) < abs(start[k]):
                k = i
        along = start[k] / dot(start, start)
        for i in range(3):
            axis[i] = -along * start[i]
        axis[k] = axis[k] + 1.0
    length = norm(axis)
    for i in range(3):
        axis[i] = axis[i] / length
    return angle
