"""Descent in SI units as a convex problem expanded about a plan; the solution is the next plan. Kernel functions.

A plan is a flat list: thrust acceleration (m/s2) of the intervals; position (m), velocity (m/s), gravity (m/s2) and
logarithm of the mass over the initial mass at the nodes, in the landing-site frame.
"""

import math

from ....kernel.functions import cos, exp, expm1, log, tan
from ....kernel.records import Field, Record
from ...vectors import Vector3, clip, norm, vector
from ..gravity import central_gravity
from .iteration import TOLERANCE, solve_cones
from .problem import (
    CONTROL,
    EXPANSION,
    INTERVALS,
    LOWER_LIMIT,
    MIDDLE,
    NODES,
    POINT,
    STATE,
    STATES,
    UPPER_LIMIT,
    DescentProblem,
)

THRUST = 0
POSITION = 72
VELOCITY = 147
GRAVITY = 222
LOG_MASS = 297
PLAN = 322

LOWEST_LOG_MASS = -5.0  # least logarithm of mass in an expansion
SEED_BURNT = 0.75  # largest propellant of a first plan, as a fraction of the mass and of the propellant at full thrust


class DescentTask(Record):
    """Start, target and limits of a descent, landing-site frame."""

    position = Field(Vector3, unit="m", description="current position")
    velocity = Field(Vector3, unit="m/s", description="current velocity")
    target = Field(Vector3, unit="m", description="target position")
    arrival = Field(Vector3, unit="m/s", description="target velocity")
    mass = Field(unit="kg", description="current mass")
    maximum = Field(unit="N", description="largest thrust of the engine")
    minimum = Field(unit="N", description="least thrust of the engine")
    exhaust = Field(unit="m/s", description="exhaust speed of the engine")
    tilt = Field(unit="rad", description="largest angle between thrust and z; pi: no constraint")
    slope = Field(unit="rad", description="least elevation of the vehicle as seen from the target; 0: no constraint")
    depth = Field(unit="m", description="depth of the glide-slope cone's apex below the target")
    central = Field(bool, description="true: central gravity of a sphere; false: constant gravity")
    gravity = Field(unit="m/s2", description="constant gravitational acceleration along -z")
    parameter = Field(unit="m3/s2", description="gravitational parameter of the sphere")
    radius = Field(unit="m", description="distance of the landing site from the sphere's centre")


class PlanSummary(Record):
    """Duration, propellant and misses of a plan."""

    time = Field(unit="s", description="time of flight")
    solved = Field(bool, description="true: iterations converged; false: plan unchanged")
    iterations = Field(int, description="number of interior-point iterations")
    impulse = Field(unit="m/s", description="sum of h s, the velocity change of the plan")
    slope = Field(unit="m/s2", description="derivative of the objective with respect to the time of flight")
    propellant = Field(unit="kg", description="propellant of the plan")
    position_miss = Field(unit="m", description="distance from the target position at the end")
    velocity_miss = Field(unit="m/s", description="magnitude of the difference from the target velocity at the end")


def gravity_of(task: DescentTask, position: Vector3) -> Vector3:
    """Return the gravity (m/s2) at a position (m)."""
    if task.central:
        return central_gravity(position, task.radius, task.parameter)
    return vector(0.0, 0.0, -task.gravity)


def vector_of(plan: list, at: int) -> Vector3:
    """Return three consecutive numbers of a plan as a vector."""
    return vector(plan[at], plan[at + 1], plan[at + 2])


def store(plan: list, at: int, v: Vector3) -> None:
    """Store a vector as three consecutive numbers of a plan."""
    plan[at] = v.x
    plan[at + 1] = v.y
    plan[at + 2] = v.z


