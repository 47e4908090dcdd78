"""The simplified hover-to-hover programme that takes least propellant: the search for it. Kernel functions.

Programmes, shapes and vehicles as in `hover_shape` and `hover_motion`; x >= 0 and y (m) are the target's place in the
plane of the transfer. Source: Huang 2017; the path of the search is ours.
"""

import math

from .hover_motion import HoverVehicle
from .hover_path import aside, ending, further, stretch, vertical
from .hover_shape import END, UNKNOWNS, WIDTH, clear, copy
from .hover_solution import NONE, VERTICAL, WITH_FIRST_BURN, WITHOUT_FIRST_BURN, propellant_fraction, solve

STRAIGHT = 1.0  # m; nearer to the vertical the vertical programme is flown
FIRST_WIDTH = 0.05  # s, from which Newton's method finds that of a first burn
SECTION = 0.6180339887498949  # golden
TIME_SETTLED = 1e-3  # s, of the best end
LARGEST_PATH = 60  # programmes


def programme(x: float, y: float, vehicle: HoverVehicle, p: list) -> int:
    """p[5] = the programme to (x, y) on least propellant; returns its kind, NONE if none was found."""
    clear(p)
    is_feasible = possible(x, y, vehicle)
    if is_feasible:
        is_feasible = vertical(y, vehicle, p)
    if not is_feasible:
        clear(p)
        return NONE
    if x < STRAIGHT:
        return VERTICAL
    trial = [0.0] * UNKNOWNS
    reached = aside(x, y, vehicle, p)
    if reached >= x:
        copy(p, trial)
        trial[END] = p[END] + 0.2
        trial[WIDTH] = FIRST_WIDTH
        is_feasible = solve(WITH_FIRST_BURN, trial, vehicle, x, y)
        if is_feasible:
            gain = propellant_fraction(p, vehicle) - propellant_fraction(trial, vehicle)
            is_feasible = gain > 0.0
        if not is_feasible:
            return WITHOUT_FIRST_BURN
        copy(trial, p)
    else:
        is_feasible = reached > 0.0
        if is_feasible:
            is_feasible = further(reached, x, y, vehicle, p)
        if not is_feasible:
            clear(p)
            return NONE
    least_propellant(x, y, vehicle, p)
    return WITH_FIRST_BURN


def programme_of_duration(x: float, y: float, duration: float, vehicle: HoverVehicle, p: list) -> int:
    """p[5] = the programme to (x, y) that ends after a given time (s); returns its kind, NONE if none was found.

    It has a first burn, but if it is the one without that ends just then.
    """
    kind = programme(x, y, vehicle, p)
    if kind == NONE or p[END] == duration:
        return kind
    is_feasible = kind != VERTICAL and math.isfinite(duration)
    if is_feasible and kind == WITHOUT_FIRST_BURN:
        p[WIDTH] = FIRST_WIDTH
    if is_feasible:
        is_feasible = stretch(duration, x, y, vehicle, p)
    if not is_feasible:
        clear(p)
        return NONE
    return WITH_FIRST_BURN


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


def least_propellant(x: float, y: float, vehicle: HoverVehicle, p: list) -> None:
    """Change the programme p with first burn to the one whose end takes least propellant: golden section."""
    low, high = descend(1.0, x, y, vehicle, p)
    if low == p[END]:
        behind, low = descend(-1.0, x, y, vehicle, p)
        if behind > p[END]:
            high = behind
    trial = [0.0] * UNKNOWNS
    minimum = propellant_fraction(p, vehicle)
    for _ in range(LARGEST_PATH):
        if high - low > TIME_SETTLED:
            end = p[END] + (1.0 - SECTION) * (high - p[END])
            if p[END] - low > high - p[END]:
                end = p[END] - (1.0 - SECTION) * (p[END] - low)
            value = ending(end, x, y, vehicle, p, trial)
            outside = end  # of the new bracket
            if value < minimum:
                outside = p[END]
                minimum = value
                copy(trial, p)
            if outside > p[END]:
                high = outside
            else:
                low = outside


def descend(way: float, x: float, y: float, vehicle: HoverVehicle, p: list) -> tuple[float, float]:
    """Move the end of p by way (s), then by more and more, as long as it takes less propellant.

    Returns the ends (s) before the last one, which is that of p where there is none, and after it.
    """
    trial = [0.0] * UNKNOWNS
    minimum = propellant_fraction(p, vehicle)
    before = p[END]
    beyond = p[END] + way
    for _ in range(LARGEST_PATH):
        value = ending(beyond, x, y, vehicle, p, trial)
        if not value < minimum:
            return before, beyond
        minimum = value
        before = p[END]
        copy(trial, p)
        way = 1.6 * way
        beyond = p[END] + way
    return before, beyond
