"""One output feedback for several plants: regulators free of a plant's parameters.

Plants A(q_k), k = 1 .. s, with one B and C. Elements of the N_i that are prescribed have one value for all plants, the
others are unknown for each; F (m, p) is common. For all k

    T_k A_k^p + sum_i N_i,k T_k A_k^i = -F C

is linear in the unknowns, each row by itself, and solved by least squares. When it holds the regulator does not
contain q, and the prescribed part of the closed loop does not either. Ours; Lapin's thesis (2.3.2) has the aim.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import block_diag

from ...common.errors import InputError
from .ackermann import row_stack, split
from .plant import input_matrix, output_matrix, state_matrix
from .polynomial import block_companion
from .refusal import PlacementError, Reason
from .results import OutputFeedback

_RESIDUAL = 1e-10  # of the right side


@dataclass(frozen=True)
class CommonFeedback:
    """u = F y with F = ``gain`` (m, p) for all plants.

    ``coefficients`` are the N (plants, p, m, m) of each closed loop, ``residual`` what the equations leave of their
    right side, ``loops`` the feedback on each plant with its poles, kappa and so on.
    """

    gain: np.ndarray
    coefficients: np.ndarray
    residual: float
    loops: Sequence[OutputFeedback]


def common_feedback(
    plants: Sequence[ArrayLike], b: ArrayLike, c: ArrayLike, wanted: Sequence[ArrayLike] | np.ndarray
) -> CommonFeedback:
    """The F of u = F y that gives every plant the prescribed coefficients.

    ``plants`` are A (n, n), ``b`` is B (n, m), ``c`` C (p, n), n = p_u m. ``wanted`` (p_u, m, m), N_0 first, holds the
    prescribed elements of the N_i, and nan where an element is free for each plant. Raises InputError, and
    PlacementError where no F does it, with the residual.
    """
    if not len(plants):
        raise InputError("modal", "plants", "there are none", "give a list of matrices A")
    states = [state_matrix(plant) for plant in plants]
    inputs, outputs = input_matrix(b, len(states[0])), output_matrix(c, len(states[0]))
    size, order = inputs.shape[1], len(states[0])
    try:
        prescribed = np.array(wanted, dtype=float)
    except (TypeError, ValueError):
        raise InputError("modal", "wanted", "it is no array of numbers", "give p matrices, nan for free") from None
    if any(len(state) != order for state in states) or order % size:
        raise InputError("modal", "plants", f"their sizes do not fit {size} inputs", "give n by n matrices, n = p m")
    if prescribed.shape != (order // size, size, size):
        raise InputError("modal", "wanted", f"it is {prescribed.shape}", f"give {(order // size, size, size)}")
    side_by_side = np.hstack(list(prescribed))
    free = np.isnan(side_by_side)
    stacks, powers, conditions = zip(*(row_stack(state, inputs) for state in states), strict=True)
    gain, closed_poles = np.zeros((size, len(outputs))), np.zeros((len(states), size, order))
    left_over, sides = 0.0, 0.0
    for i in range(size):
        fixed = np.where(free[i], 0.0, side_by_side[i])
        right = np.concatenate([-power[i] - fixed @ stack for stack, power in zip(stacks, powers, strict=True)])
        unknown = block_diag(*(stack[free[i]].T for stack in stacks)) if np.any(free[i]) else np.zeros((len(right), 0))
        matrix = np.hstack([np.tile(outputs.T, (len(states), 1)), unknown])
        solution = np.linalg.lstsq(matrix, right)[0]
        left_over += float(np.sum((matrix @ solution - right) ** 2))
        sides += float(np.sum(right**2))
        gain[i] = solution[: len(outputs)]
        closed_poles[:, i] = fixed
        closed_poles[:, i, free[i]] = solution[len(outputs) :].reshape(len(states), -1)
    residual = float(np.sqrt(left_over / sides)) if sides else 0.0
    if residual > _RESIDUAL:
        raise PlacementError(
            "common output feedback",
            Reason.RESIDUAL,
            f"no F gives all {len(states)} plants what is prescribed: {residual:.2g} of the right side is left",
            residual,
            "prescribe less, or measure more",
        )
    coefficients = np.array([split(row, size) for row in closed_poles])
    loops = [
        OutputFeedback(
            "common",
            gain,
            np.linalg.eigvals(block_companion(blocks)),
            state + inputs @ gain @ outputs,
            condition,
        )
        for state, blocks, condition in zip(states, coefficients, conditions, strict=True)
    ]
    return CommonFeedback(gain, coefficients, residual, loops)
