"""Multipliers of a whole system, closed-loop modes of a loop's linear model, and their controllability at a cut.

Cells that affect each other form a block. In topological order the blocks are on the diagonal of a triangular matrix:
the multipliers of the whole system are the multipliers of its blocks. Cells that do not affect themselves have the
multiplier 0, and a cell that only accumulates others has the multiplier 1.

Source: Tarjan 1972, Depth-first search and linear graph algorithms (strongly connected components).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from scipy.sparse.csgraph import connected_components

from ..results.responses import Mode, Structure
from .lifted import LiftedModel, SampledChannel

APART = 1e-4  # fraction of the largest: a mode with a smaller response is outside the loop, or rounding
KINDS = {(True, True): "loop", (False, True): "not controllable", (True, False): "not observable"}
RANK = 1e-9  # fraction of the largest singular value
ADDS_UP = 1e-6  # distance from 1: a cell with such a multiplier only accumulates or holds, for any parameters


def modes(model: LiftedModel, port: SampledChannel) -> tuple[Mode, ...]:
    """Return all modes of a reduced model, except modes at 0, largest multiplier first."""
    lasting = model.lasting
    if not lasting.a.size:
        return ()
    values, left, right = scipy.linalg.eig(lasting.a, left=True, right=True)
    into = np.linalg.norm(left.conj().T @ lasting.b[:, port.rows], axis=1)
    out = np.linalg.norm(lasting.cu[port.rows] @ right, axis=0)
    overlap = abs(np.sum(left.conj() * right, axis=0))
    residue = into * out / np.maximum(overlap, np.finfo(float).tiny)
    residue = residue / (np.max(residue) or 1.0)
    into, out = into / (np.max(into) or 1.0), out / (np.max(out) or 1.0)
    classified = []
    for place in np.argsort(-abs(values), kind="stable"):
        z = complex(values[place])
        is_excited, is_observed = into[place] > APART, out[place] > APART
        if residue[place] <= APART:  # the smaller of the two is the missing one
            is_excited, is_observed = is_excited and into[place] >= out[place], is_observed and out[place] > into[place]
        kind = KINDS.get((bool(is_excited), bool(is_observed)), "neither")
        classified.append(_mode(z, model.period, kind, float(into[place]), float(out[place])))
    return tuple(classified)


def make_outside_mode(z: complex, period: float, moved: bool, moves: bool) -> Mode:
    """Return a mode of memory outside the loop, which its cut affects or which affects it, but not both."""
    kind = "neither" if moved == moves else KINDS[moved, moves]
    return _mode(z, period, kind, float(moved), float(moves))


def _mode(z: complex, period: float, kind: str, controllability: float, observability: float) -> Mode:
    s = complex(np.log(z)) / period
    damping = -s.real / abs(s) if abs(s) > 0.0 else 1.0
    return Mode(z, s, damping, abs(s), kind, controllability, observability)


def structure(model: LiftedModel, port: SampledChannel, states: int) -> Structure:
    """Return the ranks of [b, ab, a2b, ...] and of its dual over as many periods as there are states."""
    lasting = model.lasting
    controllable = _rank(lasting.a, lasting.b[:, port.rows])
    observable = _rank(lasting.a.T, lasting.cu[port.rows].T)
    return Structure(states, lasting.a.shape[0], controllable[0], observable[0], controllable[1], observable[1])


def _rank(a: np.ndarray, b: np.ndarray) -> tuple[int, float]:
    """Return the rank, and the smallest retained singular value relative to the largest."""
    blocks = [b]
    for _ in range(max(1, a.shape[0]) - 1):
        blocks.append(a @ blocks[-1])
    sizes = np.linalg.svd(np.hstack(blocks), compute_uv=False)
    if not sizes.size or sizes[0] == 0.0:
        return 0, 0.0
    retained = sizes[sizes > RANK * sizes[0]]
    return retained.size, float(retained[-1] / sizes[0])


@dataclass(frozen=True)
class CoupledMemory:
    """Memory cells that all affect each other, directly or not.

    ``multipliers`` are in descending order, and ``change`` is the change of the largest with the next smaller steps of
    the differences. For every port, ``moved`` is True if its cut affects the cells, and ``moves`` is True if the cells
    affect its return signal.
    """

    names: tuple[str, ...]
    multipliers: np.ndarray
    change: float
    moved: tuple[bool, ...]
    moves: tuple[bool, ...]


def find_coupled_cells(matrix: np.ndarray) -> list[np.ndarray]:
    """Return the cells of each block of a matrix [to, from] whose multipliers may be other than 0 or 1."""
    _, labels = connected_components(matrix != 0.0, directed=True, connection="strong")
    own = np.diagonal(matrix)
    grows = (own != 0.0) & (abs(own - 1.0) > ADDS_UP)
    blocks = [np.flatnonzero(labels == label) for label in np.unique(labels)]
    return [cells for cells in blocks if cells.size > 1 or grows[cells[0]]]


def multipliers(matrix: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Return the eigenvalues of a block, largest first."""
    values = np.linalg.eigvals(matrix[np.ix_(cells, cells)])
    return values[np.argsort(-abs(values), kind="stable")]
