"""The point-mass problem by a direct method: nothing convex in it, from a crude guess: a check of the other."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .multiple_shooting import Shooting, ShootingProblem, shoot
from .point_mass import PointMassProblem
from .solvers import casadi

THROTTLE = 0.7  # of the guess


def direct_propellant(problem: PointMassProblem, intervals: int) -> tuple[float, float]:
    """Propellant fraction and duration (s) by multiple shooting in throttle and direction, on so many intervals.

    States: place, velocity, propellant over the initial mass; raises `PlanError`.
    """
    length, speed = problem.length, problem.speed
    ca = casadi()

    def rate(x: Any, u: Any) -> Any:
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
    """Straight lines at the natural time; thrust against the change of velocity, upwards from rest to rest."""
    duration = problem.natural_time
    fraction = np.linspace(0.0, 1.0, intervals + 1)[:, np.newaxis]
    spent = 1.0 - math.exp(-THROTTLE * problem.most * duration / problem.exhaust_speed)
    states = (1.0 - fraction) * start + fraction * np.where(np.isnan(end), spent, end)
    change = np.subtract(problem.end_velocity, problem.start_velocity)
    angle = math.atan2(change[1], change[0]) if np.any(change) else 0.5 * math.pi
    return Shooting(duration, states, np.tile([THROTTLE, angle], (intervals, 1)))
