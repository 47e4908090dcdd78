"""The simplified hover-to-hover programme that takes least propellant: the search for it. Kernel functions.

Programmes, shapes and vehicles as in `shape` and `motion`; x >= 0 and y (m) are the target's place in the
plane of the transfer. Source: Huang 2017; the path of the search is ours.
"""

import math

from ...kernel.records import replace
from .motion import HoverVehicle
from .path import aside, ending, further, stretch, vertical
from .shape import HoverProgramme, without_programme
from .solution import PlanKind, propellant_fraction, solve

STRAIGHT = 1.0  # m; nearer to the vertical the vertical programme is flown
FIRST_WIDTH = 0.05  # s, from which Newton's method finds that of a first burn
SECTION = 0.6180339887498949  # golden
TIME_SETTLED = 1e-3  # s, of the best end
LARGEST_PATH = 60  # programmes


def programme(x: float, y: float, vehicle: HoverVehicle) -> tuple[int, HoverProgramme]:
    """Kind and programme to (x, y) on least propellant; NONE if none was found."""
    p = without_programme()
    is_feasible = possible(x, y, vehicle)
    if is_feasible:
        p, is_feasible = vertical(y, vehicle)
    if not is_feasible:
        return PlanKind.NONE, without_programme()
    if x < STRAIGHT:
        return PlanKind.VERTICAL, p
    p, reached = aside(x, y, vehicle, p)
    if reached >= x:
        trial = replace(p, width=FIRST_WIDTH, t7=p.t7 + 0.2)
        trial, is_feasible = solve(PlanKind.WITH_FIRST_BURN, trial, vehicle, x, y)
        if is_feasible:
            gain = propellant_fraction(p, vehicle) - propellant_fraction(trial, vehicle)
            is_feasible = gain > 0.0
        if not is_feasible:
            return PlanKind.WITHOUT_FIRST_BURN, p
        p = trial
    else:
        is_feasible = reached > 0.0
        if is_feasible:
            p, is_feasible = further(reached, x, y, vehicle, p)
        if not is_feasible:
            return PlanKind.NONE, without_programme()
    return PlanKind.WITH_FIRST_BURN, least_propellant(x, y, vehicle, p)


def programme_of_duration(x: float, y: float, duration: float, vehicle: HoverVehicle) -> tuple[int, HoverProgramme]:
    """Kind and programme to (x, y) that ends after a given time (s); NONE if none was found.

    It has a first burn, but if it is the one without that ends just then.
    """
    kind, p = programme(x, y, vehicle)
    if kind == PlanKind.NONE or p.t7 == duration:
        return kind, p
    is_feasible = kind != PlanKind.VERTICAL and math.isfinite(duration)
    if is_feasible and kind == PlanKind.WITHOUT_FIRST_BURN:
        p = replace(p, width=FIRST_WIDTH)
    if is_feasible:
        p, is_feasible = stretch(duration, x, y, vehicle, p)
    if not is_feasible:
        return PlanKind.NONE, without_programme()
    return PlanKind.WITH_FIRST_BURN, p


def possible(x: float, y: float, vehicle: HoverVehicle) -> bool:
    """Whether the target is below, the vehicle can fall and brake, and all is finite."""
    thrusts = is_usable(vehicle.full) and is_usable(vehicle.least) and is_usable(vehicle.exhaust)
    if not (thrusts and is_usable(vehicle.gravity) and is_usable(vehicle.swing)):
        return False
    if not (vehicle.least < vehicle.gravity and vehicle.full > vehicle.gravity):
        return False
    return y < 0.0 and math.isfinite(x) and math.isfinite(y)


def is_usable(value: float) -> bool:
    """Whether a number is positive and finite."""
    return value > 0.0 and math.isfinite(value)


def least_propellant(x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme) -> HoverProgramme:
    """From the programme p with first burn to the one whose end takes least propellant: golden section."""
    p, low, high = descend(1.0, x, y, vehicle, p)
    if low == p.t7:
        p, behind, low = descend(-1.0, x, y, vehicle, p)
        if behind > p.t7:
            high = behind
    minimum = propellant_fraction(p, vehicle)
    for _ in range(LARGEST_PATH):
        if high - low > TIME_SETTLED:
            end = p.t7 + (1.0 - SECTION) * (high - p.t7)
            if p.t7 - low > high - p.t7:
                end = p.t7 - (1.0 - SECTION) * (p.t7 - low)
            trial, value = ending(end, x, y, vehicle, p)
            outside = end  # of the new bracket
            if value < minimum:
                outside = p.t7
                minimum = value
                p = trial
            if outside > p.t7:
                high = outside
            else:
                low = outside
    return p


def descend(
    way: float, x: float, y: float, vehicle: HoverVehicle, p: HoverProgramme
) -> tuple[HoverProgramme, float, float]:
    """Move the end of p by way (s), then by more and more, as long as it takes less propellant.

    Returns the last programme, and the ends (s) before its own, which is that of p where there is none, and after it.
    """
    minimum = propellant_fraction(p, vehicle)
    before = p.t7
    beyond = p.t7 + way
    for _ in range(LARGEST_PATH):
        trial, value = ending(beyond, x, y, vehicle, p)
        if not value < minimum:
            return p, before, beyond
        minimum = value
        before = p.t7
        p = trial
        way = 1.6 * way
        beyond = p.t7 + way
    return p, before, beyond