def seed_plan(task: DescentTask, time: float, plan: list) -> None:
    """Set the plan about which the first problem is expanded: a straight line with linearly decreasing mass."""
    burnt = clip(SEED_BURNT * task.maximum / task.mass * time / task.exhaust, 0.0, SEED_BURNT)
    for k in range(NODES):
        fraction = float(k) / float(INTERVALS)
        store(plan, POSITION + 3 * k, task.position + fraction * (task.target - task.position))
        plan[LOG_MASS + k] = log(1.0 - fraction * burnt)


def expand(task: DescentTask, time: float, plan: list, expansion: list) -> DescentProblem:
    """Return the scaled problem for a ``time`` (s) expanded about a plan, and set its data."""
    acceleration = task.maximum / task.mass
    length = norm(task.position - task.target)
    if not length > 1.0:
        length = 1.0
    unit = math.sqrt(length / acceleration)
    speed = acceleration * unit
    for k in range(NODES):
        store(expansion, 3 * k, gravity_of(task, vector_of(plan, POSITION + 3 * k)) / acceleration)
    for k in range(INTERVALS):
        middle = clip(0.5 * (plan[LOG_MASS + k] + plan[LOG_MASS + k + 1]), LOWEST_LOG_MASS, 0.0)
        expansion[MIDDLE + k] = middle
        expansion[UPPER_LIMIT + k] = exp(-middle)
        expansion[LOWER_LIMIT + k] = task.minimum / task.maximum * exp(-middle)
    return DescentProblem(
        step=time / unit / float(INTERVALS),
        exhaust=task.exhaust / speed,
        position=(task.position - task.target) / length,
        velocity=task.velocity / speed,
        arrival=task.arrival / speed,
        tilted=task.tilt < math.pi,
        upright=cos(task.tilt),
        sloped=task.slope > 0.0,
        slope=tan(task.slope),
        depth=task.depth / length,
        length=length,
        acceleration=acceleration,
        time=unit,
    )


def take_point(task: DescentTask, p: DescentProblem, expansion: list, point: list, time: float, plan: list) -> None:
    """Set a plan for a ``time`` (s) from the point of a solution."""
    h = time / float(INTERVALS)
    r = task.position
    v = task.velocity
    for k in range(NODES):
        store(plan, POSITION + 3 * k, r)
        store(plan, VELOCITY + 3 * k, v)
        here = p.acceleration * vector_of(expansion, 3 * k)
        store(plan, GRAVITY + 3 * k, here)
        plan[LOG_MASS + k] = point[STATES + STATE * k + 6]
        if k < INTERVALS:
            there = p.acceleration * vector_of(expansion, 3 * k + 3)
            u = p.acceleration * vector_of(point, CONTROL * k + 1)
            store(plan, THRUST + 3 * k, u)
            r = r + h * v + 0.5 * h * h * u + h * h * (here / 3.0 + there / 6.0)
            v = v + h * u + 0.5 * h * (here + there)


def improve_plan(task: DescentTask, time: float, plan: list) -> PlanSummary:
    """Solve the problem for a ``time`` (s) expanded about a plan, and set the plan to the solution."""
    return improve_plan_to(task, time, TOLERANCE, plan)


def improve_plan_to(task: DescentTask, time: float, tolerance: float, plan: list) -> PlanSummary:
    """Improve a plan as `improve_plan` does, to another ``tolerance`` of gap and residuals."""
    expansion = [0.0] * EXPANSION
    point = [0.0] * POINT
    p = expand(task, time, plan, expansion)
    solution = solve_cones(p, expansion, tolerance, point)
    if solution.solved:
        take_point(task, p, expansion, point, time, plan)
    last = 3 * INTERVALS
    return PlanSummary(
        time=time,
        solved=solution.solved,
        iterations=solution.iterations,
        impulse=solution.impulse * p.acceleration * p.time,
        slope=solution.slope * p.acceleration,
        propellant=-task.mass * expm1(plan[LOG_MASS + INTERVALS]),
        position_miss=norm(vector_of(plan, POSITION + last) - task.target),
        velocity_miss=norm(vector_of(plan, VELOCITY + last) - task.arrival),
    )
