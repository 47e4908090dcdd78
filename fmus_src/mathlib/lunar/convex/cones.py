"""Second-order cones under the scaling of Nesterov and Todd. Kernel functions.

A cone consists of a few rows x with x_0 >= |(x_1, ..)|; a nonnegative number is a cone of one row. Let J = diag(1, -1,
..), e = (1, 0, ..), and s and zeta the slack and the multiplier, each divided by the root of its x'Jx. With w = (s + J
zeta)/(2 g), g^2 = (1 + s'zeta)/2 and a = (w + e)/sqrt(2 (w_0 + 1)) the scaling is

    W = b (2 a a' - J),  W^-1 = (2 J a a' J - J)/b,  W^-2 = (2 J w w' J - J)/b^2,  lambda = W zeta = W^-1 s.

The numbers of all cones are stored in one list, as consecutive fields of ROWS rows.

Source: Vandenberghe 2010, "The CVXOPT linear and quadratic cone program solvers", sections 4 and 5.
"""

import math

from .problem import ROWS

SLACK = 0
MULTIPLIER = ROWS
SLACK_STEP = 2 * ROWS
MULTIPLIER_STEP = 3 * ROWS
LAMBDA = 4 * ROWS
CENTRE = 5 * ROWS  # the vector w of the scaling
AXIS = 6 * ROWS  # the vector a of the scaling
FACTOR = 7 * ROWS  # the factor b of the scaling, in the first row of a cone
RESIDUAL = 8 * ROWS  # residual of the slacks
SHIFT = 9 * ROWS  # shift of the multiplier's step, and terms of the gradient
CORRECTION = 10 * ROWS
SCALED_SLACK = 11 * ROWS
SCALED_MULTIPLIER = 12 * ROWS
FIELDS = 13 * ROWS + 4  # plus the rows of the largest cone, so that indices beyond the last row are provably valid


def lorentz(c: list, at: int, size: int) -> float:
    """Return x'Jx of the rows starting at ``at``; 0 or less if the rows are not an interior point of the cone."""
    square = 0.0
    for i in range(1, size):
        square = square + c[at + i] * c[at + i]
    length = math.sqrt(square)
    if not c[at] > length:
        return 0.0
    return (c[at] - length) * (c[at] + length)


def product(c: list, left: int, right: int, size: int) -> float:
    """Return the scalar product of the rows starting at ``left`` and at ``right``."""
    total = 0.0
    for i in range(size):
        total = total + c[left + i] * c[right + i]
    return total


def mirrored_product(c: list, left: int, right: int, size: int) -> float:
    """Return x'Jy of the rows starting at ``left`` and at ``right``."""
    total = c[left] * c[right]
    for i in range(1, size):
        total = total - c[left + i] * c[right + i]
    return total


def scale_cone(c: list, row: int, size: int) -> bool:
    """Set scaling and lambda of a cone; return False if slack, multiplier or lambda is not an interior point."""
    slack_square = lorentz(c, SLACK + row, size)
    multiplier_square = lorentz(c, MULTIPLIER + row, size)
    if not (slack_square > 0.0 and multiplier_square > 0.0):
        return False
    slack = math.sqrt(slack_square)
    multiplier = math.sqrt(multiplier_square)
    cosine = product(c, SLACK + row, MULTIPLIER + row, size) / (slack * multiplier)
    double = 2.0 * math.sqrt(0.5 * (1.0 + cosine))
    c[CENTRE + row] = (c[SLACK + row] / slack + c[MULTIPLIER + row] / multiplier) / double
    for i in range(1, size):
        c[CENTRE + row + i] = (c[SLACK + row + i] / slack - c[MULTIPLIER + row + i] / multiplier) / double
    length = math.sqrt(2.0 * (c[CENTRE + row] + 1.0))
    c[AXIS + row] = (c[CENTRE + row] + 1.0) / length
    for i in range(1, size):
        c[AXIS + row + i] = c[CENTRE + row + i] / length
    c[FACTOR + row] = math.sqrt(slack / multiplier)
    scale_up(c, row, size, MULTIPLIER, LAMBDA)
    return lorentz(c, LAMBDA + row, size) > 0.0


