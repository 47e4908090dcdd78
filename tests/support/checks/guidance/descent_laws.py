"""Checks of descent laws: braking, a start near the target, at rest at the target, and beyond the limits."""

from dataclasses import replace

import numpy as np

from tests.support.checks.guidance.descent import (
    ENGINE,
    HOLD,
    LIMITS,
    command,
    effort_time,
    first_time,
    glide_margin,
    leg_of,
    polynomial_law,
)
from tests.support.checks.guidance.terminal import (
    CLAMPED,
    GOOD,
    NO_SOLUTION,
    STEP,
    Solution,
    check_of,
    disturb,
    path_of,
)
from tests.support.descent.hodograph import integrals, ratio_to_rest
from tests.support.descent.powered_steering import solve
from tests.support.flights.linear_thrust import GRAVITY, TARGET, UP, balance_roots, declared_state

TRUTH = "boundary conditions by numpy's linear solver, polynomial roots, a search written for arrays"
TOLERANCE = 1e-9  # of times between two prices that rounding may exchange
NOWHERE = (TARGET, np.zeros(3))  # at rest at the target


def braking(seed, fractions=(0.7, 0.2, 0.4, 0.1, 0.5, 0.3), rows=None, fraction=1e-3):
    """Return rows of a flight of the published box, whose errors make the thrust short on the way."""
    start = declared_state(fractions)
    path = list(zip(*disturb(path_of(*start, balance_roots(*start, 3)[-1]), seed, fraction), strict=True))
    return [*path, path[-1], path[-1]][:rows]


def near(seed, rows=6):
    """Return rows of a flight that begins level with the target."""
    start = TARGET + np.array([2000.0, 300.0, 400.0]), np.array([-20.0, 5.0, -10.0])
    return list(zip(*disturb(path_of(*start, effort_time(*start)), seed), strict=True))[:rows]


def zem_zev_guidance():
    shape = (1.0, 6.0, np.zeros(3))

    def choose(leg, memory):
        first = first_time(leg.position, leg.velocity)
        return (LIMITS.best_time(leg, first, shape) if first > 0.0 else 0.0), shape

    # too fast for the distance: more thrust than there is, whatever the time
    hasty = [(TARGET + np.array([9e3, 0.0, 900.0]), np.array([-500.0, 0.0, 0.0]))] * 3
    flights = [[NOWHERE, *braking(41)], near(42), hasty]
    check = check_of(TRUTH, flights, polynomial_law(choose, LIMITS), ENGINE, HOLD, TOLERANCE)
    assert set(check.outputs["status"]) == {GOOD, CLAMPED, NO_SOLUTION}
    assert set(check.outputs["limit"]) == {0, 1}
    assert check.outputs["choices"].max() > 1
    return check


def fractional_guidance():
    """Search for a glide slope and a tilt, which one start is outside of."""
    limits = replace(LIMITS, glide_slope=0.25, largest_tilt=1.2)
    shapes = [(1.0, kr, np.array([0.0, 0.0, 2.0])) for kr in (6.0, 8.0, 10.0, 12.0)]

    def choose(leg, memory):
        first = first_time(leg.position, leg.velocity)
        if first <= 0.0:
            return 0.0, shapes[0]
        times = [limits.best_time(leg, first, shape, True, 0.5, 0.0625) for shape in shapes]
        prices = [limits.price(leg, time, shape, True) for time, shape in zip(times, shapes, strict=True)]
        best = int(np.argmin(prices))
        return times[best], shapes[best]

    outside = [(TARGET + np.array([3000.0, 0.0, 100.0]), np.array([-40.0, 0.0, 0.0]))] * 3
    steep = [(TARGET + np.array([600.0, -200.0, 1500.0]), np.array([-15.0, 4.0, -30.0]))] * 3
    flights = [[NOWHERE, *near(43)], steep, outside, braking(44, rows=4)]
    parameters = ENGINE | {
        "gain_choice": 1,
        "glide_slope": limits.glide_slope,
        "largest_tilt": limits.largest_tilt,
        "final_thrust_acceleration[3]": 2.0,
    }
    check = check_of(TRUTH, flights, polynomial_law(choose, limits), parameters, HOLD, TOLERANCE)
    assert set(check.outputs["limit"]) == {0, 2, 6}
    return check


def apollo_guidance():
    """Compute times as roots of Klumpp's cubic; the last flight has none."""
    lift, deceleration, jerk = 2.2, 5.0, 0.029
    limits = replace(LIMITS, maximum=4.9)

    def final(memory):
        return lift * UP - deceleration * memory["forward"]

    def root(leg, memory, guess):
        way, gain = leg.errors(guess)
        arrival, forward = leg.velocity + gain, memory["forward"]
        constant = (final(memory) - GRAVITY * UP) @ forward
        cubic = [jerk, 6.0 * constant, (18.0 * arrival + 6.0 * leg.velocity) @ forward, 24.0 * way @ forward]
        roots = np.roots(cubic)
        times = -roots[(np.abs(roots.imag) < 1e-9 * np.abs(roots)) & (roots.real < 0.0)].real
        times = [time for time in times if abs(time - guess) < 0.2 * guess]
        return min(times, key=lambda time: abs(time - guess)) if times else 0.0

    def choose(leg, memory):
        level = (TARGET - leg.position) * [1.0, 1.0, 0.0]
        if level.any():
            memory["forward"] = level / np.linalg.norm(level)
        memory.setdefault("forward", np.array([1.0, 0.0, 0.0]))
        shape = (1.0, 12.0, final(memory))
        first = first_time(leg.position, leg.velocity)
        return (root(leg, memory, limits.best_time(leg, first, shape)) if first > 0.0 else 0.0), shape

    def update(leg, memory):
        if memory["time"] <= 10.0:
            return memory["time"]
        return root(leg, memory, memory["time"]) or memory["time"]

    check = check_of(
        TRUTH,
        [[NOWHERE, *braking(45)], braking(46, (0.1, 0.9, 0.2, 0.8, 0.3, 0.6))],
        polynomial_law(choose, limits, update),
        ENGINE | {"maximum_thrust": limits.maximum},
        HOLD,
        TOLERANCE,
    )
    assert set(check.outputs["status"]) >= {CLAMPED, NO_SOLUTION}
    return check


