"""A direction that follows a moving goal, as a vehicle's attitude follows its command. Kernel functions.

The goal at time s is the unit vector along base + rate s. The direction turns along the great
circle towards it, at the speed angle/response but no more than ``limit`` (rad/s). A response or a
limit of 0 does not count; without response the direction turns at the limit until it has caught
the goal. No frame implied.
"""

import math

from .rotation import turn_towards
from .vectors import copy3, dot, norm


def goal_at(base: list, rate: list, s: float, goal: list) -> None:
    """goal = the unit vector along base + rate s; unchanged where that has no direction."""
    along = [0.0] * 3
    for i in range(3):
        along[i] = base[i] + rate[i] * s
    length = norm(along)
    if length > 0.0:
        for i in range(3):
            goal[i] = along[i] / length


def turning(direction: list, goal: list, response: float, limit: float, slope: list) -> float:
    """slope = derivative of the direction; returns the angle to the goal (rad).

    Of opposite vectors one side is as good as the other: the direction then turns about the axis
    farthest from it.
    """
    length = norm(direction)
    cosine = dot(direction, goal) / length
    for i in range(3):
        slope[i] = goal[i] - cosine * direction[i] / length
    sine = norm(slope)
    angle = math.atan2(sine, cosine)
    if cosine < 0.0 and sine < 1e-6:
        k = 0
        for i in range(3):
            if abs(direction[i]) < abs(direction[k]):
                k = i
        for i in range(3):
            slope[i] = -direction[k] * direction[i]
        slope[k] = slope[k] + length * length
        sine = norm(slope)
    speed = limit
    if response > 0.0 and (limit <= 0.0 or angle < limit * response):
        speed = angle / response
    if sine > 0.0:
        speed = speed * length / sine
        for i in range(3):
            slope[i] = speed * slope[i]
    return angle


def runge_kutta(
    direction: list, base: list, rate: list, s: float, h: float, response: float, limit: float, goal: list
) -> float:
    """One step of fourth order from time s to s + h; leaves the goal of s + h, returns the angle to that of s."""
    shifted = [0.0] * 3
    total = [0.0] * 3
    slope = [0.0] * 3
    copy3(goal, direction)
    goal_at(base, rate, s, goal)
    angle = turning(direction, goal, response, limit, slope)
    for i in range(3):
        total[i] = slope[i]
        shifted[i] = direction[i] + 0.5 * h * slope[i]
    goal_at(base, rate, s + 0.5 * h, goal)
    turning(shifted, goal, response, limit, slope)
    for i in range(3):
        total[i] = total[i] + 2.0 * slope[i]
        shifted[i] = direction[i] + 0.5 * h * slope[i]
    turning(shifted, goal, response, limit, slope)
    for i in range(3):
        total[i] = total[i] + 2.0 * slope[i]
        shifted[i] = direction[i] + h * slope[i]
    goal_at(base, rate, s + h, goal)
    turning(shifted, goal, response, limit, slope)
    for i in range(3):
        direction[i] = direction[i] + h * (total[i] + slope[i]) / 6.0
    length = norm(direction)
    for i in range(3):
        direction[i] = direction[i] / length
    return angle


def follow(direction: list, base: list, rate: list, s: float, h: float, response: float, limit: float) -> None:
    """Turn a unit vector from time s to s + h, in place; assumes h no longer than a response that counts.

    The law has a knee where angle/response is the limit. A step across it is cut there, by linear
    interpolation of the angle: the slope is continuous, so that the fourth order is kept. Without
    response, the last two steps before the goal is caught go straight to where it will be.
    """
    goal = [0.0] * 3
    kept = [0.0] * 3
    slope = [0.0] * 3
    copy3(kept, direction)
    if response <= 0.0 and limit <= 0.0:
        goal_at(base, rate, s + h, direction)
    elif limit <= 0.0:
        runge_kutta(direction, base, rate, s, h, response, limit, goal)
    elif response <= 0.0:
        copy3(goal, direction)
        goal_at(base, rate, s, goal)
        left = turning(direction, goal, response, limit, slope)
        if left > 2.0 * limit * h:
            runge_kutta(direction, base, rate, s, h, response, limit, goal)
        else:
            goal_at(base, rate, s + h, goal)
            turn_towards(direction, goal, limit * h)
    else:
        knee = response * limit
        before = runge_kutta(direction, base, rate, s, h, response, limit, goal)
        after = turning(direction, goal, response, limit, slope)
        if (before > knee) != (after > knee):
            part = h * (before - knee) / (before - after)
            copy3(direction, kept)
            if before > knee:
                runge_kutta(direction, base, rate, s, part, 0.0, limit, goal)
                runge_kutta(direction, base, rate, s + part, h - part, response, 0.0, goal)
            else:
                runge_kutta(direction, base, rate, s, part, response, 0.0, goal)
                runge_kutta(direction, base, rate, s + part, h - part, 0.0, limit, goal)
