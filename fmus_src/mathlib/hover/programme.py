"""Search for the simplified hover-to-hover programme of least propellant. Kernel functions.

Programmes, shapes and vehicles are defined in `shape` and `motion`; x >= 0 and y (m) are the coordinates of the target
in the plane of the transfer. Source: Huang 2017; the search was developed for this repository.
"""

import math

from ...kernel.records import Field, Record, replace
from .motion import HoverVehicle
from .path import continue_to_end, continue_with_first_burn, continue_without_first_burn, solve_with_end, vertical
from .shape import HoverProgramme, without_programme
from .solution import HoverSolution, PlanKind, propellant_fraction, solve

STRAIGHT = 1.0  # m, horizontal distance below which the vertical programme is used
FIRST_WIDTH = 0.05  # s, initial value of a first burn's width for Newton's method
WIDENING = 1.3  # factor on the width of a first burn from one programme to the next
SECTION = 0.6180339887498949  # golden section
TIME_SETTLED = 1e-3  # s, tolerance of the best end time
LARGEST_PATH = 60  # programmes


class PlannedProgramme(Record):
    """Result of a search for a programme."""

    kind = Field(int, description="form of the programme, a `PlanKind`")
    programme = Field(HoverProgramme, description="planned programme; all times 0 for PlanKind.NONE")


class Bracket(Record):
    """Programme that uses less propellant than those with an earlier and a later end time, if these are feasible."""

    programme = Field(HoverProgramme, description="programme with the least propellant found")
    before = Field(
        unit="s", description="end time of the next shorter programme; that of the programme itself if there is none"
    )
    beyond = Field(unit="s", description="end time of the next longer programme")


def nothing_planned() -> PlannedProgramme:
    """Return the result of a search that found no programme."""
    return PlannedProgramme(kind=PlanKind.NONE, programme=without_programme())


def programme(x: float, y: float, vehicle: HoverVehicle) -> PlannedProgramme:
    """Return the programme of least propellant to (x, y) (m)."""
    if not possible(x, y, vehicle):
        return nothing_planned()
    down = vertical(y, vehicle)
    if not down.is_feasible:
        return nothing_planned()
    if x < STRAIGHT:
        return PlannedProgramme(kind=PlanKind.VERTICAL, programme=down.programme)
    reached = continue_without_first_burn(x, y, vehicle, down.programme)
    if reached.x >= x:
        p = reached.programme
        burning = begin_first_burn(x, y, vehicle, p)
        if not propellant_fraction(p, vehicle) - propellant_of(burning, vehicle) > 0.0:
            return PlannedProgramme(kind=PlanKind.WITHOUT_FIRST_BURN, programme=p)
    else:
        if not reached.x > 0.0:
            return nothing_planned()
        burning = continue_with_first_burn(reached, x, y, vehicle)
        if not burning.is_feasible:
            return nothing_planned()
    return PlannedProgramme(kind=PlanKind.WITH_FIRST_BURN, programme=least_propellant(x, y, vehicle, burning.programme))


