"""Every output feedback of a plant as a set with free parameters, through the state feedbacks that are one.

A state feedback K(N) of the generalised Ackermann formula is an output feedback, K = -F C, when K(N) C^perp = 0. That
is linear in the N_i; m p numbers z remain free: N = N* + sum z_j N^j. The spectrum is that of the block companion of N.
Lapin's thesis (2.3.2); the equations were derived here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import null_space

from .ackermann import row_stack, split
from .plant import input_matrix, output_matrix, real_matrix, state_matrix
from .polynomial import block_companion
from .refusal import PlacementError, Reason
from .results import OutputFeedback


@dataclass(frozen=True)
class OutputFeedbackSet:
    """N = ``particular`` + sum z_j ``directions``[j], arrays (p, m, m) as `place_polynomial` takes them; see `at`."""

    a: np.ndarray
    b: np.ndarray
    c: np.ndarray
    particular: np.ndarray
    directions: np.ndarray  # (free, p, m, m)
    condition_u: float

    @property
    def free(self) -> int:
        """How many numbers z has."""
        return len(self.directions)

    def coefficients(self, z: ArrayLike) -> np.ndarray:
        """N (p, m, m) at z (free,). Raises InputError."""
        return self.particular + np.tensordot(real_matrix("z", z, (self.free,)), self.directions, axes=1)

    def at(self, z: ArrayLike) -> OutputFeedback:
        """u = F y at z (free,); its poles are those of N(z). Raises InputError."""
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
        """The z (free,) of any F (m, p). Raises InputError."""
        matrix = real_matrix("F", gain, (self.b.shape[1], len(self.c)))
        stack, power, _ = row_stack(self.a, self.b)
        apart = split(np.linalg.solve(stack.T, (-matrix @ self.c - power).T).T, self.b.shape[1]) - self.particular
        # the directions are orthonormal
        return self.directions.reshape(self.free, -1) @ apart.ravel()


def output_feedback_set(a: ArrayLike, b: ArrayLike, c: ArrayLike) -> OutputFeedbackSet:
    """Every u = F y of x' = A x + B u, y = C x with n = p_u m states, U = [B AB ..] nonsingular, C of full row rank.

    ``a`` is A (n, n), ``b`` B (n, m), ``c`` C (p, n). Raises InputError and PlacementError.
    """
    state = state_matrix(a)
    inputs, outputs = input_matrix(b, len(state)), output_matrix(c, len(state))
    size = inputs.shape[1]
    stack, power, condition = row_stack(state, inputs)
    hidden = null_space(outputs)
    if hidden.shape[1] != len(state) - len(outputs):
        rank = len(state) - hidden.shape[1]
        raise PlacementError(
            "set of output feedbacks",
            Reason.RANK,
            f"C of {len(outputs)} rows has rank {rank}",
            rank,
            "leave out what other outputs say already",
        )
    # [N] V C^perp = -T A^p C^perp, each row of [N] by itself
    seen = stack @ hidden
    row = -power @ hidden @ np.linalg.pinv(seen)
    retained = null_space(seen.T).T
    directions = np.zeros((size, len(retained), size, len(state)))
    for i in range(size):
        directions[i, :, i] = retained
    blocks = [split(side_by_side, size) for side_by_side in directions.reshape(-1, size, len(state))]
    return OutputFeedbackSet(state, inputs, outputs, split(row, size), np.array(blocks), condition)
