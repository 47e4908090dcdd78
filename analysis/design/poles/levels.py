"""Output feedback from the matrix that the upper level should have, not from its poles alone."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ...common.errors import InputError
from .place import place_levels
from .plant import input_matrix, output_matrix, real_matrix, state_matrix
from .results import OutputFeedback
from .spectrum import Spectrum
from .zeroth_level import ZerothLevel, under

_ORTHONORMAL = 1e-9


def output_feedback_levels(
    a: ArrayLike, b: ArrayLike, c: ArrayLike, upper: ArrayLike, poles: ArrayLike, *, basis: ArrayLike | None = None
) -> OutputFeedback:
    """The gain F (m, p) of **u = F y**, m + p > n, with the matrix ``upper`` on the upper level, ``poles`` below.

    ``upper`` (n - m, n - m) is what moves the coordinates basis' x of the upper level in the closed loop; ``basis``
    (n, n - m) are orthonormal columns with basis' B = 0, else those of a singular value decomposition. ``poles`` are
    the other m. With a basis F is unique. For the dual give A', C', B' and transpose F. Raises InputError, and
    PlacementError where the upper level is not driven as a whole or the rest does not apply.
    """
    state = state_matrix(a)
    inputs, outputs = input_matrix(b, len(state)), output_matrix(c, len(state))
    size = len(state) - inputs.shape[1]
    given = None
    if basis is not None:
        given = real_matrix("basis", basis, (len(state), size))
        off = max(np.abs(given.T @ given - np.eye(size)).max(), np.abs(given.T @ inputs).max() / np.abs(inputs).max())
        if off > _ORTHONORMAL:
            problem = f"its columns are not orthonormal with basis' B = 0, by {off:.2g}"
            raise InputError("modal", "basis", problem, "take columns of the null space of B'")
    level = ZerothLevel(state, inputs, outputs, given)
    wanted = real_matrix("upper", upper, (size, size))
    first = place_levels(*level.above, [wanted], bases=[np.eye(size)])
    high = Spectrum.of(np.linalg.eigvals(wanted), size, "upper")
    return under(level, first, high, Spectrum.of(poles, inputs.shape[1]))
