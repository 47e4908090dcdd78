"""Linear-quadratic problem of a search direction, solved by a backward Riccati recursion. Kernel functions.

The recursion minimises x'Hx/2 + gradient'x over all controls u under the dynamics x+ = A x + B u of `problem`, with H =
G' W^-2 G for the rows G of the slacks. The bounds on the end misses are eliminated first.

Source: Rao, Wright and Rawlings 1998, "Application of interior-point methods to model predictive control".
"""

import math

from .cones import weight_at
from .problem import (
    CONTROL,
    END_POSITION,
    END_VELOCITY,
    GLIDE,
    INTERVALS,
    LOWER,
    LOWER_LIMIT,
    MISSES,
    STAGE,
    STATE,
    STATES,
    TILT,
    UPPER,
    UPPER_LIMIT,
    DescentProblem,
)

# Stored for an interval: Cholesky factor of R (4 x 4) with inverted diagonal, K = R^-1 (S + B'PA) (4 x 7).
FACTORS = 16 * INTERVALS
GAINS = FACTORS + 28 * INTERVALS


def set_end_hessian(c: list, cost: list) -> None:
    """Set ``cost`` to the Hessian (7 x 7) of the last node, after elimination of the bounds on the misses."""
    for i in range(49):
        cost[i] = 0.0
    for end in range(2):
        row = END_POSITION + (END_VELOCITY - END_POSITION) * end
        corner = weight_at(c, row, 0, 0)
        for i in range(3):
            for j in range(3):
                side = weight_at(c, row, 1 + i, 0) * weight_at(c, row, 0, 1 + j) / corner
                cost[7 * (3 * end + i) + 3 * end + j] = weight_at(c, row, 1 + i, 1 + j) - side


def add_stage_hessian(p: DescentProblem, expansion: list, c: list, k: int, r: list, m: list, cost: list) -> None:
    """Add the Hessian of interval ``k`` to its terms in the control (4 x 4), mixed (4 x 7) and in the state (7 x 7)."""
    row = STAGE * k
    half = 0.5 * p.step / p.exhaust
    upper_limit = expansion[UPPER_LIMIT + k]
    lower_limit = expansion[LOWER_LIMIT + k]
    upper = weight_at(c, row + UPPER, 0, 0)
    lower = weight_at(c, row + LOWER, 0, 0)
    up = upper_limit * half - 1.0
    low = 1.0 - lower_limit * half
    for i in range(CONTROL):
        for j in range(CONTROL):
            r[4 * i + j] = r[4 * i + j] + weight_at(c, row, i, j)
    r[0] = r[0] + up * up * upper + low * low * lower
    m[6] = m[6] - up * upper_limit * upper + low * lower_limit * lower
    cost[48] = cost[48] + upper_limit * upper_limit * upper + lower_limit * lower_limit * lower
    if p.tilted:
        tilt = weight_at(c, row + TILT, 0, 0)
        r[0] = r[0] + p.upright * p.upright * tilt
        r[3] = r[3] - p.upright * tilt
        r[12] = r[12] - p.upright * tilt
        r[15] = r[15] + tilt
    if p.sloped and k > 0:
        glide = row + GLIDE
        for i in range(2):
            side = p.slope * weight_at(c, glide, 0, 1 + i)
            cost[7 * i + 2] = cost[7 * i + 2] + side
            cost[14 + i] = cost[14 + i] + side
            for j in range(2):
                cost[7 * i + j] = cost[7 * i + j] + p.slope * p.slope * weight_at(c, glide, 1 + i, 1 + j)
        cost[16] = cost[16] + weight_at(c, glide, 0, 0)


def decompose(r: list, gains: list, at: int) -> bool:
    """Store the Cholesky factor of R (4 x 4), diagonal inverted, in ``gains``; return False for a pivot of 0 or
    less.
    """
    for j in range(CONTROL):
        for i in range(j, CONTROL):
            entry = r[4 * i + j]
            for n in range(j):
                entry = entry - gains[at + 4 * i + n] * gains[at + 4 * j + n]
            if i == j:
                if not (entry > 0.0 and math.isfinite(entry)):
                    return False
                gains[at + 4 * i + j] = 1.0 / math.sqrt(entry)
            else:
                gains[at + 4 * i + j] = entry * gains[at + 4 * j + j]
    return True


def substitute(gains: list, at: int, x: list, first: int, stride: int) -> None:
    """Multiply four numbers of x, ``stride`` apart from ``first`` on, by R^-1."""
    for i in range(CONTROL):
        entry = x[first + stride * i]
        for n in range(i):
            entry = entry - gains[at + 4 * i + n] * x[first + stride * n]
        x[first + stride * i] = entry * gains[at + 5 * i]
    for i in range(CONTROL - 1, -1, -1):
        entry = x[first + stride * i]
        for n in range(i + 1, CONTROL):
            entry = entry - gains[at + 4 * n + i] * x[first + stride * n]
        x[first + stride * i] = entry * gains[at + 5 * i]


