"""Point-mass problem with fixed time as a sequence of convex problems.

The problems are second-order cone programmes, solved by Clarabel. The constraint s >= |u| on the magnitude of the
thrust acceleration replaces s = |u|, and the logarithm z of the mass ratio replaces the mass (Acikmese and Ploen 2007,
"Convex programming approach to powered descent guidance for Mars landing"); thrust limits and gravity are linearised
about the last solution until the solution no longer changes. Limits on tilt and glide slope are cones (Acikmese, Carson
and Blackmore 2013, "Lossless convexification of nonconvex control bound and pointing constraints of the soft landing
optimal control problem").
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from .path import OFF, PlannedPath
from .point_mass import PointMassProblem
from .solvers import clarabel

SOLVES = 12  # usually three to six
CHANGE = 1e-7  # change of the propellant fraction between two solutions
TOLERANCE = 1e-10


@dataclass(frozen=True)
class PointMassPath:
    """Solution at N + 1 points of ``time`` (s): rows of ``position`` (m) and ``velocity`` (m/s), and ``log_mass``.

    ``log_mass`` is the logarithm of the mass over the initial mass. ``thrust_acceleration`` (m/s2) is constant over
    each of the N intervals, and ``size`` (m/s2) is the upper bound s of its magnitude in the convex form.
    """

    time: np.ndarray
    position: np.ndarray
    velocity: np.ndarray
    log_mass: np.ndarray
    thrust_acceleration: np.ndarray
    size: np.ndarray

    @property
    def propellant_fraction(self) -> float:
        return -math.expm1(self.log_mass[-1])

    @property
    def slack(self) -> float:
        """Largest s - |u| (m/s2); if it is near 0, the convex form solves the original problem."""
        return float(np.max(self.size - np.linalg.norm(self.thrust_acceleration, axis=1)))

    def make_path(self, problem: PointMassProblem) -> PlannedPath:
        """Return the solution of a planar ``problem`` as the path of a plan."""
        force = self.thrust_acceleration
        throttle = self.size / problem.most * np.exp((self.log_mass[1:] + self.log_mass[:-1]) / 2.0)
        pitch = np.where(throttle > OFF, np.arctan2(force[:, 1], force[:, 0]), np.nan)
        return PlannedPath(self.time, self.position, self.velocity, -np.expm1(self.log_mass), throttle, pitch)


def solve_fixed_time(
    problem: PointMassProblem, duration: float, intervals: int, near: PointMassPath | None = None
) -> PointMassPath | None:
    """Minimise the propellant in ``duration`` (s) with ``intervals`` intervals; return None if it is infeasible.

    The first reference is ``near``, a solution for another duration with as many intervals, or by default straight
    lines.
    """
    if near is None:
        fraction = np.linspace(0.0, 1.0, intervals + 1)[:, np.newaxis]
        ends = np.array([problem.start_position, problem.end_position])
        position = (1.0 - fraction) * ends[0] + fraction * ends[1]
        log_mass = -fraction[:, 0] * problem.most * duration / (2.0 * problem.exhaust_speed)
    else:
        position, log_mass = near.position, near.log_mass
    last = math.inf
    for _ in range(SOLVES):
        path = _solve(problem, duration, position, log_mass)
        if path is None or abs(path.propellant_fraction - last) <= CHANGE:
            return path
        last, position, log_mass = path.propellant_fraction, path.position, path.log_mass
    return None


class _Layout:
    """Layout of the scaled unknowns: r and v (N + 1 rows each), z (N + 1), u (N rows), s (N)."""

    def __init__(self, intervals: int, axes: int) -> None:
        points = intervals + 1
        sizes = {"r": points * axes, "v": points * axes, "z": points, "u": intervals * axes, "s": intervals}
        self.total = sum(sizes.values())
        self.blocks: dict[str, sparse.csr_array] = {}
        identity = sparse.eye_array(self.total, format="csr")
        start = 0
        for name, size in sizes.items():
            self.blocks[name] = identity[start : start + size]
            start += size


def _solve(
    problem: PointMassProblem, duration: float, about: np.ndarray, log_about: np.ndarray
) -> PointMassPath | None:
    """Solve one convex problem, linearised about a path and scaled by length, speed and units derived from them."""
    intervals, axes = about.shape[0] - 1, about.shape[1]
    unit = problem.speed**2 / problem.length
    h = duration / intervals * problem.speed / problem.length
    exhaust = problem.exhaust_speed / problem.speed
    layout = _Layout(intervals, axes)
    r, v, z, u, s = (layout.blocks[name] for name in "rvzus")
    here = sparse.eye_array(intervals, intervals + 1, format="csr")
    there = sparse.eye_array(intervals, intervals + 1, k=1, format="csr")
    before, after = (sparse.kron(matrix, sparse.eye_array(axes), format="csr") for matrix in (here, there))

    gradient = problem.gravity.gradient(about) * (problem.length / unit)
    field = sparse.block_diag(list(gradient), format="csr")
    pull = np.stack(problem.gravity.at(*about.T), axis=1)
    constant = pull.ravel() / unit - field @ (about.ravel() / problem.length)
    mean = sparse.csr_array(before / 3.0 + after / 6.0)
    half = sparse.csr_array((before + after) / 2.0)
    equal: list[tuple[sparse.csr_array, np.ndarray]] = [
        ((after - before) @ r - h * before @ v - h**2 / 2.0 * u - h**2 * mean @ field @ r, h**2 * mean @ constant),
        ((after - before) @ v - h * u - h * half @ field @ r, h * half @ constant),
        ((there - here) @ z + (h / exhaust) * s, np.zeros(intervals)),
        (z[:1], np.zeros(1)),
        (r[:axes], np.array(problem.start_position) / problem.length),
        (r[-axes:], np.array(problem.end_position) / problem.length),
        (v[:axes], np.array(problem.start_velocity) / problem.speed),
        (v[-axes:], np.array(problem.end_velocity) / problem.speed),
    ]

    middle = (here + there) @ log_about / 2.0
    ratio = np.exp(-middle)  # ratio of the initial mass to that in the middle of an interval
    away = sparse.csr_array((here + there) / 2.0) @ z  # y = away z - middle
    maximum = problem.most / unit * ratio
    below = [(s + sparse.diags_array(maximum) @ away, maximum * (1.0 + middle))]
    if problem.largest_tilt is not None:
        below.append((math.cos(problem.largest_tilt) * s - u[axes - 1 :: axes], np.zeros(intervals)))
    thrust = _interleave([s, *(u[axis::axes] for axis in range(axes))])
    cones = [(thrust, np.zeros(thrust.shape[0]))]
    kinds = [clarabel().SecondOrderConeT(1 + axes)] * intervals
    if problem.least > 0.0:
        # q = s/(a1 e) - 1 + y >= y^2/2, as the cone |(y, q - 1/2)| <= q + 1/2
        q = sparse.diags_array(unit / (problem.least * ratio)) @ s + away
        offset = 1.0 + middle
        cones.append((_interleave([q, q, away]), -np.stack([offset - 0.5, offset + 0.5, middle], axis=1).ravel()))
        kinds += [clarabel().SecondOrderConeT(3)] * intervals
    if problem.glide_slope is not None:
        inner = slice(axes, -axes)  # the ends are fixed
        slope = math.tan(problem.glide_slope)
        level = [slope * r[inner][axis::axes] for axis in range(axes - 1)]
        apex = np.array(problem.end_position) - np.eye(axes)[-1] * problem.glide_offset
        offset = np.array([apex[-1], *(slope * apex[:-1])]) / problem.length
        cones.append((_interleave([r[inner][axes - 1 :: axes], *level]), -np.tile(offset, intervals - 1)))
        kinds += [clarabel().SecondOrderConeT(axes)] * (intervals - 1)

    rows = [matrix for matrix, _ in equal + below] + [-matrix for matrix, _ in cones]
    right = [value for _, value in equal + below + cones]
    equalities, inequalities = (sum(matrix.shape[0] for matrix, _ in part) for part in (equal, below))
    cost = np.asarray((h / exhaust) * s.sum(axis=0)).ravel()
    solution = _clarabel(
        cost, rows, right, [clarabel().ZeroConeT(equalities), clarabel().NonnegativeConeT(inequalities), *kinds]
    )
    if solution is None:
        return None
    return PointMassPath(
        np.linspace(0.0, duration, intervals + 1),
        (r @ solution).reshape(-1, axes) * problem.length,
        (v @ solution).reshape(-1, axes) * problem.speed,
        z @ solution,
        (u @ solution).reshape(-1, axes) * unit,
        (s @ solution) * unit,
    )


def _interleave(parts: list[sparse.csr_array]) -> sparse.csr_array:
    """Interleave the rows of the blocks: the first row of each, then the second, so that each group is one cone."""
    count = parts[0].shape[0]
    order = np.arange(count * len(parts)).reshape(len(parts), count).T.ravel()
    return sparse.csr_array(sparse.vstack(parts, format="csr")[order])


def _clarabel(
    cost: np.ndarray, rows: list[sparse.csr_array], right: list[np.ndarray], cones: list[object]
) -> np.ndarray | None:
    """Return the x that minimises cost . x with right - rows x in the cones, None if there is none."""
    settings = clarabel().DefaultSettings()
    settings.verbose = False
    settings.tol_feas = settings.tol_gap_abs = settings.tol_gap_rel = TOLERANCE
    matrix = sparse.csc_matrix(sparse.vstack(rows, format="csc"))
    nothing = sparse.csc_matrix((cost.size, cost.size))
    solver = clarabel().DefaultSolver(nothing, cost, matrix, np.concatenate(right), cones, settings)
    solution = solver.solve()
    status = str(solution.status)
    if status not in ("Solved", "AlmostSolved"):
        return None
    return np.array(solution.x)
