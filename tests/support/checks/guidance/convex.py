"""Truth of convex guidance: Clarabel's plans in another formulation, and the feedback that follows them.

Adopted from the block: the first bracket of times, its bisection and the slack of 2 %, and the gains and limits of the
feedback.
"""

from dataclasses import replace
from functools import cache

import numpy as np

from tests.support.checks.guidance.terminal import CLAMPED, GOOD, NO_SOLUTION, STEP, Solution, check_of
from tests.support.flights.convex_descent import INTERVALS, MAXIMUM, Descent, settle, solve
from tests.support.flights.linear_thrust import GRAVITY, TARGET, UP, balance_polynomial, balance_roots, declared_state

TRUTH = "convex plans by Clarabel, with numpy"
MASS = 940.0  # kg, as guidance sees it all along
MARGIN = 0.92
SLOPE, DEPTH, TILT = 0.05, 5.0, 1.5  # rad, m, rad
LOW, HIGH, BISECTIONS, SLACK, CLEARANCE = 0.7, 1.2, 9, 1.02, 5.0
FREQUENCY, DAMPING, CORRECTION, WEAK, COAST = 0.15, 0.9, 0.12, 0.3, 0.7
DIFFERENCE = 0.05  # s
LAST_BURN = 1.5 * STEP  # s


def descent_of(position, velocity):
    return Descent(
        position=np.asarray(position),
        velocity=np.asarray(velocity),
        mass=MASS,
        target=TARGET,
        maximum=MARGIN * MAXIMUM,
        slope=SLOPE,
        depth=DEPTH,
        tilt=TILT,
        gravity=lambda positions: np.tile(-GRAVITY * UP, (len(positions), 1)),
    )


def costs_more_with_time(descent, time):
    """Return True if there is a path, and with more time it takes more."""
    path = settle(descent, time, 2)
    if path is None:
        return False
    expansion = path.position, path.log_mass
    before, after = (solve(descent, time + change, *expansion) for change in (-DIFFERENCE, DIFFERENCE))
    return before is not None and after.impulse > before.impulse


@cache
def plan_of(position, velocity):
    """Return the path to follow from a start, and the status."""
    status = GOOD
    descent = descent_of(position, velocity)
    balance = balance_polynomial(descent.position, descent.velocity, 3)
    (first,) = [T for T in balance_roots(descent.position, descent.velocity, 3) if balance.deriv()(T) < 0.0]
    low, high = LOW * first, HIGH * first
    offset = descent.position - TARGET
    margin = offset[2] + DEPTH - np.tan(SLOPE) * np.hypot(*offset[:2])
    if margin < 0.0:
        assert settle(descent, high, 1) is None
        descent, status = replace(descent, depth=DEPTH + CLEARANCE - margin), CLAMPED
    assert costs_more_with_time(descent, high)
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if costs_more_with_time(descent, middle) else (middle, high)
    path = settle(descent, high, 4)
    return solve(descent, SLACK * high, path.position, path.log_mass), status


def state_at(path, time):
    """Return position and velocity of a path, thrust constant over intervals and gravity all along."""
    step = path.time / INTERVALS
    k = min(int(time / step), INTERVALS - 1)
    since = time - k * step
    a = path.thrust[k] - GRAVITY * UP
    return path.position[k] + since * path.velocity[k] + 0.5 * since**2 * a, path.velocity[k] + since * a


def mean_thrust(path, time):
    """Return mean thrust acceleration over the cycle from ``time`` on."""
    edges = path.time / INTERVALS * np.arange(INTERVALS + 1)
    overlap = np.clip(edges[1:], time, time + STEP) - np.clip(edges[:-1], time, time + STEP)
    return overlap @ path.thrust / STEP


def planned(position, velocity, memory):
    """Plan at the first sample, follow the plan at those after it."""
    if not np.any(position - TARGET):
        return Solution(0.0, status=NO_SOLUTION)
    if "path" not in memory:
        memory["path"], memory["status"] = plan_of(tuple(position), tuple(velocity))
        memory["elapsed"] = 0.0
    else:
        memory["elapsed"] += STEP
    path, elapsed = memory["path"], memory["elapsed"]
    at, speed = state_at(path, elapsed)
    thrust = mean_thrust(path, elapsed)
    largest = MAXIMUM / MASS
    correction = FREQUENCY**2 * (at - position) + 2.0 * DAMPING * FREQUENCY * (speed - velocity)
    size = np.linalg.norm(thrust)
    limit = min(CORRECTION * largest, COAST * size if size < WEAK * largest else np.inf)
    thrust = thrust + correction * min(1.0, limit / max(np.linalg.norm(correction), 1e-9))
    size = np.linalg.norm(thrust)
    return Solution(path.time - elapsed, size, thrust / size, status=memory["status"])


def flight_along(position, velocity, seed, samples):
    """Return samples near the plan of a start: within some metres, and once within 25 m at 9 m/s, which is limited."""
    path, _ = plan_of(tuple(position), tuple(velocity))
    random = np.random.default_rng(seed)
    rows = [(np.asarray(position), np.asarray(velocity))]
    for number in range(1, samples):
        at, speed = state_at(path, number * STEP)
        off = 3.0 if number == samples // 2 else 1.0
        rows.append((at + 4.0 * off * random.uniform(-1.0, 1.0, 3), speed + off * random.uniform(-1.0, 1.0, 3)))
    return rows


def convex_guidance():
    """Check no time at the target itself; a braking flight up to 20 s before its end; and one
    from below the glide slope."""
    start = declared_state([0.3, 0.8, 0.5, 0.5, 0.6, 0.9])
    low = start[0] - 5000.0 * UP, start[1] * np.array([1.0, 1.0, 0.0])
    flights = [[(TARGET, np.zeros(3))], flight_along(*start, 41, 21), flight_along(*low, 42, 6)]
    parameters = {"sample_period": STEP, "glide_slope": SLOPE, "largest_tilt": TILT}
    check = check_of(TRUTH, flights, planned, parameters, last_burn=LAST_BURN)
    assert set(check.outputs["status"]) == {GOOD, CLAMPED, NO_SOLUTION}
    rows = len(check.inputs["active"])
    commands = {
        "thrust_acceleration": (1e-2, 0.0),
        "thrust_direction": (2e-3, 0.0),
        "thrust_direction_rate": (0.0, 0.0),
    }
    times = dict.fromkeys(("time_to_go", "burn_duration"), (1e-6, 1e-9))
    return replace(
        check,
        inputs={**check.inputs, "mass": np.full(rows, MASS)},
        tolerances={**check.tolerances, **commands, **times},
    )


TRUTHS = {"convex_guidance": convex_guidance}
