"""Pareto order of several objectives, all to be minimised and of equal weight."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np


def dominators(objectives: np.ndarray, point: np.ndarray) -> int:
    """Count the rows of ``objectives`` (n, m) that dominate a point (m,): no worse in any, better in one or more."""
    no_worse = np.all(objectives <= point, axis=1)
    return int(np.count_nonzero(no_worse & np.any(objectives < point, axis=1)))


def is_dominated(objectives: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Return a mask (n,) of the rows of ``objectives`` (n, m) that a point (m,) dominates."""
    return np.all(objectives >= point, axis=1) & np.any(objectives > point, axis=1)


def ranks(objectives: np.ndarray) -> np.ndarray:
    """Return the number of rows that dominate each row of ``objectives`` (n, m); 0 in the Pareto set."""
    size = len(objectives)
    no_worse, better = np.ones((size, size), dtype=bool), np.zeros((size, size), dtype=bool)
    for values in objectives.T:
        no_worse &= values[:, None] <= values
        better |= values[:, None] < values
    return np.count_nonzero(no_worse & better, axis=0)


class Standing(NamedTuple):
    """Standing of a point in a set, smaller is better: compared by rank, then by distance from the ideal point."""

    rank: int
    distance: float


class ParetoOrder:
    """Order of points with respect to a set, ``objectives`` (n, m), which may be infinite.

    Points of equal rank are ordered by their distance from the ideal point, the least value of every objective in the
    set, in units of the extent of the set's Pareto front. Values below the ideal point count as equal to it, so that
    increasing any objective never improves a standing.
    """

    def __init__(self, objectives: np.ndarray) -> None:
        self.objectives = objectives
        self.ranks = ranks(objectives)
        front = objectives[self.ranks == 0]
        usable = np.where(np.isfinite(front), front, np.nan)
        known = ~np.all(np.isnan(usable), axis=0)  # an objective that is infinite for all points does not count
        self.ideal = np.zeros(objectives.shape[1])
        self.extent = np.ones(objectives.shape[1])
        self.ideal[known] = np.nanmin(usable[:, known], axis=0)
        spread = np.nanmax(usable[:, known], axis=0) - self.ideal[known]
        self.extent[known] = np.where(spread > 0.0, spread, 1.0)

    def distances(self, points: np.ndarray) -> np.ndarray:
        """Return the distances of points (..., m) from the ideal point, in units of the front's extent."""
        return np.sqrt(np.sum(np.square(np.maximum(points - self.ideal, 0.0) / self.extent), axis=-1))

    def standing(self, point: np.ndarray) -> Standing:
        return Standing(dominators(self.objectives, point), float(self.distances(point)))

    def order(self) -> np.ndarray:
        """Return the indices of the points from the best standing to the worst; equal standings keep their order."""
        return np.lexsort((self.distances(self.objectives), self.ranks))

    def worst(self) -> int:
        """Return the index of the point with the worst standing."""
        return int(self.order()[-1])
