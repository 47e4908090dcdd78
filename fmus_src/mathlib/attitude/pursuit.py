"""Pursuit of a moving goal by a direction, such as a vehicle's attitude that follows its command. Kernel functions.

The goal at time s is the unit vector along base + rate s. The direction turns towards the goal along the great circle
at the rate angle/response, limited to ``limit`` (rad/s). A ``response`` or ``limit`` of 0 means that there is none;
without a response the direction turns at the limit until it reaches the goal. No particular frame is assumed.
"""

from ...kernel.functions import atan2
from ...kernel.integrators import runge_kutta_4_from
from ...kernel.records import Field, Record
from ..vectors import Vector3, add_along, dot, norm, smallest_component
from .rotation import turn_towards


def goal_at(base: Vector3, rate: Vector3, s: float, otherwise: Vector3) -> Vector3:
    """Return the unit vector along base + rate s, or ``otherwise`` if it has no direction."""
    along = base + s * rate
    length = norm(along)
    if length > 0.0:
        return along / length
    return otherwise


def turning(direction: Vector3, goal: Vector3, response: float, limit: float) -> tuple[float, Vector3]:
    """Return the angle to the goal (rad) and the time derivative (1/s) of the direction.

    For opposite vectors the direction turns towards the coordinate axis farthest from it.
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


class Pursuit(Record):
    """Result of one step of a pursuit."""

    direction = Field(Vector3, description="pursuing direction at the end of the step, unit vector")
    goal = Field(Vector3, description="direction of the goal at the end of the step, unit vector")
    angle = Field(unit="rad", description="angle from the pursuing direction to the goal at the start of the step")


def pursuit_rate(
    t: float, direction: Vector3, base: Vector3, rate: Vector3, last_goal: Vector3, response: float, limit: float
) -> Vector3:
    """Return the time derivative (1/s) of the direction at time t (s)."""
    _, slope = turning(direction, goal_at(base, rate, t, last_goal), response, limit)
    return slope


def pursue(
    direction: Vector3, base: Vector3, rate: Vector3, s: float, h: float, response: float, limit: float
) -> Pursuit:
    """Return the pursuit after one fourth-order Runge-Kutta step from time s to s + h."""
    goal = goal_at(base, rate, s, direction)
    angle, k1 = turning(direction, goal, response, limit)
    turned = runge_kutta_4_from(k1, pursuit_rate, s, direction, h, base, rate, goal, response, limit)
    return Pursuit(direction=turned / norm(turned), goal=goal_at(base, rate, s + h, goal), angle=angle)


def follow(
    direction: Vector3, base: Vector3, rate: Vector3, s: float, h: float, response: float, limit: float
) -> Vector3:
    """Return a unit vector turned from time s to s + h; a response, unless it is 0, must be at least h.

    The law has a kink where angle/response equals the limit. A step across the kink is divided there by linear
    interpolation of the angle; the slope is continuous, so fourth order is preserved. Without a response, the last two
    steps before the goal is reached turn directly to its future position.
    """
    if response <= 0.0 and limit <= 0.0:
        return goal_at(base, rate, s + h, direction)
    if response <= 0.0:
        goal = goal_at(base, rate, s, direction)
        left, _ = turning(direction, goal, response, limit)
        if not left > 2.0 * limit * h:
            turned, _ = turn_towards(direction, goal_at(base, rate, s + h, goal), limit * h)
            return turned
    whole = pursue(direction, base, rate, s, h, response, limit)
    if response > 0.0 and limit > 0.0:
        knee = response * limit
        after, _ = turning(whole.direction, whole.goal, response, limit)
        if (whole.angle > knee) != (after > knee):
            part = h * (whole.angle - knee) / (whole.angle - after)
            if whole.angle > knee:
                first = pursue(direction, base, rate, s, part, 0.0, limit)
                whole = pursue(first.direction, base, rate, s + part, h - part, response, 0.0)
            else:
                first = pursue(direction, base, rate, s, part, response, 0.0)
                whole = pursue(first.direction, base, rate, s + part, h - part, 0.0, limit)
    return whole.direction
