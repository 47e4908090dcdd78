"""Direct multiple shooting of a free-time problem: constant controls and one Runge-Kutta step per interval.

The states at the ends of all equal intervals are additional unknowns, and IPOPT (Waechter and Biegler 2006) solves the
resulting sparse nonlinear programme; CasADi (Andersson et al. 2019) formulates it with its derivatives. Solving the
point-mass problem in this way, from a crude guess, verifies the convex form.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .path import PlanError
from .point_mass import PointMassProblem
from .solvers import Symbol, casadi

TOLERANCE = 1e-9
ITERATIONS = 1000
THROTTLE = 0.7  # throttle of the guess


@dataclass(frozen=True)
class ShootingProblem:
    """Problem to minimise the last state, from ``start`` to ``end`` (nan for a free element) in free time.

    States and controls are scaled. ``rate`` returns the derivative of the states with respect to time in s (a CasADi
    vector) from states and controls; ``low`` and ``high`` bound the controls.
    """

    rate: Callable[[Symbol, Symbol], Symbol]
    start: np.ndarray
    end: np.ndarray
    low: np.ndarray
    high: np.ndarray


@dataclass(frozen=True)
class Shooting:
    """Solution: N + 1 rows of states at the ends of intervals, N rows of controls, and the ``duration`` (s).

    ``costates`` contains a row for each of the last N ends: the derivatives of the final value of the last state with
    respect to the states at that end, which are the multipliers of the continuity conditions. It is None for a guess.
    """

    duration: float
    states: np.ndarray
    controls: np.ndarray
    costates: np.ndarray | None = None


def shoot(problem: ShootingProblem, guess: Shooting) -> Shooting:
    """Solve a problem on as many intervals as the guess has. Raises `PlanError`."""
    ca = casadi()
    intervals = guess.controls.shape[0]
    x, u, t = ca.SX.sym("x", problem.start.size), ca.SX.sym("u", problem.low.size), ca.SX.sym("t")
    h = t / intervals
    k1 = problem.rate(x, u)
    k2 = problem.rate(x + h / 2.0 * k1, u)
    k3 = problem.rate(x + h / 2.0 * k2, u)
    k4 = problem.rate(x + h * k3, u)
    step = ca.Function("step", [x, u, t], [x + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)])

    states = ca.MX.sym("X", problem.start.size, intervals + 1)
    controls = ca.MX.sym("U", problem.low.size, intervals)
    time = ca.MX.sym("T")
    ends = step.map(intervals)(states[:, :-1], controls, ca.repmat(time, 1, intervals))
    unknowns = ca.vertcat(time, ca.vec(states), ca.vec(controls))
    defects = ca.vec(states[:, 1:] - ends)
    options = {"print_time": False, "ipopt": {"tol": TOLERANCE, "max_iter": ITERATIONS, "print_level": 0, "sb": "yes"}}
    solver = ca.nlpsol("plan", "ipopt", {"x": unknowns, "f": states[-1, -1], "g": defects}, options)

    lowest = np.full((intervals + 1, problem.start.size), -np.inf)
    highest = -lowest
    lowest[0] = highest[0] = problem.start
    fixed = ~np.isnan(problem.end)
    lowest[-1, fixed] = highest[-1, fixed] = problem.end[fixed]
    solution = solver(
        x0=np.concatenate([[guess.duration], guess.states.ravel(), guess.controls.ravel()]),
        lbx=np.concatenate([[0.2 * guess.duration], lowest.ravel(), np.tile(problem.low, intervals)]),
        ubx=np.concatenate([[5.0 * guess.duration], highest.ravel(), np.tile(problem.high, intervals)]),
        lbg=0.0,
        ubg=0.0,
    )
    if not solver.stats()["success"]:
        raise PlanError(f"direct method on {intervals} intervals: IPOPT ended with {solver.stats()['return_status']}")
    values = np.array(solution["x"]).ravel()
    cut = 1 + guess.states.size
    return Shooting(
        float(values[0]),
        values[1:cut].reshape(guess.states.shape),
        values[cut:].reshape(guess.controls.shape),
        -np.array(solution["lam_g"]).reshape(intervals, problem.start.size),
    )


def direct_propellant(problem: PointMassProblem, intervals: int) -> tuple[float, float]:
    """Compute the propellant fraction and the duration (s) by multiple shooting on ``intervals`` intervals.

    The states are position, velocity, and propellant over the initial mass. Raises `PlanError`.
    """
    length, speed = problem.length, problem.speed
    ca = casadi()

    def rate(x: Symbol, u: Symbol) -> Symbol:
        push = problem.most * u[0] / (1.0 - x[4])
        along, up = problem.gravity.at(length * x[0], length * x[1])
        return ca.vertcat(
            speed / length * x[2:4],
            (push * ca.cos(u[1]) + along) / speed,
            (push * ca.sin(u[1]) + up) / speed,
            problem.most / problem.exhaust_speed * u[0],
        )

    start = np.array([*np.divide(problem.start_position, length), *np.divide(problem.start_velocity, speed), 0.0])
    end = np.array([*np.divide(problem.end_position, length), *np.divide(problem.end_velocity, speed), np.nan])
    limits = np.array([problem.least / problem.most, -4.0 * math.pi]), np.array([1.0, 4.0 * math.pi])
    shooting = shoot(ShootingProblem(rate, start, end, *limits), _guess(problem, start, end, intervals))
    return float(shooting.states[-1, 4]), shooting.duration


def _guess(problem: PointMassProblem, start: np.ndarray, end: np.ndarray, intervals: int) -> Shooting:
    """Return a guess: straight lines over the natural time, with constant thrust along the velocity change or up."""
    duration = problem.natural_time
    fraction = np.linspace(0.0, 1.0, intervals + 1)[:, np.newaxis]
    spent = 1.0 - math.exp(-THROTTLE * problem.most * duration / problem.exhaust_speed)
    states = (1.0 - fraction) * start + fraction * np.where(np.isnan(end), spent, end)
    change = np.subtract(problem.end_velocity, problem.start_velocity)
    angle = math.atan2(change[1], change[0]) if np.any(change) else 0.5 * math.pi
    return Shooting(duration, states, np.tile([THROTTLE, angle], (intervals, 1)))
