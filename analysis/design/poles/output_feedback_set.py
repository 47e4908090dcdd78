"""Set of all output feedbacks of a plant, and common feedback of several plants, by the generalised Ackermann formula.

A state feedback K(N) is an output feedback, K = -F C, if K(N) C^perp = 0. This condition is linear in the N_i and
leaves m p numbers z free: N = N* + sum z_j N^j. The poles are the eigenvalues of the block companion of N.

Plants A(q_k), k = 1 .. s, with the same B and C can have a common F (m, p): a regulator independent of a plant's
parameters. Prescribed elements of the N_i have one value for all plants, the others are unknown for each plant. For all
k

    T_k A_k^p + sum_i N_i,k T_k A_k^i = -F C

is linear in the unknowns, each row separately, and solved by least squares. If it has a solution the regulator does not
depend on q, and neither do the prescribed coefficients of the closed loop. Lapin's thesis (2.3.2) states the aim; the
equations are ours.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import block_diag, null_space

from ....common.errors import InputError
from .ackermann import row_stack, split
from .plant import input_matrix, output_matrix, real_matrix, state_matrix
from .polynomial import block_companion
from .results import OutputFeedback, PlacementError, Reason

_RESIDUAL = 1e-10  # relative to the right side


@dataclass(frozen=True)
class OutputFeedbackSet:
    """Set of coefficients N = ``particular`` + sum z_j ``directions``[j], arrays (p, m, m) as in `place_polynomial`."""

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    particular: np.ndarray
    directions: np.ndarray  # (free, p, m, m)
    condition_u: float

    @property
    def free(self) -> int:
        """Number of elements of z."""
        return len(self.directions)

    def coefficients(self, z: ArrayLike) -> np.ndarray:
        """Return N (p, m, m) at z (free,). Raises InputError."""
        return self.particular + np.tensordot(real_matrix("z", z, (self.free,)), self.directions, axes=1)

    def at(self, z: ArrayLike) -> OutputFeedback:
        """Return the feedback u = F y at z (free,), with the poles of N(z). Raises InputError."""
        coefficients = self.coefficients(z)
        stack, power, _ = row_stack(self.a, self.b)
        gain = -(power + np.hstack(list(coefficients)) @ stack) @ np.linalg.pinv(self.c)
        return OutputFeedback(
            "parametric",
            gain,
            np.linalg.eigvals(block_companion(coefficients)),
            self.a + self.b @ gain @ self.c,
            self.condition_u,
        )

    def parameters_of(self, gain: ArrayLike) -> np.ndarray:
        """Return the z (free,) of any F (m, p). Raises InputError."""
        matrix = real_matrix("F", gain, (self.b.shape[1], len(self.c)))
        stack, power, _ = row_stack(self.a, self.b)
        apart = split(np.linalg.solve(stack.T, (-matrix @ self.c - power).T).T, self.b.shape[1]) - self.particular
        # the directions are orthonormal
        return self.directions.reshape(self.free, -1) @ apart.ravel()


def output_feedback_set(a: ArrayLike, b: ArrayLike, c: ArrayLike) -> OutputFeedbackSet:
    """Return all output feedbacks u = F y of x' = A x + B u, y = C x.

    ``a`` is A (n, n), ``b`` B (n, m), ``c`` C (p, n), with n = p_u m states, U = [B AB ..] nonsingular and C of full
    row rank. Raises InputError and PlacementError.
    """
    state = state_matrix(a)
    inputs, outputs = input_matrix(b, len(state)), output_matrix(c, len(state))
    size = inputs.shape[1]
    stack, power, condition = row_stack(state, inputs)
    hidden = null_space(outputs)
    if hidden.shape[1] != len(state) - len(outputs):
        rank = len(state) - hidden.shape[1]
        problem = f"C has {len(outputs)} rows, but rank {rank}"
        remedy = "remove outputs that depend linearly on others"
        raise PlacementError("set of output feedbacks", Reason.RANK, problem, rank, remedy)
    # [N] V C^perp = -T A^p C^perp, each row of [N] separately
    reduced = stack @ hidden
    row = -power @ hidden @ np.linalg.pinv(reduced)
    retained = null_space(reduced.T).T
    directions = np.zeros((size, len(retained), size, len(state)))
    for i in range(size):
        directions[i, :, i] = retained
    blocks = [split(side_by_side, size) for side_by_side in directions.reshape(-1, size, len(state))]
    return OutputFeedbackSet(state, inputs, outputs, split(row, size), np.array(blocks), condition)


@dataclass(frozen=True)
class CommonFeedback:
    """Feedback u = F y with F = ``gain`` (m, p) for all plants.

    ``coefficients`` are the N (plants, p, m, m) of the closed loops. ``residual`` is the residual of the equations
    relative to their right side. ``loops`` contains the feedback on each plant, with its poles and kappa.
    """

    gain: np.ndarray
    coefficients: np.ndarray
    residual: float
    loops: Sequence[OutputFeedback]


def common_feedback(
    plants: Sequence[ArrayLike], b: ArrayLike, c: ArrayLike, wanted: Sequence[ArrayLike] | np.ndarray
) -> CommonFeedback:
    """Return the F of u = F y that gives every plant the prescribed coefficients.

    ``plants`` are A (n, n), ``b`` is B (n, m), ``c`` C (p, n), n = p_u m. ``wanted`` (p_u, m, m), N_0 first, contains
    the prescribed elements of the N_i, and nan for elements that may differ between plants. Raises InputError, and
    PlacementError, with the residual, if no common F exists.
    """
    if not len(plants):
        raise InputError("modal", "plants", "no plant", "give a list of matrices A")
    states = [state_matrix(plant) for plant in plants]
    inputs, outputs = input_matrix(b, len(states[0])), output_matrix(c, len(states[0]))
    size, order = inputs.shape[1], len(states[0])
    try:
        prescribed = np.array(wanted, dtype=float)
    except (TypeError, ValueError):
        raise InputError(
            "modal", "wanted", "not an array of numbers", "give p matrices, with nan for free elements"
        ) from None
    if any(len(state) != order for state in states) or order % size:
        sizes = ", ".join(str(len(state)) for state in states)
        remedy = "give n by n matrices of equal size, where n is a multiple of the number of inputs"
        raise InputError("modal", "plants", f"the plants have {sizes} states and {size} inputs", remedy)
    if prescribed.shape != (order // size, size, size):
        raise InputError(
            "modal", "wanted", f"has shape {prescribed.shape}", f"give shape {(order // size, size, size)}"
        )
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
        problem = (
            f"no F meets the prescription for all {len(states)} plants: a relative residual of {residual:.2g} remains"
        )
        remedy = "prescribe fewer elements, or measure more outputs"
        raise PlacementError("common output feedback", Reason.RESIDUAL, problem, residual, remedy)
    coefficients = np.array([split(row, size) for row in closed_poles])
    loops = [
        OutputFeedback(
            "common", gain, np.linalg.eigvals(block_companion(blocks)), state + inputs @ gain @ outputs, condition
        )
        for state, blocks, condition in zip(states, coefficients, conditions, strict=True)
    ]
    return CommonFeedback(gain, coefficients, residual, loops)
