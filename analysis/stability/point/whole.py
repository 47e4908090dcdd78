"""Multipliers of a whole system: of all that it remembers, whether a loop's cut moves and sees it or not.

What reaches itself through others is a block, and ordered by what reaches what the blocks stand on the diagonal of a
triangular matrix: the multipliers of all are those of the blocks. What lies on no circle is forgotten, and a number
that only adds up what others bring has the multiplier 1.
Source: Tarjan 1972, Depth-first search and linear graph algorithms (strongly connected components).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse.csgraph import connected_components

ADDS_UP = 1e-6  # from 1: a cell that depends on itself so nearly only adds up, or holds, whatever parameters say


@dataclass(frozen=True)
class Block:
    """Memory that reaches itself through all of itself.

    ``multipliers`` are the largest first, and ``change`` is how much the largest changes with the next smaller steps of
    the differences. ``moved`` and ``moves`` say of every port whether its cut moves it, and whether it moves the cut.
    """

    names: tuple[str, ...]
    multipliers: np.ndarray
    change: float
    moved: tuple[bool, ...]
    moves: tuple[bool, ...]


def circles(matrix: np.ndarray) -> list[np.ndarray]:
    """The cells of each block of a matrix [to, from] whose multipliers need not be 0 or 1."""
    _, labels = connected_components(matrix != 0.0, directed=True, connection="strong")
    own = np.diagonal(matrix)
    grows = (own != 0.0) & (abs(own - 1.0) > ADDS_UP)
    blocks = [np.flatnonzero(labels == label) for label in np.unique(labels)]
    return [cells for cells in blocks if cells.size > 1 or grows[cells[0]]]


def multipliers(matrix: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Eigenvalues of a block, largest first."""
    values = np.linalg.eigvals(matrix[np.ix_(cells, cells)])
    return values[np.argsort(-abs(values), kind="stable")]