def factorise(p: DescentProblem, expansion: list, c: list, gains: list) -> bool:
    """Set factors and gains of all intervals for the present scaling; return False if a pivot is not positive."""
    cost = [0.0] * 49
    forced = [0.0] * 28
    mixed = [0.0] * 28
    r = [0.0] * 16
    h = p.step
    half = 0.5 * h * h
    burn = -h / p.exhaust
    set_end_hessian(c, cost)
    for k in range(INTERVALS - 1, -1, -1):
        # forced = B'P, mixed = B'PA, r = B'PB
        for j in range(STATE):
            forced[j] = burn * cost[42 + j]
            for i in range(3):
                forced[7 * (1 + i) + j] = half * cost[7 * i + j] + h * cost[7 * (3 + i) + j]
        for i in range(CONTROL):
            r[4 * i] = burn * forced[7 * i + 6]
            for j in range(3):
                r[4 * i + 1 + j] = half * forced[7 * i + j] + h * forced[7 * i + 3 + j]
                mixed[7 * i + j] = forced[7 * i + j]
                mixed[7 * i + 3 + j] = forced[7 * i + 3 + j] + h * forced[7 * i + j]
            mixed[7 * i + 6] = forced[7 * i + 6]
        # cost = A'PA: columns, then rows
        for i in range(STATE):
            for j in range(3):
                cost[7 * i + 3 + j] = cost[7 * i + 3 + j] + h * cost[7 * i + j]
        for i in range(3):
            for j in range(STATE):
                cost[7 * (3 + i) + j] = cost[7 * (3 + i) + j] + h * cost[7 * i + j]
        add_stage_hessian(p, expansion, c, k, r, mixed, cost)
        positive = decompose(r, gains, 16 * k)
        if not positive:
            return False
        at = FACTORS + 28 * k
        for i in range(28):
            gains[at + i] = mixed[i]
        for j in range(STATE):
            substitute(gains, 16 * k, gains, at + j, 7)
        for i in range(STATE):
            for j in range(i, STATE):
                entry = cost[7 * i + j]
                for n in range(CONTROL):
                    entry = entry - mixed[7 * n + i] * gains[at + 7 * n + j]
                cost[7 * i + j] = entry
                cost[7 * j + i] = entry
    return True


def solve_direction(p: DescentProblem, c: list, gains: list, gradient: list, step: list) -> None:
    """Set ``step`` (as a point) to the minimiser of the factorised problem for a ``gradient``."""
    h = p.step
    half = 0.5 * h * h
    burn = -h / p.exhaust
    last = STATES + STATE * INTERVALS
    slope = [0.0] * 7
    for end in range(2):
        row = END_POSITION + (END_VELOCITY - END_POSITION) * end
        ratio = gradient[MISSES + end] / weight_at(c, row, 0, 0)
        for i in range(3):
            slope[3 * end + i] = gradient[last + 3 * end + i] - weight_at(c, row, 1 + i, 0) * ratio
    slope[6] = gradient[last + 6]
    for k in range(INTERVALS - 1, -1, -1):
        at = CONTROL * k
        step[at] = gradient[at] + burn * slope[6]
        for i in range(3):
            step[at + 1 + i] = gradient[at + 1 + i] + half * slope[i] + h * slope[3 + i]
        # A' slope - K' (gradient of the control)
        for i in range(3):
            slope[3 + i] = slope[3 + i] + h * slope[i]
        for i in range(STATE):
            entry = slope[i] + gradient[STATES + STATE * k + i]
            for n in range(CONTROL):
                entry = entry - gains[FACTORS + 28 * k + 7 * n + i] * step[at + n]
            slope[i] = entry
        substitute(gains, 16 * k, step, at, 1)
    for i in range(STATE):
        step[STATES + i] = 0.0
    for k in range(INTERVALS):
        at = CONTROL * k
        state = STATES + STATE * k
        for n in range(CONTROL):
            entry = -step[at + n]
            for i in range(STATE):
                entry = entry - gains[FACTORS + 28 * k + 7 * n + i] * step[state + i]
            step[at + n] = entry
        for i in range(3):
            u = step[at + 1 + i]
            step[state + STATE + i] = step[state + i] + h * step[state + 3 + i] + half * u
            step[state + STATE + 3 + i] = step[state + 3 + i] + h * u
        step[state + STATE + 6] = step[state + 6] + burn * step[at]
    for end in range(2):
        row = END_POSITION + (END_VELOCITY - END_POSITION) * end
        entry = gradient[MISSES + end]
        for i in range(3):
            entry = entry + weight_at(c, row, 0, 1 + i) * step[last + 3 * end + i]
        step[MISSES + end] = -entry / weight_at(c, row, 0, 0)


def dual_residual(p: DescentProblem, gradient: list, costate: list) -> float:
    """Set the costates (7 per node); return the largest derivative of the Lagrangian by a control or a bound.

    ``gradient`` is the result of `set_gradient` with the multipliers.
    """
    h = p.step
    last = STATE * INTERVALS
    largest = 0.0
    for end in range(2):
        size = abs(gradient[MISSES + end])
        if size > largest:
            largest = size
    for i in range(STATE):
        costate[last + i] = gradient[STATES + last + i]
    for k in range(INTERVALS - 1, -1, -1):
        then = STATE * k + STATE
        size = abs(gradient[CONTROL * k] - h / p.exhaust * costate[then + 6])
        if size > largest:
            largest = size
        for i in range(3):
            size = abs(gradient[CONTROL * k + 1 + i] + 0.5 * h * h * costate[then + i] + h * costate[then + 3 + i])
            if size > largest:
                largest = size
            costate[then - STATE + i] = gradient[STATES + STATE * k + i] + costate[then + i]
            carried = costate[then + 3 + i] + h * costate[then + i]
            costate[then - STATE + 3 + i] = gradient[STATES + STATE * k + 3 + i] + carried
        costate[then - STATE + 6] = gradient[STATES + STATE * k + 6] + costate[then + 6]
    return largest