def gravity_turn_guidance():
    """Check an engine that waits for 60 % of its thrust; below the target, ascending, and with excessive thrust."""
    margin = 0.6 * LIMITS.maximum

    def law(position, velocity, memory):
        extras = {"limit": 0, "glide_margin": glide_margin(position, 0.0)}
        height, speed = position[2] - TARGET[2], np.linalg.norm(velocity)
        if height <= 0.0 or velocity[2] >= 0.0:
            return Solution(0.0, status=NO_SOLUTION, extras=extras)
        angle = np.arctan2(np.hypot(velocity[0], velocity[1]), -velocity[2])
        ratio = ratio_to_rest(speed, angle, height, GRAVITY)
        thrust = ratio * GRAVITY
        memory["burning"] = memory.get("burning", False) or thrust >= margin
        beyond = thrust > LIMITS.maximum
        direction = -np.asarray(velocity) / speed
        gravity = GRAVITY * UP
        rate = (gravity - (gravity @ direction) * direction) / speed
        time = integrals(speed, angle, ratio, GRAVITY)[1]
        extras["limit"] = int(beyond)
        size = thrust if memory["burning"] else 0.0
        return Solution(time, size, direction, rate, CLAMPED if beyond else GOOD, extras=extras)

    wait = [
        (TARGET + np.array([0.0, 0.0, height]), np.array([-40.0, 25.0, sink]))
        for height, sink in ((2500.0, -60.0), (1900.0, -73.0), (1250.0, -86.0), (700.0, -60.0), (450.0, -40.0))
    ]
    below = [(TARGET - np.array([0.0, 0.0, 5.0]), np.array([1.0, 0.0, -5.0])), (TARGET + 90.0 * UP, 3.0 * UP)]
    hasty = [(TARGET + 900.0 * UP, np.array([90.0, 0.0, -70.0])), (TARGET + 500.0 * UP, np.array([60.0, 0.0, -40.0]))]
    parameters = ENGINE | {"ignition_fraction": 0.6}
    truth = "quadrature of the hodograph, the ratio by brentq"
    check = check_of(truth, [wait, [*below, *hasty]], law, parameters, HOLD, TOLERANCE)
    assert set(check.outputs["status"]) == {GOOD, CLAMPED, NO_SOLUTION}
    assert 0.0 in check.outputs["thrust_acceleration"][check.outputs["status"] == GOOD]
    return check


def powered_guidance():
    """Check constant thrust from its equations, then ZEM/ZEV; excessive thrust, and a hovering start.

    The truth is the solution; three iterations in a cycle as long as 8 s stop 1e-3 before it.
    """
    shape, end_time = (1.0, 6.0, np.zeros(3)), 40.0

    def law(position, velocity, memory):
        leg = leg_of(position, velocity)
        extras = {"limit": 0, "glide_margin": glide_margin(position, 0.0)}
        if "time" not in memory:
            if velocity[0] == 0.0:
                return Solution(0.0, status=NO_SOLUTION, extras=extras)
            memory["time"] = first_time(position, velocity) + STEP
        memory["time"] -= STEP
        if "ending" not in memory:
            memory["time"], thrust, centre, line, turning = solve(leg, memory["time"], 1.0)
        if "ending" in memory or memory["time"] <= end_time:
            memory["ending"] = True
            return Solution(memory["time"], *command(leg, memory["time"], shape), extras=extras)
        line = line - centre * turning
        direction = line / np.linalg.norm(line)
        rate = (turning - (turning @ direction) * direction) / np.linalg.norm(line)
        beyond = thrust > LIMITS.maximum
        extras["limit"] = int(beyond)
        size = min(thrust, LIMITS.maximum)
        return Solution(memory["time"], size, direction, rate, CLAMPED if beyond else GOOD, extras=extras)

    hasty = [(TARGET + np.array([5e4, 0.0, 5e3]), np.array([-800.0, 0.0, 0.0]))] * 3
    hover = [(TARGET + np.array([0.0, 0.0, 500.0]), np.zeros(3))] * 2
    truth = "moments of thrust by Gauss and Legendre's rule, the conditions by scipy's root"
    check = check_of(truth, [braking(47, fraction=1e-5), hasty, hover], law, ENGINE, HOLD, 2e-3)
    assert set(check.outputs["status"]) == {GOOD, CLAMPED, NO_SOLUTION}
    rates = {f"thrust_direction_rate[{k}]": (bound, 0.0) for k, bound in ((1, 2.5e-5), (2, 1.7e-5), (3, 3.6e-5))}
    return replace(check, tolerances=check.tolerances | rates)


TRUTHS = {
    "zem_zev_guidance": zem_zev_guidance,
    "fractional_guidance": fractional_guidance,
    "apollo_guidance": apollo_guidance,
    "gravity_turn_guidance": gravity_turn_guidance,
    "powered_guidance": powered_guidance,
}
