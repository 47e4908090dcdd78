"""Solution of simplified programmes for an end position, at rest, by Newton's method. Kernel functions.

Programmes, shapes and vehicles are defined in `shape` and `motion`.
"""

import math

from ...kernel.enumerations import Enumeration, member
from ...kernel.matrices import Matrix, identity, inverse
from ...kernel.records import Field, Record
from ..vectors import Vector4, vector
from .motion import HoverVehicle, end_motion, propellant
from .shape import HoverProgramme, shape_of

SETTLED = 1e-9  # tolerance of a residual, with lengths in units of 10 m
ITERATIONS = 12
LEAST_PART = 0.1  # smallest fraction of a Newton step
DIFFERENCE = 1e-6  # s, step of finite differences


class PlanKind(Enumeration):
    """Kind of a plan between hovers: none, a form of the programme, or a polynomial of degree 7."""

    NONE = member("none")
    VERTICAL = member("vertical")
    WITHOUT_FIRST_BURN = member("without first burn")
    WITH_FIRST_BURN = member("with first burn")
    POLYNOMIAL = member("polynomial")


class HoverSolution(Record):
    """Result of Newton's method."""

    programme = Field(
        HoverProgramme, description="programme found; an infeasible one close to the demand if none is feasible"
    )
    is_feasible = Field(bool, description="true: programme ends at the target at rest")


class Residual(Record):
    """End errors of a programme relative to its target."""

    errors = Field(Vector4, description="errors at the end of the programme: y/10 (m), y' (m/s), x/10 (m), x' (m/s)")
    size = Field(description="norm of the errors; infinite without a motion")


def propellant_fraction(p: HoverProgramme, vehicle: HoverVehicle) -> float:
    """Return the propellant of the programme p divided by the initial mass; infinite if p has no shape."""
    planned = shape_of(p, vehicle.swing)
    if not planned.exists:
        return math.inf
    return propellant(planned.shape, vehicle, p.t7)


def residual(p: HoverProgramme, vehicle: HoverVehicle, x: float, y: float) -> Residual:
    """Return the end errors of the programme p relative to (x, y) (m)."""
    end = end_motion(p, vehicle)
    if not end.exists:
        return Residual(errors=vector(0.0, 0.0, 0.0, 0.0), size=math.inf)
    r = vector(0.1 * (end.y - y), end.y_rate, 0.1 * (end.x - x), end.x_rate)
    square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3]
    if not math.isfinite(square):
        return Residual(errors=r, size=math.inf)
    return Residual(errors=r, size=math.sqrt(square))


def count_free_times(kind: int) -> int:
    """Return the number of times of a programme that Newton's method varies, which equals the number of conditions."""
    if kind == PlanKind.VERTICAL:
        return 2
    return 4


def change_of(kind: int, free: Vector4) -> HoverProgramme:
    """Return the change of a programme for a change ``free`` (s) of its free times.

    The free times are tp, then w (WITH_FIRST_BURN) or t7, then t2 and t5. A vertical programme never turns: its t5
    equals t7.
    """
    if kind == PlanKind.VERTICAL:
        return HoverProgramme(t2=0.0, t5=free[1], width=0.0, last_burn=free[0], t7=free[1])
    if kind == PlanKind.WITH_FIRST_BURN:
        return HoverProgramme(t2=free[2], t5=free[3], width=free[1], last_burn=free[0], t7=0.0)
    return HoverProgramme(t2=free[2], t5=free[3], width=0.0, last_burn=free[0], t7=free[1])


def invert_sensitivities(
    kind: int, p: HoverProgramme, vehicle: HoverVehicle, x: float, y: float, r: Vector4
) -> tuple[Matrix, bool]:
    """Return the derivatives (4 x 4) of the free times with respect to the residual r at p, and True if they exist.

    They are computed from finite differences.
    """
    n = count_free_times(kind)
    derivatives = identity(4)
    for j in range(n):
        free = [0.0] * 4
        change = DIFFERENCE
        free[j] = change
        ahead = residual(p + change_of(kind, vector(*free)), vehicle, x, y)
        if not ahead.size < math.inf:
            change = -DIFFERENCE
            free[j] = change
            ahead = residual(p + change_of(kind, vector(*free)), vehicle, x, y)
        if not ahead.size < math.inf:
            return derivatives, False
        for i in range(n):
            derivatives[i, j] = (ahead.errors[i] - r[i]) / change
    return inverse(derivatives)


def newton_step(kind: int, inverted: Matrix, r: Vector4) -> HoverProgramme:
    """Return the change of a programme by Newton's method for the residual r."""
    n = count_free_times(kind)
    free = [0.0] * 4
    for i in range(n):
        for j in range(n):
            free[i] = free[i] - inverted[i, j] * r[j]
    return change_of(kind, vector(*free))


def solve(kind: int, start: HoverProgramme, vehicle: HoverVehicle, x: float, y: float) -> HoverSolution:
    """Return the programme close to ``start`` that ends at (x, y) (m) at rest, or ``start`` if none is found.

    Steps are halved until the residual decreases; while each step reduces it to less than a tenth, the sensitivities
    are reused. The free times are tp; t2 and t5 except for VERTICAL; w for WITH_FIRST_BURN, otherwise t7.
    """
    p = start
    inverted = identity(4)
    known = False
    r = residual(p, vehicle, x, y)
    if not r.size < math.inf:
        return HoverSolution(programme=start, is_feasible=False)
    for _ in range(ITERATIONS):
        if r.size <= SETTLED:
            return HoverSolution(programme=p, is_feasible=True)
        fresh = not known
        if fresh:
            inverted, known = invert_sensitivities(kind, p, vehicle, x, y, r.errors)
            if not known:
                return HoverSolution(programme=start, is_feasible=False)
        step = newton_step(kind, inverted, r.errors)
        ahead = p + step
        r_ahead = residual(ahead, vehicle, x, y)
        part = 1.0
        while not r_ahead.size < r.size and fresh and part > LEAST_PART:
            part = 0.5 * part
            ahead = p + part * step
            r_ahead = residual(ahead, vehicle, x, y)
        known = r_ahead.size < 0.1 * r.size
        if r_ahead.size < r.size:
            p = ahead
            r = r_ahead
        elif fresh:
            return HoverSolution(programme=start, is_feasible=False)
    return HoverSolution(programme=start, is_feasible=False)
