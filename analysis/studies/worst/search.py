"""Maximum of a function over the unit cube, within a number of evaluations.

Differential evolution (Storn and Price 1997; scipy's, a generation at a time) finds the region of the maximum from
known points, from corners, where many smooth functions have their maximum, and from random points. In this region each
coordinate is tried at its ends, COBYQA (Ragonneau and Zhang 2023) climbs smooth functions, and Nelder and Mead's
simplex (1965, as adapted by Gao and Han 2012) climbs stepped ones.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.optimize import differential_evolution, minimize
from scipy.stats import qmc

Function = Callable[[np.ndarray], np.ndarray]
GLOBAL = 0.75  # share of the evaluations for the evolution
PER_DIMENSION, FEWEST = 5, 20  # members of a generation
RADII = (0.1, 1e-4)  # radii of COBYQA's trust region, in edges of the cube
LEAST = 100  # least number of evaluations


class SearchPhase(NamedTuple):
    """Phase of a search: its method, and the number of its evaluations."""

    name: str
    evaluations: int


class Maximum(NamedTuple):
    """Best ``point`` (dimensions,) of a search with its ``value``, and the ``phases`` in order."""

    point: np.ndarray
    value: float
    phases: tuple[SearchPhase, ...]


class _EndError(Exception):
    """Signal for the end of a search: the evaluations are used up, or a value is infinite and cannot be exceeded."""


class _Counted:
    """Function that records its best point; an infinite value, or a number of evaluations, ends the search."""

    def __init__(self, function: Function, points: np.ndarray, values: np.ndarray, evaluations: int) -> None:
        self._function = function
        self.left = evaluations
        self._begun: list[tuple[str, int]] = []
        best = int(np.argmax(values))
        self.point, self.value = points[best], float(values[best])

    def begin(self, phase: str) -> None:
        if not self._begun or self._begun[-1][0] != phase:
            self._begun.append((phase, self.left))

    def phases(self) -> tuple[SearchPhase, ...]:
        ends = [left for _, left in self._begun[1:]] + [self.left]
        used = [SearchPhase(name, left - end) for (name, left), end in zip(self._begun, ends, strict=True)]
        return tuple(phase for phase in used if phase.evaluations)

    def __call__(self, points: np.ndarray) -> np.ndarray:
        if self.left <= 0 or self.value == np.inf:
            raise _EndError
        points = np.clip(points, 0.0, 1.0)[: self.left]
        values = self._function(points)
        self.left -= len(points)
        best = int(np.argmax(values))
        if values[best] > self.value:
            self.point, self.value = points[best], float(values[best])
        return values


def largest(
    function: Function, points: np.ndarray, values: np.ndarray, evaluations: int, random: np.random.Generator
) -> Maximum:
    """Return the point (dimensions,) of the unit cube with the largest value found, that value, and the phases.

    ``function`` maps points (points, dimensions) to values (points,) that are never nan; inf ends the search.
    ``points`` and ``values`` are one or more known points and values to start from; ``evaluations`` is the number of
    further evaluations.
    """
    counted = _Counted(function, points, values, evaluations)
    try:
        _evolve(counted, points, values, random)
        _climb(counted)
    except _EndError:
        pass
    return Maximum(counted.point, counted.value, counted.phases())


def _evolve(counted: _Counted, points: np.ndarray, values: np.ndarray, random: np.random.Generator) -> None:
    dimensions = points.shape[1]
    members = max(PER_DIMENSION * dimensions, FEWEST)
    generations = int(GLOBAL * counted.left / members)
    if generations < 2:
        return
    known = points[np.argsort(-values, kind="stable")[: members // 2]]
    corners = _corners(points, values, members - len(known), random)
    spread = qmc.LatinHypercube(dimensions, rng=random).random(members - len(known) - len(corners))

    def badly(columns: np.ndarray) -> np.ndarray:
        objectives = counted(columns.T)
        if objectives.size < columns.shape[1]:
            raise _EndError
        return -objectives

    counted.begin("differential evolution")
    differential_evolution(
        badly,
        [(0.0, 1.0)] * dimensions,
        init=np.concatenate([known, corners, spread]),
        maxiter=generations - 1,
        tol=0.0,
        polish=False,
        vectorized=True,
        updating="deferred",
        rng=random,
    )


def _corners(points: np.ndarray, values: np.ndarray, most: int, random: np.random.Generator) -> np.ndarray:
    """Return all corners (corners, dimensions) of the cube, or half of ``most`` if there are more than ``most``.

    They include the corner to which a plane through the known values rises; the others are random.
    """
    dimensions = points.shape[1]
    if 2**dimensions <= most:
        return np.array(list(itertools.product((0.0, 1.0), repeat=dimensions)))
    plane = np.column_stack([np.ones(len(points)), points])
    slope = np.linalg.lstsq(plane, values, rcond=None)[0][1:]
    others = random.integers(0, 2, (most // 2 - 1, dimensions))
    return np.vstack([slope > 0.0, others]).astype(float)


def _move_to_edges(counted: _Counted) -> None:
    """Move one coordinate of the best point at a time to an end of its edge, as long as the value increases."""
    dimensions = counted.point.size
    before = -np.inf
    while counted.value > before:
        before = counted.value
        places = np.tile(counted.point, (2 * dimensions, 1))
        places[range(2 * dimensions), np.tile(range(dimensions), 2)] = np.repeat((0.0, 1.0), dimensions)
        counted(places)


def _climb(counted: _Counted) -> None:
    """Climb from the best point with the remaining evaluations."""

    def badly(point: np.ndarray) -> float:
        return -float(counted(point[np.newaxis])[0])

    counted.begin("ends of each parameter")
    _move_to_edges(counted)
    bounds = [(0.0, 1.0)] * counted.point.size
    smooth = {"maxfev": counted.left // 2, "initial_tr_radius": RADII[0], "final_tr_radius": RADII[1]}
    if smooth["maxfev"] > 2 * counted.point.size + 1:  # evaluations of its first model
        counted.begin("COBYQA")
        minimize(badly, counted.point, method="COBYQA", bounds=bounds, options=smooth)
    while counted.left > 0:
        before = counted.value
        counted.begin("Nelder and Mead")
        minimize(badly, counted.point, method="Nelder-Mead", bounds=bounds, options={"adaptive": True, "fatol": 0.0})
        if counted.value == before:
            return
