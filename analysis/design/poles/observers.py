"""Observers as duals of state feedback: of full order, and of reduced order n - p.

Luenberger, "Observers for multivariable systems", IEEE Transactions on Automatic Control 11 (1966). With W = C^perp
(orthonormal columns, C W = 0) x = C^+ y + W z, and zeta = z_h - Lr y eliminates y' from the reduced observer.
"""

from __future__ import annotations

from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import null_space

from ....common.errors import InputError
from .controllability import TOLERANCE
from .place import PlaceOptions, place
from .plant import input_matrix, output_matrix, state_matrix
from .results import Observer, PlacementError, Reason, ReducedObserver, StateFeedback


def observer(a: ArrayLike, c: ArrayLike, poles: ArrayLike, **options: Unpack[PlaceOptions]) -> Observer:
    """Return the gain L (n, p) of x_h' = A x_h + B u + L (y - C x_h) that gives A - L C the n ``poles``.

    ``a`` is A (n, n), ``c`` C (p, n). L' is the gain K that `place` returns for (A', C') with the same ``options``
    (method, choice, tolerance, starts, seed). Raises InputError; PlacementError if the pair is not observable or the
    method does not apply.
    """
    state = state_matrix(a)
    outputs = output_matrix(c, len(state))
    dual = _dual(state, outputs, poles, options)
    return Observer(dual.method, dual.gain.T, dual.wanted, state - dual.gain.T @ outputs, dual.condition_u, dual.levels)


def reduced_observer(
    a: ArrayLike, c: ArrayLike, poles: ArrayLike, *, b: ArrayLike | None = None, **options: Unpack[PlaceOptions]
) -> ReducedObserver:
    """Return the observer of order n - p for noise-free outputs, with its n - p ``poles``.

    ``b`` is B (n, m) if there are inputs; other arguments are as in `observer`. The result's zeta' = M zeta + from_y y
    + from_u u, x_h = of_zeta zeta + of_y y satisfies C x_h = y at all times. Raises InputError; PlacementError if C
    does not have full row rank, or the pair is not observable.
    """
    state = state_matrix(a)
    outputs = output_matrix(c, len(state))
    driven = input_matrix(b, len(state)) if b is not None else np.zeros((len(state), 0))
    sizes = np.linalg.svd(outputs, compute_uv=False)
    if len(outputs) > len(state) or sizes[-1] <= TOLERANCE * sizes[0]:
        ratio = float(sizes[-1] / sizes[0]) if sizes[0] else 0.0
        shape = f"C, {len(outputs)} by {len(state)}"
        problem = f"{shape}, is rank deficient: its smallest singular value is {ratio:.2g} times the largest"
        remedy = "remove outputs that depend linearly on others"
        raise PlacementError("reduced observer", Reason.RANK, problem, ratio, remedy)
    if len(outputs) == len(state):
        raise InputError("modal", "C", "C measures every state, and no observer is needed", "use x = C^-1 y")
    hidden, inverse = null_space(outputs), np.linalg.pinv(outputs)
    own, measured = hidden.T @ state, outputs @ state
    dual = _dual(own @ hidden, measured @ hidden, poles, options)
    gain = dual.gain.T
    matrix = own @ hidden - gain @ measured @ hidden
    return ReducedObserver(
        dual.method,
        gain,
        dual.wanted,
        matrix,
        dual.condition_u,
        dual.levels,
        from_y=matrix @ gain + (own - gain @ measured) @ inverse,
        from_u=(hidden.T - gain @ outputs) @ driven,
        of_zeta=hidden,
        of_y=inverse + hidden @ gain,
    )


def _dual(a: np.ndarray, c: np.ndarray, poles: ArrayLike, options: PlaceOptions) -> StateFeedback:
    try:
        return place(a.T, c.T, poles, **options)
    except PlacementError as error:
        if error.reason is not Reason.NOT_CONTROLLABLE:
            raise
        raise PlacementError(
            "observer",
            Reason.NOT_OBSERVABLE,
            f"the plant is not observable; of its dual (A', C'), {error.problem}",
            error.number,
            "measure further states",
        ) from None
