"""Truths of the two analytic guidances: thrust linear in time by linear equations, times to go by polynomial roots."""

import numpy as np

from tests.support.checks.guidance.certain_time import certain_time, effort_times, mean_size, turning
from tests.support.checks.guidance.terminal import (
    GOOD,
    NO_SOLUTION,
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
    balance_polynomial,
    balance_roots,
    declared_state,
    impulse_and_miss,
    linear_thrust,
)

TRUTH = "linear equations and polynomial roots by numpy"
LAST_BURN = 1.5 * STEP  # s


def published(position, velocity, memory):
    """Solve the quadratic for the time where it falls through 0, complex roots by their real part; angles are linear.

    The pitch rate holds the horizontal thrust and the cosine of the pitch at their start.
    """
    quadratic = balance_polynomial(position, velocity, 2)
    roots = quadratic.roots()
    time = float(roots[np.argmin(quadratic.deriv()(roots.real))].real)
    if time <= 0.0:
        return Solution(time)
    a0, a1 = linear_thrust(position, velocity, time)
    flat = np.hypot(a0[0], a0[1])
    if flat == 0.0:
        return Solution(time, status=NO_SOLUTION)
    direction = a0 / np.linalg.norm(a0)
    upward = (UP - direction[2] * direction) / np.hypot(direction[0], direction[1])
    yaw = (a0[0] * a1[1] - a0[1] * a1[0]) / flat**2 * np.cross(UP, direction)
    a, _ = impulse_and_miss(position, velocity, time)
    return Solution(time, np.linalg.norm(a) / time, direction, a1[2] / flat * upward + yaw)


def analytic_guidance():
    """Check a hovering start without a solution, a flight that stops, and one with samples
    straight above and sideways."""
    start = declared_state([0.3, 0.8, 0.5, 0.5, 0.6, 0.9])
    time = balance_roots(*start, 2)[-1]
    positions, velocities = disturb(path_of(*start, time), 31)
    hover = TARGET + 500.0 * UP, np.zeros(3)
    above = TARGET + 5000.0 * UP, -400.0 * UP
    first = [hover, hover, *zip(positions, velocities, strict=True)]
    sideways = TARGET + np.array([1e4, 0.0, 0.0]), np.array([-100.0, 200.0, 0.0])
    ahead = TARGET + np.array([380.0, 0.0, 0.0]), np.array([-100.0, 0.0, 0.0])  # 7.6 s
    second = [(POSITION, VELOCITY), above, above, sideways, ahead, (POSITION, VELOCITY)]
    assert not balance_roots(*sideways, 2)
    check = check_of(TRUTH, [first, second], published, {"sample_period": 0.0})
    assert set(check.outputs["status"]) == {GOOD, NO_SOLUTION}
    assert np.count_nonzero(np.diff(check.outputs["finished"].astype(int)) == 1) == 2
    return check


def exact(position, velocity, memory):
    """Solve without approximations: the direction turns as a0 + a1 t; at least effort the mean
    over the cycle is commanded."""
    time, least_effort = certain_time(position, velocity, memory)
    if time <= 0.0:
        return Solution(0.0)
    a0, a1 = linear_thrust(position, velocity, time)
    a, _ = impulse_and_miss(position, velocity, time)
    size = mean_size(a0, a1, time, LAST_BURN) if least_effort else np.linalg.norm(a) / time
    return Solution(time, size, *turning(a0, a1))


def analytic_exact_guidance():
    """Check braking with a sample of least effort; least effort that becomes braking; a time that is up; each to its
    end.

    Then a start that braking would take too long, which keeps to least effort, and one that is two cycles long.
    """
    start = declared_state([0.7, 0.2, 0.4, 0.1, 0.5, 0.3])
    hover = TARGET + np.array([300.0, 0.0, 400.0]), np.zeros(3)
    braking = list(zip(*disturb(path_of(*start, balance_roots(*start, 3)[-1]), 32), strict=True))
    braking[15] = hover
    level = TARGET + np.array([2000.0, 300.0, 0.0]), np.zeros(3)
    slow = list(zip(*disturb(path_of(*level, effort_times(*level)[0]), 33), strict=True))
    side = np.array([0.6, 0.0, 0.8])
    near = [(TARGET + distance * side, np.zeros(3)) for distance in (0.0, 42.5, 27.0, 27.0, 27.0)]
    dear = [(np.array([5000.0, -480.0, 5400.0]), np.array([-121.0, 18.0, -18.0])), (POSITION, VELOCITY)]
    short = [(TARGET + distance * side, np.zeros(3)) for distance in (70.0, 37.0, 37.0)]
    flights = [[*braking, braking[-1], braking[-1]], [*slow, slow[-1], slow[-1]], near, dear, short]
    check = check_of(TRUTH, flights, exact, {"sample_period": STEP}, last_burn=LAST_BURN)
    assert set(check.outputs["status"]) == {GOOD, NO_SOLUTION}
    assert np.count_nonzero(np.diff(check.outputs["finished"].astype(int)) == 1) == 3
    return check


TRUTHS = {"analytic_guidance": analytic_guidance, "analytic_exact_guidance": analytic_exact_guidance}
