"""Controllability of a pair (A, B): the matrix U, and the indices.

Source: Kalman (1960); indices: Luenberger, "Canonical forms for linear multivariable systems", IEEE Transactions on
Automatic Control 12 (1967).
"""

from __future__ import annotations

import numpy as np

from .refusal import PlacementError, Reason

TOLERANCE = 1e-9  # relative, below which a direction or a singular value counts as none


def controllability_matrix(a: np.ndarray, b: np.ndarray, blocks: int) -> np.ndarray:
    """U = [B AB .. A^(blocks - 1) B], (n, blocks m)."""
    columns = [b]
    for _ in range(blocks - 1):
        columns.append(a @ columns[-1])
    return np.hstack(columns)


def controllability_indices(a: np.ndarray, b: np.ndarray, tolerance: float = TOLERANCE) -> tuple[int, ...]:
    """k_i (m): how many of b_i, A b_i, .. are independent of those before in the order b_1 .. b_m, A b_1 ..

    A column counts when more than ``tolerance`` of |B|, or of |A|, is new in it. Each is A times the last new direction
    of its chain, which leaves what is new and does not grow with the power. Raises PlacementError.
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
        raise PlacementError(
            "controllability indices",
            Reason.NOT_CONTROLLABLE,
            f"{states - basis.shape[1]} of {states} states are not reached: of what was left out at most {left_out:.2g}"
            f" was new, less than {tolerance:g}",
            left_out,
            "leave these states out, or add an input",
        )
    return tuple(indices)
