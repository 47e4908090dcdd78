"""Pole placement by feedback of the state's derivative, u = -K x'.

(I + B K) x' = A x, so that x = (A^-1 + A^-1 B K) x': the poles are the inverses of the eigenvalues of A^-1 + A^-1 B K,
and -K is the gain on the state that places 1/s_i on (A^-1, A^-1 B). A must be nonsingular, and no pole may be 0. From a
gain Kx on the state that places the same poles, K = Kx (A - B Kx)^-1.

det(I + B K) is the product of the plant's poles divided by the product of the placed poles. In practice x' is slightly
delayed by sensing, filter or sampling: a lag h of the derivative, h u' = -u - K x' with h small, preserves the placed
poles only if all eigenvalues of I + K B have positive real parts. For one input this excludes an odd number of unstable
real poles; for several inputs it does not if the number of such poles is even.

Lapin's thesis, section 1.3.4, states the task; Abdelaziz and Valasek, "Direct algorithm for pole placement by
state-derivative feedback for multi-input linear systems - nonsingular case", Kybernetika 41 (2005); lags: Michiels,
Vyhlidal, Huijberts and Nijmeijer, "Stabilizability and stability robustness of state derivative feedback controllers",
SIAM Journal on Control and Optimization 47 (2009).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Unpack

import numpy as np
from numpy.typing import ArrayLike

from ....common.errors import InputError
from ..poles.controllability import TOLERANCE
from ..poles.place import PlaceOptions, place
from ..poles.plant import input_matrix, state_matrix
from ..poles.results import Placement, PlacementError, Reason
from ..poles.spectrum import Spectrum


@dataclass(frozen=True, kw_only=True)
class DerivativeFeedback(Placement):
    """Feedback u = -K x' with K = ``gain`` (m, n): the closed loop is (I + B K)^-1 A.

    ``fast`` (m,) are the eigenvalues of I + K B. A lag h of the derivative adds modes near -``fast``/h.
    """

    fast: np.ndarray

    @property
    def stands_lag(self) -> bool:
        """True if a small lag of the derivative preserves the placed poles: ``fast`` has positive real parts only."""
        return bool(np.all(self.fast.real > 0.0))


def place_derivative(
    a: ArrayLike, b: ArrayLike, poles: ArrayLike, **options: Unpack[PlaceOptions]
) -> DerivativeFeedback:
    """Return the gain K (m, n) of **u = -K x'** that gives (I + B K)^-1 A the poles.

    ``a`` is A (n, n), nonsingular, ``b`` B (n, m) of a continuous plant x' = A x + B u; ``poles`` (1/s, none of them 0)
    and ``options`` are as in `place`. A counts as singular if a singular value is below 1e-9 of the largest. Raises
    InputError; PlacementError for a singular A, or if the method does not apply to (A^-1, A^-1 B).
    """
    state = state_matrix(a)
    inputs = input_matrix(b, len(state))
    spectrum = Spectrum.of(poles, len(state))
    if not np.all(spectrum.poles):
        raise InputError(
            "modal", "poles", "a pole is 0, which derivative feedback cannot place", "give poles other than 0"
        )
    sizes = np.linalg.svd(state, compute_uv=False)
    if not sizes[-1] > TOLERANCE * sizes[0]:
        ratio = float(sizes[-1] / sizes[0]) if sizes[0] else 0.0
        problem = f"A is singular: its smallest singular value is {ratio:.2g} times the largest"
        remedy = "use state feedback, or remove the modes of A at s = 0"
        raise PlacementError("derivative feedback", Reason.SINGULAR, problem, ratio, remedy)
    back = np.linalg.inv(state)
    dual = place(back, back @ inputs, 1.0 / spectrum.poles, **options)
    gain = -dual.gain
    closed_loop = np.linalg.solve(np.eye(len(state)) + inputs @ gain, state)
    fast = np.linalg.eigvals(np.eye(inputs.shape[1]) + gain @ inputs)
    return DerivativeFeedback(dual.method, gain, spectrum.poles, closed_loop, dual.condition_u, dual.levels, fast=fast)
