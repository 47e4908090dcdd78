"""Primal-dual interior-point method for a descent problem. Kernel functions.

Every point satisfies the dynamics, slacks and multipliers are inside their cones, and steps are 0.99 of the largest
possible step.

Source: Mehrotra 1992; Vandenberghe 2010, section 7.
"""

from ....kernel.records import Field, Record
from ...vectors import clip, dot, norm, vector
from .cones import FIELDS, MULTIPLIER, SLACK
from .direction import (
    advance,
    gap_along,
    largest_step,
    scale_cones,
    set_correction,
    set_direction,
    set_residual,
)
from .problem import (
    CONTROL,
    COSTATES,
    END_POSITION,
    END_VELOCITY,
    GLIDE,
    INTERVALS,
    LOWER,
    LOWER_LIMIT,
    MIDDLE,
    MISSES,
    POINT,
    ROWS,
    STAGE,
    STATE,
    STATES,
    TILT,
    UPPER,
    UPPER_LIMIT,
    WEIGHT,
    DescentProblem,
    count_cones,
    gravity_at,
    roll_out,
    set_gradient,
    set_rows,
)
from .recursion import GAINS, dual_residual, factorise

ITERATION_LIMIT = 30
TOLERANCE = 1e-6  # tolerance of the scaled gap and residuals
LOOSE_TOLERANCE = 1e-4  # tolerance accepted if rounding ends the iterations
NEARLY = 0.99  # fraction of the largest step
FIRST_BOUND_SLACK = 1e-2  # least slack of the bounds at the start
FIRST_CONE_SLACK = 1e-1


class ConeSolution(Record):
    """Result of the iterations."""

    solved = Field(bool, description="true: gap and residuals below their tolerances")
    iterations = Field(int, description="number of iterations")
    impulse = Field(unit="1", description="scaled sum of h s")
    slope = Field(unit="1", description="scaled derivative of the objective with respect to the time of flight")


def begin(p: DescentProblem, expansion: list, point: list, c: list) -> None:
    """Set the first point, with thrust u = 0 and bounds s > 0, and slacks and multipliers inside their cones."""
    for i in range(POINT):
        point[i] = 0.0
    for i in range(3):
        point[STATES + i] = p.position[i]
        point[STATES + 3 + i] = p.velocity[i]
    for k in range(INTERVALS):
        ratio = 1.0 + expansion[MIDDLE + k] - point[STATES + STATE * k + 6]
        point[CONTROL * k] = 0.5 * (expansion[LOWER_LIMIT + k] + expansion[UPPER_LIMIT + k]) * ratio
        roll_out(p, expansion, k, point)
    last = STATES + STATE * INTERVALS
    position = vector(point[last], point[last + 1], point[last + 2])
    velocity = vector(point[last + 3], point[last + 4], point[last + 5])
    point[MISSES] = 1.5 * norm(position) + FIRST_CONE_SLACK
    point[MISSES + 1] = 1.5 * norm(velocity - p.arrival) + FIRST_CONE_SLACK
    set_rows(p, expansion, point, 1.0, c, SLACK)
    for i in range(ROWS):
        c[MULTIPLIER + i] = 0.0
    for k in range(INTERVALS):
        row = STAGE * k
        raise_to(c, SLACK + row, FIRST_BOUND_SLACK)
        raise_to(c, SLACK + row + UPPER, FIRST_BOUND_SLACK)
        raise_to(c, SLACK + row + LOWER, FIRST_BOUND_SLACK)
        raise_to(c, SLACK + row + TILT, FIRST_CONE_SLACK)
        side = vector(c[row + GLIDE + 1], c[row + GLIDE + 2], 0.0)
        raise_to(c, SLACK + row + GLIDE, norm(side) + FIRST_CONE_SLACK)
        c[MULTIPLIER + row] = p.step
        c[MULTIPLIER + row + UPPER] = p.step
        c[MULTIPLIER + row + LOWER] = p.step
        c[MULTIPLIER + row + TILT] = p.step
        c[MULTIPLIER + row + GLIDE] = p.step
    c[MULTIPLIER + END_POSITION] = WEIGHT
    c[MULTIPLIER + END_VELOCITY] = WEIGHT


