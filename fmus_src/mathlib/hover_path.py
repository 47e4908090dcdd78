"""From one simplified hover-to-hover programme to the next: farther aside, or of another duration. Kernel functions.

Programmes, shapes and vehicles as in `hover_shape` and `hover_motion`; x and y (m) are the target's place in the plane
of the transfer. The path is ours.
"""

import math

from .hover_motion import HoverVehicle, motion
from .hover_shape import END, LAST_BURN, RETURN, TURN, UNKNOWNS, WIDTH, copy, shape_of
from .hover_solution import VERTICAL, WITH_FIRST_BURN, WITHOUT_FIRST_BURN, propellant_fraction, solve

NEAR = 0.01  # of the drop, where the first programme aside ends
GROWTH = 1.5  # of x from one programme without first burn to the next
GROWTH_WITH_FIRST_BURN = 1.2
LEAST_GROWTH = 1.03
LARGEST_STRETCH = 0.06  # of the end, from one programme to the next
LEAST_STRETCH = 0.001
ROOM = 1.25  # times the end of the programme in which a first burn begins; there it can go farther
LARGEST_PATH = 60  # programmes
TILT = 0.01  # rad, for the response to small tilts


def vertical(y: float, vehicle: HoverVehicle, p: list) -> bool:
    """p = the programme straight down; whether there is one."""
    fall = vehicle.gravity - vehicle.least
    brake = vehicle.full - vehicle.gravity
    scale = fall * (fall + brake)
    if not scale > 0.0:
        return False
    time = math.sqrt(-2.0 * y * brake / scale)
    p[LAST_BURN] = time * fall / brake
    p[END] = time + p[LAST_BURN]
    p[RETURN] = p[END]
    if not p[END] < math.inf:
        return False
    is_feasible = solve(VERTICAL, p, vehicle, 0.0, y)
    return is_feasible


def little_aside(x: float, vehicle: HoverVehicle, p: list) -> bool:
    """Tilt the vertical programme p so that it goes about x (m) aside; whether it can be done.

    The deviation is about -u (1 - t/t7) + v t/t7, to which the end answers linearly; u and v follow from x, and
    from rest.
    """
    state = [0.0] * 4
    ahead = [0.0] * 4
    turn = 2.0 * math.sqrt(TILT / vehicle.swing)
    end = p[END]
    p[TURN] = turn
    s, fine = shape_of(p, vehicle.swing)
    if fine:
        fine = motion(s, vehicle, end, state)
    p[TURN] = 0.0
    p[RETURN] = end - turn
    if fine:
        s, fine = shape_of(p, vehicle.swing)
    if fine:
        fine = motion(s, vehicle, end, ahead)
    p[RETURN] = end
    if not fine:
        return False
    # u state + v ahead = (x, 0), in units of TILT
    determinant = state[0] * ahead[1] - state[1] * ahead[0]
    if determinant == 0.0:
        return False
    u = x * ahead[1] / determinant
    v = -x * state[1] / determinant
    if not (u >= 0.0 and v >= 0.0):
        return False
    p[TURN] = turn * math.sqrt(u)
    p[RETURN] = end - turn * math.sqrt(v)
    return True


def widen(p: list, factor: float, other: list) -> None:
    """other = p with both turns longer by a factor."""
    copy(p, other)
    other[TURN] = factor * p[TURN]
    other[RETURN] = p[END] - factor * (p[END] - p[RETURN])


def lengthen(p: list, end: float, other: list) -> None:
    """other = p with another end (s), what comes last moved with it."""
    copy(p, other)
    other[END] = end
    other[RETURN] = p[RETURN] + end - p[END]


def aside(x: float, y: float, vehicle: HoverVehicle, p: list) -> float:
    """From the vertical programme p to the one without first burn to x, or as near as there is; returns its x (m)."""
    place = x
    if place > -NEAR * y:
        place = -NEAR * y
    is_feasible = little_aside(place, vehicle, p)
    if is_feasible:
        is_feasible = solve(WITHOUT_FIRST_BURN, p, vehicle, place, y)
    if not is_feasible:
        return 0.0
    growth = GROWTH
    trial = [0.0] * UNKNOWNS
    for _ in range(LARGEST_PATH):
        if place < x and growth > LEAST_GROWTH:
            goal = growth * place
            if goal > x:
                goal = x
            widen(p, math.sqrt(goal / place), trial)
            is_feasible = solve(WITHOUT_FIRST_BURN, trial, vehicle, goal, y)
            if is_feasible:
                copy(trial, p)
                place = goal
            else:
                growth = 0.5 * (1.0 + growth)
    return place


def ending(end: float, x: float, y: float, vehicle: HoverVehicle, p: list, other: list) -> float:
    """other = the programme with first burn that ends at ``end`` (s), from p near by; its propellant, infinite if none.

    Propellant is over the mass at the start.
    """
    lengthen(p, end, other)
    is_feasible = solve(WITH_FIRST_BURN, other, vehicle, x, y)
    if not is_feasible:
        return math.inf
    return propellant_fraction(other, vehicle)


def stretch(end: float, x: float, y: float, vehicle: HoverVehicle, p: list) -> bool:
    """Change p to the programme with first burn that ends at ``end`` (s), in steps; whether it is reached."""
    trial = [0.0] * UNKNOWNS
    part = LARGEST_STRETCH * p[END]
    for _ in range(LARGEST_PATH):
        left = end - p[END]
        if left != 0.0 and part > LEAST_STRETCH * p[END]:
            ahead = end
            if abs(left) > part:
                ahead = p[END] + math.copysign(part, left)
            value = ending(ahead, x, y, vehicle, p, trial)
            if value < math.inf:
                copy(trial, p)
            else:
                part = 0.5 * part
    return p[END] == end


def further(reached: float, x: float, y: float, vehicle: HoverVehicle, p: list) -> bool:
    """From the programme p without first burn to x = reached (m), to one with it to x; whether there is one.

    A little nearer, where a first burn begins, then longer, then farther.
    """
    trial = [0.0] * UNKNOWNS
    place = 0.9 * reached
    widen(p, math.sqrt(0.9), trial)
    is_feasible = solve(WITHOUT_FIRST_BURN, trial, vehicle, place, y)
    if not is_feasible:
        return False
    copy(trial, p)
    p[WIDTH] = 0.1
    end = p[END]
    lengthen(p, 1.01 * end, trial)
    is_feasible = solve(WITH_FIRST_BURN, trial, vehicle, place, y)
    if not is_feasible:
        return False
    copy(trial, p)
    longer = stretch(ROOM * end, place, y, vehicle, p)
    growth = GROWTH_WITH_FIRST_BURN
    for _ in range(LARGEST_PATH):
        if place < x and growth > LEAST_GROWTH:
            goal = growth * place
            if goal > x:
                goal = x
            widen(p, math.sqrt(goal / place), trial)
            is_feasible = solve(WITH_FIRST_BURN, trial, vehicle, goal, y)
            if is_feasible:
                copy(trial, p)
                place = goal
            else:
                longer = stretch(1.04 * p[END], place, y, vehicle, p)
                if not longer:
                    growth = 0.5 * (1.0 + growth)
    return place >= x
