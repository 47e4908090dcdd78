"""Pole placement under constant disturbances: integrals of the outputs are fed back with the state.

x' = A x + B u + E d, y = C x, q' = y - r with constant, unknown d and reference r: u = -K x - Ki q is a gain on the
state of [A 0; C 0], [B; 0], and at rest y = r, for any d, E and small errors of A and B. For a sampled plant q+ = q + y
- r and [A 0; C I]. The extended pair is controllable if (A, B) is controllable and the plant from u to y has no zero at
0, or at the multiplier 1 if it is sampled: [A B; C 0], or [A - I B; C 0], has full row rank.

Davison, "The robust control of a servomechanism problem for linear time-invariant multivariable systems", IEEE
Transactions on Automatic Control 21 (1976); Lapin's thesis lists modal control under disturbances among its methods.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from ..poles.controllability import TOLERANCE
from ..poles.place import PlaceOptions, place
from ..poles.plant import input_matrix, output_matrix, state_matrix
from ..poles.results import Placement, PlacementError, Reason


@dataclass(frozen=True, kw_only=True)
class IntegralFeedback(Placement):
    """Feedback u = -K x - Ki q with the integral q' = y - r, or q+ = q + y - r.

    K is ``on_state`` (m, n), Ki is ``on_integral`` (m, p), ``gain`` is [K Ki] (m, n + p) and ``closed_loop`` the matrix
    of (x, q).
    """

    on_state: np.ndarray
    on_integral: np.ndarray


def place_integral(
    a: ArrayLike,
    b: ArrayLike,
    c: ArrayLike,
    poles: ArrayLike,
    *,
    sampled: bool = False,
    **options: Unpack[PlaceOptions],
) -> IntegralFeedback:
    """Return the gains of **u = -K x - Ki q**, q' = C x - r, that place the n + p poles of state and integrals.

    ``a`` is A (n, n), ``b`` B (n, m), ``c`` C (p, n) of the p <= m outputs that equal the reference at rest; ``poles``
    are in 1/s, or multipliers of a ``sampled`` plant with q+ = q + C x - r; ``options`` as in `place`. Raises
    InputError; PlacementError for an uncontrollable plant, or one with a zero at rest.
    """
    state = state_matrix(a)
    inputs, outputs = input_matrix(b, len(state)), output_matrix(c, len(state))
    count, states = len(outputs), len(state)
    carried = np.eye(count) if sampled else np.zeros((count, count))
    at_rest = np.block([[state - sampled * np.eye(states), inputs], [outputs, np.zeros((count, inputs.shape[1]))]])
    sizes = np.linalg.svd(at_rest, compute_uv=False)
    if states + count > at_rest.shape[1] or sizes[-1] <= TOLERANCE * sizes[0]:
        ratio = float(sizes[-1] / sizes[0]) if states + count <= at_rest.shape[1] else 0.0
        problem = (
            f"the plant has a zero at s = 0: the smallest singular value of [A B; C 0] is {ratio:.2g} times the largest"
        )
        remedy = "integrate no more outputs than there are inputs, and only outputs that constant inputs can change"
        raise PlacementError("integral feedback", Reason.RANK, problem, ratio, remedy)
    whole = np.block([[state, np.zeros((states, count))], [outputs, carried]])
    driven = np.vstack([inputs, np.zeros((count, inputs.shape[1]))])
    placed = place(whole, driven, poles, **options)
    return IntegralFeedback(
        placed.method,
        placed.gain,
        placed.wanted,
        placed.closed_loop,
        placed.condition_u,
        placed.levels,
        on_state=placed.gain[:, :states],
        on_integral=placed.gain[:, states:],
    )
