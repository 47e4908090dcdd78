"""Continuation of simplified hover-to-hover programmes to larger distances or times. Kernel functions.

Programmes, shapes and vehicles are defined in `shape` and `motion`; x and y (m) are the coordinates of the target in
the plane of the transfer. The continuation was developed for this repository.
"""

import math

from ...kernel.records import Field, Record, replace
from .motion import HoverVehicle, end_motion
from .shape import HoverProgramme, without_programme
from .solution import HoverSolution, PlanKind, solve

NEAR = 0.01  # horizontal distance of the first tilted programme, as a fraction of the drop
GROWTH = 1.5  # factor on x from one programme without first burn to the next
GROWTH_WITH_FIRST_BURN = 1.2
LEAST_GROWTH = 1.03
LARGEST_STRETCH = 0.06  # largest change of the end time from one programme to the next, as a fraction of it
LEAST_STRETCH = 0.001
NEARER = 0.9  # fraction of the largest x without first burn, at which a first burn begins
NEARER_STILL = 0.2  # decrease of this fraction if no first burn begins there
BEGINNINGS = 4  # number of attempts
ROOM = 1.25  # factor on the end time of a programme in which a first burn begins
LARGEST_PATH = 60  # programmes
TILT = 0.01  # rad, for the response to small tilts


class ReachedProgramme(Record):
    """Programme with the largest horizontal distance that a continuation reached."""

    programme = Field(HoverProgramme, description="programme with the largest horizontal distance reached")
    x = Field(unit="m", description="horizontal distance at the end of the programme; 0: not feasible")


def vertical(y: float, vehicle: HoverVehicle) -> HoverSolution:
    """Return the programme of a vertical descent."""
    nothing = HoverSolution(programme=without_programme(), is_feasible=False)
    fall = vehicle.gravity - vehicle.least
    brake = vehicle.full - vehicle.gravity
    scale = fall * (fall + brake)
    if not scale > 0.0:
        return nothing
    time = math.sqrt(-2.0 * y * brake / scale)
    last_burn = time * fall / brake
    end = time + last_burn
    if not end < math.inf:
        return nothing
    start = HoverProgramme(t2=0.0, t5=end, width=0.0, last_burn=last_burn, t7=end)
    return solve(PlanKind.VERTICAL, start, vehicle, 0.0, y)


def tilt_programme(x: float, vehicle: HoverVehicle, p: HoverProgramme) -> HoverSolution:
    """Return the vertical programme p tilted to end at about x (m) horizontally, or p if this is impossible.

    The thrust angle is about -u (1 - t/t7) + v t/t7, and the end depends linearly on u and v, which are determined by x
    and by rest at the end.
    """
    upright = HoverSolution(programme=p, is_feasible=False)
    turn = 2.0 * math.sqrt(TILT / vehicle.swing)
    first = end_motion(replace(p, t2=turn), vehicle)
    if not first.exists:
        return upright
    last = end_motion(replace(p, t5=p.t7 - turn), vehicle)
    if not last.exists:
        return upright
    # solves u first + v last = (x, 0) for u and v in units of TILT
    determinant = first.x * last.x_rate - first.x_rate * last.x
    if determinant == 0.0:
        return upright
    u = x * last.x_rate / determinant
    v = -x * first.x_rate / determinant
    if not (u >= 0.0 and v >= 0.0):
        return upright
    tilted = replace(p, t2=turn * math.sqrt(u), t5=p.t7 - turn * math.sqrt(v))
    return HoverSolution(programme=tilted, is_feasible=True)


def scale_turns(p: HoverProgramme, factor: float) -> HoverProgramme:
    """Return the programme with the durations of both turns multiplied by a factor."""
    return replace(p, t2=factor * p.t2, t5=p.t7 - factor * (p.t7 - p.t5))


def shift_end(p: HoverProgramme, end: float) -> HoverProgramme:
    """Return the programme with another end time (s) and its last burn shifted accordingly."""
    return replace(p, t5=p.t5 + end - p.t7, t7=end)