def scale_up(c: list, row: int, size: int, source: int, target: int) -> None:
    """Set the field ``target`` of a cone to W times the field ``source``."""
    double = 2.0 * product(c, AXIS + row, source + row, size)
    factor = c[FACTOR + row]
    c[target + row] = factor * (double * c[AXIS + row] - c[source + row])
    for i in range(1, size):
        c[target + row + i] = factor * (double * c[AXIS + row + i] + c[source + row + i])


def scale_down(c: list, row: int, size: int, source: int, target: int) -> None:
    """Set the field ``target`` of a cone to W^-1 times the field ``source``."""
    double = 2.0 * mirrored_product(c, AXIS + row, source + row, size)
    factor = 1.0 / c[FACTOR + row]
    c[target + row] = factor * (double * c[AXIS + row] - c[source + row])
    for i in range(1, size):
        c[target + row + i] = factor * (c[source + row + i] - double * c[AXIS + row + i])


def add_weighted(c: list, row: int, size: int, factor: float, source: int, target: int) -> None:
    """Add ``factor`` W^-2 times the field ``source`` of a cone to the field ``target``."""
    double = 2.0 * mirrored_product(c, CENTRE + row, source + row, size)
    scale = factor / (c[FACTOR + row] * c[FACTOR + row])
    c[target + row] = c[target + row] + scale * (double * c[CENTRE + row] - c[source + row])
    for i in range(1, size):
        c[target + row + i] = c[target + row + i] + scale * (c[source + row + i] - double * c[CENTRE + row + i])


def weight_at(c: list, row: int, i: int, j: int) -> float:
    """Return element i, j of W^-2 of the cone that starts at ``row``."""
    entry = 2.0 * c[CENTRE + row + i] * c[CENTRE + row + j]
    if i == j:
        if i == 0:
            entry = entry - 1.0
        else:
            entry = entry + 1.0
    elif i == 0 or j == 0:
        entry = -entry
    return entry / (c[FACTOR + row] * c[FACTOR + row])


def multiply_scaled(c: list, row: int, size: int, centring: float) -> None:
    """Set the correction of a cone to ``centring`` e minus the product of the scaled steps."""
    slack = SCALED_SLACK + row
    multiplier = SCALED_MULTIPLIER + row
    c[CORRECTION + row] = centring - product(c, slack, multiplier, size)
    for i in range(1, size):
        c[CORRECTION + row + i] = -(c[slack] * c[multiplier + i] + c[multiplier] * c[slack + i])


def divide_by_lambda(c: list, row: int, size: int) -> None:
    """Replace the correction d of a cone by the x whose product with lambda is d."""
    head = c[LAMBDA + row]
    determinant = lorentz(c, LAMBDA + row, size)
    along = 0.0
    for i in range(1, size):
        along = along + c[LAMBDA + row + i] * c[CORRECTION + row + i]
    first = (head * c[CORRECTION + row] - along) / determinant
    for i in range(1, size):
        c[CORRECTION + row + i] = (c[CORRECTION + row + i] - first * c[LAMBDA + row + i]) / head
    c[CORRECTION + row] = first


def inverse_step(c: list, row: int, size: int, field: int) -> float:
    """Return the inverse of the step along ``field`` at which lambda leaves the cone; 0 or less if it never does.

    Source: Vandenberghe 2010, section 8.3.
    """
    root = math.sqrt(lorentz(c, LAMBDA + row, size))
    along = mirrored_product(c, LAMBDA + row, field + row, size) / root
    factor = (along + c[field + row]) / (c[LAMBDA + row] / root + 1.0) / root
    square = 0.0
    for i in range(1, size):
        side = c[field + row + i] - factor * c[LAMBDA + row + i]
        square = square + side * side
    return (math.sqrt(square) - along) / root
