"""A direction that follows a moving goal, as a vehicle's attitude follows its command. Kernel functions.

The goal at time s is the unit vector along base + rate s. The direction turns along the great
circle towards it, at the speed angle/response but no more than ``limit`` (rad/s). A response or a
limit of 0 does not count; without response the direction turns at the limit until it has caught
the goal. No frame implied.
"""

from ..kernel.functions import atan2
from .rotation import turn_towards
from .vectors import Vector3, add_along, dot, norm, smallest_component


def goal_at(base: Vector3, rate: Vector3, s: float, otherwise: Vector3) -> Vector3:
    """The unit vector along base + rate s; ``otherwise`` where that has no direction."""
    along = base + s * rate
    length = norm(along)
    if length > 0.0:
        return along / length
    return otherwise


def turning(direction: Vector3, goal: Vector3, response: float, limit: float) -> tuple[float, Vector3]:
    """The angle to the goal (rad), and the derivative of the direction.

    Of opposite vectors one side is as good as the other: the direction then turns about the axis
    farthest from it.
    """
    length = norm(direction)
    cosine = dot(direction, goal) / length
    slope = goal - cosine * direction / length
    sine = norm(slope)
    angle = atan2(sine, cosine)
    if cosine < 0.0 and sine < 1e-6:
        k, smallest = smallest_component(direction)
        slope = add_along(-smallest * direction, k, length * length)
        sine = norm(slope)
    speed = limit
    if response > 0.0 and (limit <= 0.0 or angle < limit * response):
        speed = angle / response
    if sine > 0.0:
        slope = speed * length / sine * slope
    return angle, slope


def runge_kutta(
    direction: Vector3, base: Vector3, rate: Vector3, s: float, h: float, response: float, limit: float
) -> tuple[Vector3, Vector3, float]:
    """One step of fourth order from time s to s + h: direction and goal at its end, and the angle at its start."""
    goal = goal_at(base, rate, s, direction)
    angle, k1 = turning(direction, goal, response, limit)
    goal = goal_at(base, rate, s + 0.5 * h, goal)
    _, k2 = turning(direction + 0.5 * h * k1, goal, response, limit)
    _, k3 = turning(direction + 0.5 * h * k2, goal, response, limit)
    goal = goal_at(base, rate, s + h, goal)
    _, k4 = turning(direction + h * k3, goal, response, limit)
    turned = direction + h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0
    return turned / norm(turned), goal, angle


def follow(
    direction: Vector3, base: Vector3, rate: Vector3, s: float, h: float, response: float, limit: float
) -> Vector3:
    """A unit vector turned from time s to s + h; assumes h no longer than a response that counts.

    The law has a knee where angle/response is the limit. A step across it is cut there, by linear
    interpolation of the angle: the slope is continuous, so that the fourth order is kept. Without
    response, the last two steps before the goal is caught go straight to where it will be.
    """
    if response <= 0.0 and limit <= 0.0:
        return goal_at(base, rate, s + h, direction)
    if response <= 0.0:
        goal = goal_at(base, rate, s, direction)
        left, _ = turning(direction, goal, response, limit)
        if not left > 2.0 * limit * h:
            turned, _ = turn_towards(direction, goal_at(base, rate, s + h, goal), limit * h)
            return turned
    turned, goal, before = runge_kutta(direction, base, rate, s, h, response, limit)
    if response > 0.0 and limit > 0.0:
        knee = response * limit
        after, _ = turning(turned, goal, response, limit)
        if (before > knee) != (after > knee):
            part = h * (before - knee) / (before - after)
            if before > knee:
                turned, _, _ = runge_kutta(direction, base, rate, s, part, 0.0, limit)
                turned, _, _ = runge_kutta(turned, base, rate, s + part, h - part, response, 0.0)
            else:
                turned, _, _ = runge_kutta(direction, base, rate, s, part, response, 0.0)
                turned, _, _ = runge_kutta(turned, base, rate, s + part, h - part, 0.0, limit)
    return turned