def solve_farther(
    kind: int, growth: float, distance: float, x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme
) -> tuple[HoverSolution, float]:
    """Return the programme with ``growth`` times the horizontal distance of p, and the distance (m) that it reaches.

    p ends at ``distance`` (m); the new distance is limited to x (m); ``kind`` is a PlanKind.
    """
    goal = growth * distance
    if goal > x:
        goal = x
    return solve(kind, scale_turns(p, math.sqrt(goal / distance)), vehicle, goal, y), goal


def continue_without_first_burn(x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> ReachedProgramme:
    """Continue the vertical programme p to one without first burn that reaches x or comes as near as possible."""
    place = x
    if place > -NEAR * y:
        place = -NEAR * y
    near = tilt_programme(place, vehicle, p)
    if near.is_feasible:
        near = solve(PlanKind.WITHOUT_FIRST_BURN, near.programme, vehicle, place, y)
    p = near.programme
    if not near.is_feasible:
        return ReachedProgramme(programme=p, x=0.0)
    growth = GROWTH
    for _ in range(LARGEST_PATH):
        if place < x and growth > LEAST_GROWTH:
            trial, goal = solve_farther(PlanKind.WITHOUT_FIRST_BURN, growth, place, x, y, vehicle, p)
            if trial.is_feasible:
                p = trial.programme
                place = goal
            else:
                growth = 0.5 * (1.0 + growth)
    return ReachedProgramme(programme=p, x=place)


def solve_with_end(end: float, x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> HoverSolution:
    """Return the programme with first burn that ends at ``end`` (s), starting from p with a similar end."""
    return solve(PlanKind.WITH_FIRST_BURN, shift_end(p, end), vehicle, x, y)


def continue_to_end(end: float, x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> HoverSolution:
    """Continue p in steps to the programme with first burn that ends at ``end`` (s), or to the last step possible."""
    part = LARGEST_STRETCH * p.t7
    for _ in range(LARGEST_PATH):
        left = end - p.t7
        if left != 0.0 and part > LEAST_STRETCH * p.t7:
            ahead = end
            if abs(left) > part:
                ahead = p.t7 + math.copysign(part, left)
            trial = solve_with_end(ahead, x, y, vehicle, p)
            if trial.is_feasible:
                p = trial.programme
            else:
                part = 0.5 * part
    return HoverSolution(programme=p, is_feasible=p.t7 == end)


def continue_with_first_burn(reached: ReachedProgramme, x: float, y: float, vehicle: HoverVehicle) -> HoverSolution:
    """Continue a programme without first burn to one with first burn that reaches x.

    The continuation goes back to a distance at which a first burn begins, then to longer durations, then to larger
    distances.
    """
    p = reached.programme
    end = p.t7
    distance = 0.0
    part = NEARER
    near = HoverSolution(programme=p, is_feasible=False)
    for _ in range(BEGINNINGS):
        if not near.is_feasible:
            distance = part * reached.x
            near = solve(
                PlanKind.WITHOUT_FIRST_BURN, scale_turns(reached.programme, math.sqrt(part)), vehicle, distance, y
            )
            if near.is_feasible:
                p = near.programme
                end = p.t7
                near = solve_with_end(1.01 * end, distance, y, vehicle, replace(p, width=0.1))
            part = part - NEARER_STILL
    if not near.is_feasible:
        return near
    longer = continue_to_end(ROOM * end, distance, y, vehicle, near.programme)
    p = longer.programme
    growth = GROWTH_WITH_FIRST_BURN
    for _ in range(LARGEST_PATH):
        if distance < x and growth > LEAST_GROWTH:
            trial, goal = solve_farther(PlanKind.WITH_FIRST_BURN, growth, distance, x, y, vehicle, p)
            if trial.is_feasible:
                p = trial.programme
                distance = goal
            else:
                longer = continue_to_end(1.04 * p.t7, distance, y, vehicle, p)
                p = longer.programme
                if not longer.is_feasible:
                    growth = 0.5 * (1.0 + growth)
    return HoverSolution(programme=p, is_feasible=distance >= x)
