"""Rotation of unit vectors. Kernel functions; no frame implied."""

import math

from .vectors import clip, dot, norm


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