def begin_first_burn(x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> HoverSolution:
    """Return a programme with a first burn that is close to p, which has none."""
    later = replace(p, width=FIRST_WIDTH, t7=p.t7 + 0.2)
    burning = solve(PlanKind.WITH_FIRST_BURN, later, vehicle, x, y)
    if not burning.is_feasible:
        burning = grow_first_burn(x, y, vehicle, p)
    return burning


def grow_first_burn(x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> HoverSolution:
    """Lengthen the first burn of p, starting from none, as long as this reduces the propellant.

    The width of the burn determines the end time, which may become earlier, change fast with the width, and become
    later again.
    """
    best = HoverSolution(programme=p, is_feasible=False)
    minimum = propellant_fraction(p, vehicle)
    width = FIRST_WIDTH
    for _ in range(LARGEST_PATH):
        trial = solve(PlanKind.WITHOUT_FIRST_BURN, replace(p, width=width), vehicle, x, y)
        spent = propellant_of(trial, vehicle)
        if not spent < minimum:
            return best
        minimum = spent
        best = trial
        p = trial.programme
        width = WIDENING * width
    return best


def programme_of_duration(x: float, y: float, duration: float, vehicle: HoverVehicle) -> PlannedProgramme:
    """Return the programme to (x, y) (m) that ends at a prescribed time (s).

    The programme has a first burn unless the programme without one ends at exactly this time.
    """
    best = programme(x, y, vehicle)
    p = best.programme
    if best.kind == PlanKind.NONE or p.t7 == duration:
        return best
    if best.kind == PlanKind.VERTICAL or not math.isfinite(duration):
        return nothing_planned()
    if best.kind == PlanKind.WITHOUT_FIRST_BURN:
        p = replace(p, width=FIRST_WIDTH)
    timed = continue_to_end(duration, x, y, vehicle, p)
    if not timed.is_feasible:
        return nothing_planned()
    return PlannedProgramme(kind=PlanKind.WITH_FIRST_BURN, programme=timed.programme)


def possible(x: float, y: float, vehicle: HoverVehicle) -> bool:
    """Return True if the target is below, the vehicle can fall and brake, and all data are finite."""
    thrusts = is_usable(vehicle.full) and is_usable(vehicle.least) and is_usable(vehicle.exhaust)
    if not (thrusts and is_usable(vehicle.gravity) and is_usable(vehicle.swing)):
        return False
    if not (vehicle.least < vehicle.gravity and vehicle.full > vehicle.gravity):
        return False
    return y < 0.0 and math.isfinite(x) and math.isfinite(y)


def is_usable(value: float) -> bool:
    """Return True if a number is positive and finite."""
    return value > 0.0 and math.isfinite(value)


def propellant_of(solution: HoverSolution, vehicle: HoverVehicle) -> float:
    """Return the propellant of a programme divided by the initial mass; infinite if it is not feasible."""
    if not solution.is_feasible:
        return math.inf
    return propellant_fraction(solution.programme, vehicle)


def least_propellant(x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> HoverProgramme:
    """Return the programme with the end time of least propellant, by golden section from p, which has a first burn."""
    later = descend(1.0, x, y, vehicle, p)
    p = later.programme
    low = later.before
    high = later.beyond
    if low == p.t7:
        earlier = descend(-1.0, x, y, vehicle, p)
        p = earlier.programme
        low = earlier.beyond
        if earlier.before > p.t7:
            high = earlier.before
    minimum = propellant_fraction(p, vehicle)
    for _ in range(LARGEST_PATH):
        if high - low > TIME_SETTLED:
            end = p.t7 + (1.0 - SECTION) * (high - p.t7)
            if p.t7 - low > high - p.t7:
                end = p.t7 - (1.0 - SECTION) * (p.t7 - low)
            trial = solve_with_end(end, x, y, vehicle, p)
            value = propellant_of(trial, vehicle)
            outside = end  # bound of the new bracket
            if value < minimum:
                outside = p.t7
                minimum = value
                p = trial.programme
            if outside > p.t7:
                high = outside
            else:
                low = outside
    return p


def descend(way: float, x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> Bracket:
    """Shift the end time of p by ``way`` (s), then by growing steps, while this reduces the propellant."""
    minimum = propellant_fraction(p, vehicle)
    before = p.t7
    beyond = p.t7 + way
    for _ in range(LARGEST_PATH):
        trial = solve_with_end(beyond, x, y, vehicle, p)
        value = propellant_of(trial, vehicle)
        if not value < minimum:
            return Bracket(programme=p, before=before, beyond=beyond)
        minimum = value
        before = p.t7
        p = trial.programme
        way = 1.6 * way
        beyond = p.t7 + way
    return Bracket(programme=p, before=before, beyond=beyond)
