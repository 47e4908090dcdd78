"""Search directions of the interior-point method: residuals, predictor, corrector, largest step. Kernel functions.

Source: Mehrotra 1992, "On the implementation of a primal-dual interior point method"; Vandenberghe 2010, section 7.
"""

import math

from .cones import (
    CORRECTION,
    MULTIPLIER,
    MULTIPLIER_STEP,
    RESIDUAL,
    SCALED_MULTIPLIER,
    SCALED_SLACK,
    SHIFT,
    SLACK,
    SLACK_STEP,
    add_weighted,
    divide_by_lambda,
    inverse_step,
    multiply_scaled,
    scale_cone,
    scale_down,
    scale_up,
)
from .problem import CONES, LARGER, POINT, ROWS, DescentProblem, cone_row, cone_size, set_gradient, set_rows
from .recursion import solve_direction


def gap_along(p: DescentProblem, c: list, step: float) -> float:
    """Return the complementarity gap after a ``step`` in slacks and multipliers."""
    total = 0.0
    for j in range(CONES):
        row = cone_row(j) % ROWS
        size = cone_size(p, j) % LARGER
        for i in range(size):
            slack = c[SLACK + row + i] + step * c[SLACK_STEP + row + i]
            total = total + slack * (c[MULTIPLIER + row + i] + step * c[MULTIPLIER_STEP + row + i])
    return total


def set_residual(p: DescentProblem, expansion: list, point: list, c: list) -> float:
    """Set the residual of the slacks and return the largest magnitude."""
    set_rows(p, expansion, point, 1.0, c, RESIDUAL)
    largest = 0.0
    for j in range(CONES):
        row = cone_row(j) % ROWS
        size = cone_size(p, j) % LARGER
        for i in range(size):
            c[RESIDUAL + row + i] = c[SLACK + row + i] - c[RESIDUAL + row + i]
            if abs(c[RESIDUAL + row + i]) > largest:
                largest = abs(c[RESIDUAL + row + i])
    return largest


def set_direction(
    p: DescentProblem, expansion: list, c: list, gains: list, centring: float, gradient: list, step: list
) -> None:
    """Set the directions of point, slacks and multipliers, and their scaled forms, for the corrections in ``c``."""
    keep = 1.0 - centring
    for j in range(CONES):
        row = cone_row(j) % ROWS
        size = cone_size(p, j) % LARGER
        if size > 0:
            divide_by_lambda(c, row, size)
            scale_down(c, row, size, CORRECTION, SHIFT)
            add_weighted(c, row, size, keep, RESIDUAL, SHIFT)
            for i in range(size):
                c[SHIFT + row + i] = c[SHIFT + row + i] - centring * c[MULTIPLIER + row + i]
    set_gradient(p, expansion, c, SHIFT, keep, gradient)
    solve_direction(p, c, gains, gradient, step)
    set_rows(p, expansion, step, 0.0, c, SLACK_STEP)
    for j in range(CONES):
        row = cone_row(j) % ROWS
        size = cone_size(p, j) % LARGER
        if size > 0:
            for i in range(size):
                c[MULTIPLIER_STEP + row + i] = c[SHIFT + row + i] - keep * c[MULTIPLIER + row + i]
            add_weighted(c, row, size, -1.0, SLACK_STEP, MULTIPLIER_STEP)
            for i in range(size):
                c[SLACK_STEP + row + i] = c[SLACK_STEP + row + i] - keep * c[RESIDUAL + row + i]
            scale_down(c, row, size, SLACK_STEP, SCALED_SLACK)
            scale_up(c, row, size, MULTIPLIER_STEP, SCALED_MULTIPLIER)


def largest_step(p: DescentProblem, c: list) -> float:
    """Return the largest step for which slacks and multipliers remain in their cones; infinite if every step does."""
    inverse = 0.0
    for j in range(CONES):
        row = cone_row(j) % ROWS
        size = cone_size(p, j) % LARGER
        if size > 0:
            slack = inverse_step(c, row, size, SCALED_SLACK)
            multiplier = inverse_step(c, row, size, SCALED_MULTIPLIER)
            if slack > inverse:
                inverse = slack
            if multiplier > inverse:
                inverse = multiplier
    if inverse > 0.0:
        return 1.0 / inverse
    return math.inf


def set_correction(p: DescentProblem, c: list, centring: float, second_order: bool) -> None:
    """Set the right-hand sides of complementarity: 0 for the predictor, Mehrotra's correction with ``second_order``."""
    for j in range(CONES):
        row = cone_row(j) % ROWS
        size = cone_size(p, j) % LARGER
        if size > 0:
            if second_order:
                multiply_scaled(c, row, size, centring)
            else:
                for i in range(size):
                    c[CORRECTION + row + i] = 0.0


def scale_cones(p: DescentProblem, c: list) -> bool:
    """Set the scaling of all cones; return False if a slack or multiplier is not an interior point."""
    for j in range(CONES):
        row = cone_row(j) % ROWS
        size = cone_size(p, j) % LARGER
        if size > 0:
            inside = scale_cone(c, row, size)
            if not inside:
                return False
    return True


def advance(c: list, point: list, step: list, length: float) -> None:
    """Move point, slacks and multipliers by ``length`` along the direction."""
    for i in range(POINT):
        point[i] = point[i] + length * step[i]
    for i in range(ROWS):
        c[SLACK + i] = c[SLACK + i] + length * c[SLACK_STEP + i]
        c[MULTIPLIER + i] = c[MULTIPLIER + i] + length * c[MULTIPLIER_STEP + i]