def raise_to(c: list, at: int, lowest: float) -> None:
    """Set an element of c to ``lowest`` if it is smaller."""
    if not c[at] > lowest:
        c[at] = lowest


def sum_impulse(p: DescentProblem, point: list) -> float:
    """Return the sum of h s over the intervals."""
    total = 0.0
    for k in range(INTERVALS):
        total = total + p.step * point[CONTROL * k]
    return total


def time_slope(p: DescentProblem, expansion: list, point: list, c: list, costate: list) -> float:
    """Return the derivative of the objective with respect to the time of flight, with the expansion unchanged."""
    h = p.step
    total = 0.0
    for k in range(INTERVALS):
        size = point[CONTROL * k]
        state = STATES + STATE * k
        then = STATE * (k + 1)
        u = vector(point[CONTROL * k + 1], point[CONTROL * k + 2], point[CONTROL * k + 3])
        v = vector(point[state + 3], point[state + 4], point[state + 5])
        here = gravity_at(expansion, k)
        there = gravity_at(expansion, k + 1)
        position = vector(costate[then], costate[then + 1], costate[then + 2])
        velocity = vector(costate[then + 3], costate[then + 4], costate[then + 5])
        upper = c[MULTIPLIER + STAGE * k + UPPER] * expansion[UPPER_LIMIT + k]
        lower = c[MULTIPLIER + STAGE * k + LOWER] * expansion[LOWER_LIMIT + k]
        limits = 0.5 * (lower - upper) * size / p.exhaust
        total = total + size - costate[then + 6] * size / p.exhaust + limits
        total = total + dot(position, v + h * u + 2.0 * h * (here / 3.0 + there / 6.0))
        total = total + dot(velocity, u + 0.5 * (here + there))
    return total / float(INTERVALS)


def solve_cones(p: DescentProblem, expansion: list, tolerance: float, point: list) -> ConeSolution:
    """Solve the problem to a ``tolerance`` of gap and residuals, and set the point."""
    c = [0.0] * FIELDS
    gains = [0.0] * GAINS
    gradient = [0.0] * POINT
    step = [0.0] * POINT
    costate = [0.0] * COSTATES
    begin(p, expansion, point, c)
    cones = count_cones(p)
    iterations = 0
    largest = 0.0
    going = True
    while going:
        largest = set_residual(p, expansion, point, c)
        set_gradient(p, expansion, c, MULTIPLIER, 1.0, gradient)
        dual = dual_residual(p, gradient, costate)
        gap = gap_along(p, c, 0.0)
        largest = larger(largest, larger(dual, gap))
        going = largest >= tolerance and iterations < ITERATION_LIMIT
        if going:
            going = scale_cones(p, c)
        if going:
            going = factorise(p, expansion, c, gains)
        if going:
            iterations = iterations + 1
            set_correction(p, c, 0.0, False)
            set_direction(p, expansion, c, gains, 0.0, gradient, step)
            ratio = gap_along(p, c, clip(largest_step(p, c), 0.0, 1.0)) / gap
            centring = clip(ratio * ratio * ratio, 0.0, 1.0)
            set_correction(p, c, centring * gap / cones, True)
            set_direction(p, expansion, c, gains, centring, gradient, step)
            advance(c, point, step, clip(NEARLY * largest_step(p, c), 0.0, 1.0))
    solved = largest < tolerance or (largest < LOOSE_TOLERANCE and iterations < ITERATION_LIMIT)
    return ConeSolution(
        solved=solved,
        iterations=iterations,
        impulse=sum_impulse(p, point),
        slope=time_slope(p, expansion, point, c, costate),
    )


def larger(a: float, b: float) -> float:
    """Return the larger of two numbers."""
    if a > b:
        return a
    return b
