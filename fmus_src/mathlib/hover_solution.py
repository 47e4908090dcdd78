"""Programmes of the simplified form that end where they should: Newton's method. Kernel functions.

Programmes, shapes and vehicles as in `hover_shape` and `hover_motion`.
"""

import math

from .hover_motion import HoverVehicle, motion, propellant
from .hover_shape import END, LAST_BURN, RETURN, TURN, UNKNOWNS, WIDTH, copy, shape_of
from .matrices import inverse

NONE = 0
VERTICAL = 1
WITHOUT_FIRST_BURN = 2
WITH_FIRST_BURN = 3

SETTLED = 1e-9  # of a residual, metres counted in tens
ITERATIONS = 12
LEAST_PART = 0.1  # of a step of Newton's
DIFFERENCE = 1e-6  # s


def propellant_fraction(p: list, vehicle: HoverVehicle) -> float:
    """Propellant of the programme p over the mass at its start; infinite without room for its shape."""
    s, room = shape_of(p, vehicle.swing)
    if not room:
        return math.inf
    return propellant(s, vehicle, p[END])


def residual(p: list, vehicle: HoverVehicle, x: float, y: float, r: list) -> float:
    """r[4] = what is missing at the end: (y/10, y', x/10, x'); returns its length, infinite without a motion."""
    s, room = shape_of(p, vehicle.swing)
    if not room:
        return math.inf
    state = [0.0] * 4
    moved = motion(s, vehicle, p[END], state)
    if not moved:
        return math.inf
    r[0] = 0.1 * (state[2] - y)
    r[1] = state[3]
    r[2] = 0.1 * (state[0] - x)
    r[3] = state[1]
    size = 0.0
    for i in range(4):
        size = size + r[i] * r[i]
    if not math.isfinite(size):
        return math.inf
    return math.sqrt(size)


def free_times(kind: int, free: list) -> int:
    """free[4] = indices of the times that Newton's method changes; their number, which is that of the conditions."""
    free[0] = LAST_BURN
    free[1] = END
    if kind == VERTICAL:
        return 2
    if kind == WITH_FIRST_BURN:
        free[1] = WIDTH
    free[2] = TURN
    free[3] = RETURN
    return 4


def move(kind: int, p: list, i: int, time: float) -> None:
    """Set a time of p (s). The vertical programme never turns, so that its return is at its end."""
    p[i] = time
    if kind == VERTICAL:
        p[RETURN] = p[END]


def sensitivities(kind: int, p: list, vehicle: HoverVehicle, x: float, y: float, r: list, inverted: list) -> bool:
    """inverted[16] = how the free times answer to the residual, by differences from r at p; whether they do."""
    free = [0] * 4
    n = free_times(kind, free)
    derivatives = [0.0] * 16
    ahead = [0.0] * 4
    for j in range(n):
        retained = p[free[j]]
        change = DIFFERENCE
        move(kind, p, free[j], retained + change)
        size = residual(p, vehicle, x, y, ahead)
        if not size < math.inf:
            change = -DIFFERENCE
            move(kind, p, free[j], retained + change)
            size = residual(p, vehicle, x, y, ahead)
        move(kind, p, free[j], retained)
        if not size < math.inf:
            return False
        for i in range(n):
            derivatives[n * i + j] = (ahead[i] - r[i]) / change
    is_regular = inverse(derivatives, inverted, n)
    return is_regular


def advance(
    kind: int, p: list, vehicle: HoverVehicle, x: float, y: float, r: list, inverted: list, part: float
) -> float:
    """Move p by a part of Newton's step from the residual r; returns the new residual's length, and r itself."""
    free = [0] * 4
    n = free_times(kind, free)
    for i in range(n):
        step = 0.0
        for j in range(n):
            step = step - inverted[n * i + j] * r[j]
        move(kind, p, free[i], p[free[i]] + part * step)
    size = residual(p, vehicle, x, y, r)
    return size


def solve(kind: int, p: list, vehicle: HoverVehicle, x: float, y: float) -> bool:
    """Change the free times of p until it ends at (x, y) (m) and at rest; whether it does. p is kept where not.

    Steps are halved until the residual falls; while it falls to a tenth, the sensitivities are kept. Free are t2, t5
    (not VERTICAL), w (WITH_FIRST_BURN), tp, t7 (not WITH_FIRST_BURN).
    """
    retained = [0.0] * UNKNOWNS
    copy(p, retained)
    before = [0.0] * UNKNOWNS
    inverted = [0.0] * 16
    r = [0.0] * 4
    last = [0.0] * 4
    known = False
    size = residual(p, vehicle, x, y, r)
    for _ in range(ITERATIONS):
        if not size < math.inf:
            copy(retained, p)
            return False
        if size <= SETTLED:
            return True
        fresh = not known
        if fresh:
            known = sensitivities(kind, p, vehicle, x, y, r, inverted)
            if not known:
                copy(retained, p)
                return False
        copy(p, before)
        for i in range(4):
            last[i] = r[i]
        ahead = advance(kind, p, vehicle, x, y, r, inverted, 1.0)
        part = 1.0
        while not ahead < size and fresh and part > LEAST_PART:
            part = 0.5 * part
            copy(before, p)
            for i in range(4):
                r[i] = last[i]
            ahead = advance(kind, p, vehicle, x, y, r, inverted, part)
        known = ahead < 0.1 * size
        if ahead < size:
            size = ahead
        elif fresh:
            size = math.inf
        else:
            copy(before, p)
            for i in range(4):
                r[i] = last[i]
    copy(retained, p)
    return False
