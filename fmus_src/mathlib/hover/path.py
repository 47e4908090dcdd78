"""From one simplified hover-to-hover programme to the next: farther aside, or of another duration. Kernel functions.

Programmes, shapes and vehicles as in `shape` and `motion`; x and y (m) are the target's place in the plane
of the transfer. The path is ours.
"""

import math

from ...kernel.records import replace
from .motion import HoverVehicle, end_motion
from .shape import HoverProgramme, without_programme
from .solution import PlanKind, propellant_fraction, solve

NEAR = 0.01  # of the drop, where the first programme aside ends
GROWTH = 1.5  # of x from one programme without first burn to the next
GROWTH_WITH_FIRST_BURN = 1.2
LEAST_GROWTH = 1.03
LARGEST_STRETCH = 0.06  # of the end, from one programme to the next
LEAST_STRETCH = 0.001
ROOM = 1.25  # times the end of the programme in which a first burn begins; there it can go farther
LARGEST_PATH = 60  # programmes
TILT = 0.01  # rad, for the response to small tilts


def vertical(y: float, vehicle: HoverVehicle) -> tuple[HoverProgramme, bool]:
    """The programme straight down, and whether there is one."""
    p = without_programme()
    fall = vehicle.gravity - vehicle.least
    brake = vehicle.full - vehicle.gravity
    scale = fall * (fall + brake)
    if not scale > 0.0:
        return p, False
    time = math.sqrt(-2.0 * y * brake / scale)
    last_burn = time * fall / brake
    end = time + last_burn
    if not end < math.inf:
        return p, False
    p = replace(p, t5=end, last_burn=last_burn, t7=end)
    p, is_feasible = solve(PlanKind.VERTICAL, p, vehicle, 0.0, y)
    return p, is_feasible


def little_aside(x: float, vehicle: HoverVehicle, p: HoverProgramme) -> tuple[HoverProgramme, bool]:
    """The vertical programme p tilted so that it goes about x (m) aside, and whether it can be.

    The deviation is about -u (1 - t/t7) + v t/t7, to which the end answers linearly; u and v follow from x, and
    from rest.
    """
    turn = 2.0 * math.sqrt(TILT / vehicle.swing)
    first, exists = end_motion(replace(p, t2=turn), vehicle)
    if not exists:
        return p, False
    last, exists = end_motion(replace(p, t5=p.t7 - turn), vehicle)
    if not exists:
        return p, False
    # u first + v last = (x, 0), in units of TILT
    determinant = first.x * last.x_rate - first.x_rate * last.x
    if determinant == 0.0:
        return p, False
    u = x * last.x_rate / determinant
    v = -x * first.x_rate / determinant
    if not (u >= 0.0 and v >= 0.0):
        return p, False
    return replace(p, t2=turn * math.sqrt(u), t5=p.t7 - turn * math.sqrt(v)), True


def widen(p: HoverProgramme, factor: float) -> HoverProgramme:
    """The programme with both turns longer by a factor."""
    return replace(p, t2=factor * p.t2, t5=p.t7 - factor * (p.t7 - p.t5))


def lengthen(p: HoverProgramme, end: float) -> HoverProgramme:
    """The programme with another end (s), what comes last moved with it."""
    return replace(p, t5=p.t5 + end - p.t7, t7=end)


def aside(x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> tuple[HoverProgramme, float]:
    """From the vertical programme p to the one without first burn to x, or as near as there is; and its x (m)."""
    place = x
    if place > -NEAR * y:
        place = -NEAR * y
    p, is_feasible = little_aside(place, vehicle, p)
    if is_feasible:
        p, is_feasible = solve(PlanKind.WITHOUT_FIRST_BURN, p, vehicle, place, y)
    if not is_feasible:
        return p, 0.0
    growth = GROWTH
    for _ in range(LARGEST_PATH):
        if place < x and growth > LEAST_GROWTH:
            goal = growth * place
            if goal > x:
                goal = x
            trial, is_feasible = solve(PlanKind.WITHOUT_FIRST_BURN, widen(p, math.sqrt(goal / place)), vehicle, goal, y)
            if is_feasible:
                p = trial
                place = goal
            else:
                growth = 0.5 * (1.0 + growth)
    return p, place


def ending(end: float, x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> tuple[HoverProgramme, float]:
    """The programme with first burn that ends at ``end`` (s), from p near by; its propellant, infinite if none.

    Propellant is over the mass at the start.
    """
    other, is_feasible = solve(PlanKind.WITH_FIRST_BURN, lengthen(p, end), vehicle, x, y)
    if not is_feasible:
        return other, math.inf
    return other, propellant_fraction(other, vehicle)


def stretch(end: float, x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> tuple[HoverProgramme, bool]:
    """From p in steps to the programme with first burn that ends at ``end`` (s), or the last; whether it is reached."""
    part = LARGEST_STRETCH * p.t7
    for _ in range(LARGEST_PATH):
        left = end - p.t7
        if left != 0.0 and part > LEAST_STRETCH * p.t7:
            ahead = end
            if abs(left) > part:
                ahead = p.t7 + math.copysign(part, left)
            trial, value = ending(ahead, x, y, vehicle, p)
            if value < math.inf:
                p = trial
            else:
                part = 0.5 * part
    return p, p.t7 == end


def further(
    reached: float, x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme
) -> tuple[HoverProgramme, bool]:
    """From the programme p without first burn to x = reached (m), to one with it to x; whether there is one.

    A little nearer, where a first burn begins, then longer, then farther.
    """
    place = 0.9 * reached
    p, is_feasible = solve(PlanKind.WITHOUT_FIRST_BURN, widen(p, math.sqrt(0.9)), vehicle, place, y)
    if not is_feasible:
        return p, False
    end = p.t7
    p, is_feasible = solve(PlanKind.WITH_FIRST_BURN, lengthen(replace(p, width=0.1), 1.01 * end), vehicle, place, y)
    if not is_feasible:
        return p, False
    p, _ = stretch(ROOM * end, place, y, vehicle, p)
    growth = GROWTH_WITH_FIRST_BURN
    for _ in range(LARGEST_PATH):
        if place < x and growth > LEAST_GROWTH:
            goal = growth * place
            if goal > x:
                goal = x
            trial, is_feasible = solve(PlanKind.WITH_FIRST_BURN, widen(p, math.sqrt(goal / place)), vehicle, goal, y)
            if is_feasible:
                p = trial
                place = goal
            else:
                p, longer = stretch(1.04 * p.t7, place, y, vehicle, p)
                if not longer:
                    growth = 0.5 * (1.0 + growth)
    return p, place >= x
