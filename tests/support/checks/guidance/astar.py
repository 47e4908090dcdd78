"""Truths of guidance by method A*: times by polynomial roots or the published formula, thrust linear in time.

Adopted from the method: Newton's method reaches the root nearest to its start, 2 R/V or the last root.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from tests.support.checks.guidance.astar_programme import programme
from tests.support.checks.guidance.certain_time import certain_time, mean_size, turning
from tests.support.checks.guidance.terminal import (
    CLAMPED,
    GOOD,
    NO_SOLUTION,
    NOT_CONVERGED,
    STEP,
    Solution,
    check_of,
    disturb,
    path_of,
)
from tests.support.flights.linear_thrust import (
    POSITION,
    TARGET,
    UP,
    VELOCITY,
    astar_roots,
    balance_roots,
    declared_state,
    impulse_and_miss,
    linear_thrust,
    modified_time,
    states_of_the_box,
)

TRUTH = "linear equations and polynomial roots by numpy"
FORWARD = 0.05
LAST_BURN = 2.5 * STEP  # s


def cycle_of(memory):
    """Return the cycle (s) that the block knows: 0 in the first sample of a flight."""
    memory["samples"] = memory.get("samples", 0) + 1
    return STEP if memory["samples"] > 1 else 0.0


def impact_size(position, velocity, time):
    return 2.0 * np.linalg.norm(impulse_and_miss(position, velocity, time)[1]) / time**2


def newton(position, velocity, memory):
    """Find the root of (A T - 3 B).(A T - 2 B) = 0 nearest to the start."""
    cycle, speed = cycle_of(memory), np.linalg.norm(velocity)
    if "root" not in memory and speed == 0.0:
        return Solution(0.0, status=NO_SOLUTION, clamps=0)
    start = memory.get("root", 2.0 * np.linalg.norm(TARGET - position) / max(speed, 1e-300))
    distances = sorted((abs(root - start), root) for root in astar_roots(position, velocity))
    if not distances:
        return Solution(0.0, status=NOT_CONVERGED, clamps=0)
    largest = max(root for _, root in distances)  # reached from all starts beyond it
    assert start >= largest or len(distances) == 1 or distances[1][0] > 3.0 * distances[0][0]
    memory["root"] = time = distances[0][1]
    return programme(position, velocity, time, impact_size(position, velocity, time), cycle)


def astar_guidance():
    """Check samples without a root on the way, a start without one, a start at rest, one whose root is kept."""
    states = states_of_the_box(200, 34)
    rootless = [state for state in states if not astar_roots(*state)][:3]
    start = next(state for state in states if len(astar_roots(*state)) > 1 and np.ptp(astar_roots(*state)) > 50.0)
    flight = list(zip(*path_of(*start, astar_roots(*start)[-1]), strict=True))
    flight[8:10] = rootless[:2]
    at_rest = TARGET + 500.0 * UP, np.zeros(3)
    flights = [flight, [rootless[2], at_rest, start, start], [at_rest, start], [flight[7], start, start]]
    check = check_of(TRUTH, flights, newton, {"sample_period": 0.0})
    assert set(check.outputs["status"]) == {GOOD, NOT_CONVERGED, NO_SOLUTION}
    assert check.outputs["time_to_go"][-2] == astar_roots(*start)[0]  # not the last, which a start takes
    return check


def closed(position, velocity, memory):
    cycle = cycle_of(memory)
    if not velocity.any():
        return Solution(0.0, status=NO_SOLUTION, clamps=0)
    time = float(modified_time(position, velocity))
    if time <= 0.0:
        return Solution(time, clamps=0)
    return programme(position, velocity, time, impact_size(position, velocity, time), cycle)


def excess(state):
    """Return the excess of lateral and vertical thrust alone over the whole, as a fraction;
    above 0 thrust is clamped."""
    time = modified_time(*state)
    a0, _ = linear_thrust(*state, time)
    size = impact_size(*state, time)
    return np.hypot(a0[1], a0[2]) / size - 1.0 if abs(a0[1]) < size else np.nan


def astar_modified_guidance():
    """Check a flight to its stop, with samples that turn by a radian and more; clamped starts; no time, and less."""
    states = states_of_the_box(3000, 35)
    excesses = np.array([excess(state) for state in states])
    clamped = [states[k] for k in np.flatnonzero(excesses > 1e-3)[:3]]
    steep = [states[k] for k in np.argsort(np.where(excesses < 0.0, -excesses, np.inf))[:5]]
    start = declared_state([0.2, 0.3, 0.7, 0.4, 0.5, 0.6])
    flight = list(zip(*disturb(path_of(*start, modified_time(*start)), 36), strict=True))
    flight[6:6] = steep
    at_target = TARGET + np.array([1.0, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0])
    end = [(POSITION, VELOCITY), (POSITION, np.zeros(3)), at_target]
    flights = [flight, *([state] for state in clamped), end]
    check = check_of(TRUTH, flights, closed, {"sample_period": 0.0})
    assert set(check.outputs["status"]) == {GOOD, CLAMPED, NO_SOLUTION}
    assert check.outputs["time_to_go"][-1] < 0.0
    assert (check.outputs["thrust_direction_rate"][7:12] == 0.0).all(axis=1).tolist() == [True, True, False, True, True]
    return check


def robust(position, velocity, memory):
    """Return the thrust a0 + a1 t at its start; linear where it is of least effort or points hardly forward."""
    time, least_effort = certain_time(position, velocity, memory)
    if time <= 0.0:
        return Solution(0.0, clamps=0)
    a0, a1 = linear_thrust(position, velocity, time)
    size = np.linalg.norm(a0)
    if least_effort or a0[0] <= FORWARD * size:
        return Solution(time, mean_size(a0, a1, time, LAST_BURN), *turning(a0, a1), clamps=0)
    return programme(position, velocity, time, size, STEP)


def astar_robust_guidance():
    """Check braking along x, braking along -x, least effort from rest: each to its end, with a long last burn.

    Then braking with a tenth of the thrust along x.
    """
    start = declared_state([0.6, 0.9, 0.1, 0.8, 0.2, 0.4])
    mirror = np.array([-1.0, 1.0, 1.0])
    level = TARGET + np.array([1500.0, -900.0, 100.0]), np.zeros(3)
    forward = list(zip(*disturb(path_of(*start, balance_roots(*start, 3)[-1]), 37), strict=True))
    backward = [(mirror * position, mirror * velocity) for position, velocity in forward[:3]]
    slow = list(zip(*disturb(path_of(*level, 80.0), 38), strict=True))
    aside = Rotation.from_euler("z", 1.0)
    flights = [[*forward, forward[-1], forward[-1]], backward, [*slow, slow[-1]], [tuple(aside.apply(forward[0]))]]
    check = check_of(TRUTH, flights, robust, {"sample_period": STEP, "last_burn": LAST_BURN}, last_burn=LAST_BURN)
    assert set(check.outputs["status"]) == {GOOD}
    assert FORWARD < check.outputs["thrust_direction"][-1, 0] < 0.1
    assert np.count_nonzero(np.diff(check.outputs["finished"].astype(int)) == 1) == 2
    return check


TRUTHS = {
    "astar_guidance": astar_guidance,
    "astar_modified_guidance": astar_modified_guidance,
    "astar_robust_guidance": astar_robust_guidance,
}
