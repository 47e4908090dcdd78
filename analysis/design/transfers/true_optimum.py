"""Optimal hover transfer with free throttle and angular acceleration within limits, not of the simplified form.

Direct multiple shooting, started from the simplified programme. The tangent law is a singular arc of second order in
the angular acceleration, which is therefore bang-bang at the ends of the arcs, in a way that depends on the grid.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..trajectories.multiple_shooting import Shooting, ShootingProblem, shoot
from ..trajectories.path import PlannedPath
from ..trajectories.solvers import Symbol, casadi
from .programme import Programme

RATE = 0.1  # rad/s, the scale of the pitch's rate; pitch itself is not scaled
SPENT = 0.05  # the scale of the propellant over the initial mass


@dataclass(frozen=True)
class OptimalPath(PlannedPath):
    """Optimum with the data that its adjoint system needs.

    ``attitude`` contains rows of pitch (rad) and its rate (rad/s) at the N + 1 times, ``acceleration`` the acceleration
    of pitch (rad/s2) over the N intervals. ``costates`` contains a row for each time but the first: derivatives of the
    final propellant fraction with respect to x, x', y, y', pitch, its rate and the propellant fraction at that time, in
    SI units.
    """

    attitude: np.ndarray
    acceleration: np.ndarray
    costates: np.ndarray


def find_true_optimum(programme: Programme, intervals: int, engine: float) -> OptimalPath:
    """Return the optimum for the programme's vehicle, on a number of equal intervals. Raises `PlanError`.

    ``engine`` is the thrust (N) at full throttle. Source of the problem: Huang 2017.
    """
    vehicle, transfer, ca = programme.vehicle, programme.transfer, casadi()
    length = max(transfer.distance, transfer.descent) / 2.0
    speed = 0.4 * math.sqrt(2.0 * vehicle.full * length)
    scale = np.array([length, speed, length, speed, 1.0, RATE, SPENT])  # x, x', y, y', pitch, its rate, propellant

    def rate(x: Symbol, u: Symbol) -> Symbol:
        push = vehicle.full * u[0] / (1.0 - SPENT * x[6])
        return ca.vertcat(
            speed / length * x[1],
            push * ca.cos(x[4]) / speed,
            speed / length * x[3],
            (push * ca.sin(x[4]) - transfer.gravity) / speed,
            RATE * x[5],
            vehicle.angular_acceleration / RATE * u[1],
            vehicle.full / vehicle.exhaust_speed / SPENT * u[0],
        )

    upright = 0.5 * math.pi
    problem = ShootingProblem(
        rate,
        start=np.array([0.0, 0.0, 0.0, 0.0, upright, 0.0, 0.0]) / scale,
        end=np.array([transfer.distance, 0.0, -transfer.descent, 0.0, upright, 0.0, np.nan]) / scale,
        low=np.array([vehicle.least / vehicle.full, -1.0]),
        high=np.array([1.0, 1.0]),
    )
    shooting = shoot(problem, _guess(programme, intervals, scale))
    states = shooting.states * scale
    assert shooting.costates is not None
    return OptimalPath(
        time=np.linspace(0.0, shooting.duration, intervals + 1),
        position=states[:, [0, 2]],
        velocity=states[:, [1, 3]],
        propellant=states[:, 6],
        throttle=shooting.controls[:, 0] * vehicle.maximum_thrust / engine,
        pitch=(states[1:, 4] + states[:-1, 4]) / 2.0,
        attitude=states[:, 4:6],
        acceleration=shooting.controls[:, 1] * vehicle.angular_acceleration,
        costates=shooting.costates * SPENT / scale,
    )


def _guess(programme: Programme, intervals: int, scale: np.ndarray) -> Shooting:
    """Return the simplified programme at equally spaced times, as a guess."""
    time = np.linspace(0.0, programme.duration, intervals + 1)
    motion, remainder = programme.states(time)
    throttle = programme.thrust((time[1:] + time[:-1]) / 2.0) / programme.vehicle.maximum_thrust
    turn = np.diff(remainder[:, 1]) / np.diff(time) / programme.vehicle.angular_acceleration
    controls = np.stack([throttle, np.clip(turn, -1.0, 1.0)], axis=1)
    return Shooting(programme.duration, np.concatenate([motion, remainder], axis=1) / scale, controls)
