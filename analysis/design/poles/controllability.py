"""Controllability of a pair (A, B): its matrix and indices, and placement by indices for any spectrum.

With Q = [b_1 .. A^(k_1 - 1) b_1, b_2 ..], t_i the row of Q^-1 at the end of block i, Gamma = [t_i A^(k_i - 1) B] and
phi_i the required polynomial of degree k_i, u = -K x with K = Gamma^-1 [t_i phi_i(A)]. Inputs with k_i = 0 get no gain.

Source: Kalman (1960); indices and canonical form: Luenberger, "Canonical forms for linear multivariable systems", IEEE
Transactions on Automatic Control 12 (1967); the gain was derived here: t_i (A - B K)^j = t_i A^j for j < k_i, and then
t_i phi_i(A - B K) = 0.
"""

from __future__ import annotations

import numpy as np

from .polynomial import make_polynomial
from .results import PlacementError, Reason, StateFeedback
from .spectrum import Spectrum

TOLERANCE = 1e-9  # relative; smaller directions and singular values count as 0


def controllability_matrix(a: np.ndarray, b: np.ndarray, blocks: int) -> np.ndarray:
    """Return U = [B AB .. A^(blocks - 1) B], (n, blocks m)."""
    columns = [b]
    for _ in range(blocks - 1):
        columns.append(a @ columns[-1])
    return np.hstack(columns)


def controllability_indices(a: np.ndarray, b: np.ndarray, tolerance: float = TOLERANCE) -> tuple[int, ...]:
    """Return the indices k_i (m,): numbers of b_i, A b_i, .. independent of their predecessors in b_1 .. b_m, A b_1 ..

    A column counts if its new component exceeds ``tolerance`` times |B|, or |A| for powers above 0. Each column is A
    times the last new direction of its chain, which preserves new components and does not grow with the power. Raises
    PlacementError.
    """
    states, inputs = b.shape
    basis = np.zeros((states, 0))
    indices = [0] * inputs
    left_out = 0.0
    chains = [(i, b[:, i], float(np.linalg.norm(b, 2))) for i in range(inputs)]
    step = float(np.linalg.norm(a, 2))
    while chains and basis.shape[1] < states:
        going = []
        for i, column, scale in chains:
            new = column - basis @ (basis.T @ column)
            new -= basis @ (basis.T @ new)  # twice is enough (Kahan and Parlett)
            size = float(np.linalg.norm(new))
            if size <= tolerance * scale or basis.shape[1] == states:
                left_out = max(left_out, size / scale if scale else 0.0)
                continue
            basis = np.column_stack([basis, new / size])
            indices[i] += 1
            going.append((i, a @ basis[:, -1], step))
        chains = going
    if basis.shape[1] < states:
        problem = (
            f"{states - basis.shape[1]} of {states} states are not controllable: "
            f"no further vector A^k b_i is independent of the others by more than {left_out:.2g} (tolerance "
            f"{tolerance:g})"
        )
        remedy = "remove these states, or add an input"
        raise PlacementError("controllability indices", Reason.NOT_CONTROLLABLE, problem, left_out, remedy)
    return tuple(indices)


def indices(a: np.ndarray, b: np.ndarray, spectrum: Spectrum, tolerance: float = TOLERANCE) -> StateFeedback:
    """Place the spectrum. Raises PlacementError for a pair that is not controllable."""
    lengths = controllability_indices(a, b, tolerance)
    used = [i for i, length in enumerate(lengths) if length]
    degrees = [lengths[i] for i in used]
    columns = [b[:, i] for i in used]
    chains = []
    for column, degree in zip(columns, degrees, strict=True):
        chain = [column]
        for _ in range(degree - 1):
            chain.append(a @ chain[-1])
        chains.append(np.column_stack(chain))
    q = np.hstack(chains)
    ends = np.cumsum(degrees) - 1
    powers = [np.linalg.solve(q.T, np.eye(len(a))[:, ends]).T]  # t_i A^l for l = 0, 1, ..
    for _ in range(max(degrees)):
        powers.append(powers[-1] @ a)
    gamma = np.array([powers[degree - 1][i] @ b[:, used] for i, degree in enumerate(degrees)])
    rows = np.array([powers[degree][i] for i, degree in enumerate(degrees)])
    for level, block in enumerate(make_polynomial(spectrum, degrees)):
        rows += block @ powers[level]
    gain = np.zeros(b.T.shape)
    gain[used] = np.linalg.solve(gamma, rows)
    return StateFeedback("indices", gain, spectrum.poles, a - b @ gain, float(np.linalg.cond(q)))
