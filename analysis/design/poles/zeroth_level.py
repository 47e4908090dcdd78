"""Output feedback on the zeroth level of the decomposition.

K_1 places n - m poles on (A_1, B_1) = (P A P', P A B), P B = 0. With B^- = B^+ - K_1 P, X = B^- C^perp and
Y = B^- A C^perp (m x (n - p)) the other m are those of

    Phi_0 = Y X^+ + Z Q,    Q X = 0,    F = (Phi_0 B^- - B^- A) C^+,    u = F y,

Z by the dual placement on (Y X^+, Q): then F C = Phi_0 B^- - B^- A, the state feedback of the multilevel placement.
Generic for m + p > n. After Van der Woude, "A note on pole placement by static output feedback for single-input
systems" (1988) and the thesis of Lapin (2.3.1.1); the formulas were derived here.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy.linalg import null_space

from .controllability import TOLERANCE
from .place import make_placement
from .refusal import PlacementError, Reason
from .results import OutputFeedback, StateFeedback
from .spectrum import Spectrum


class ZerothLevel:
    """The zeroth level of a plant with full ranks: m + p >= n."""

    def __init__(self, a: np.ndarray, b: np.ndarray, c: np.ndarray, basis: np.ndarray | None = None) -> None:
        """Of A (n, n), B (n, m), C (p, n); ``basis`` (n, n - m), columns with P = basis', else those of the null space.

        Raises PlacementError.
        """
        for name, matrix, rank in (("B", b, b.shape[1]), ("C", c, len(c))):
            sizes = np.linalg.svd(matrix, compute_uv=False)
            if len(sizes) < rank or sizes[-1] <= TOLERANCE * sizes[0]:
                ratio = float(sizes[-1] / sizes[0]) if len(sizes) == rank and sizes[0] else 0.0
                raise PlacementError(
                    "output feedback",
                    Reason.RANK,
                    f"{name} has not full rank: its singular values go down to {ratio:.2g} of the largest",
                    ratio,
                    "leave out inputs or outputs that others stand for",
                )
        self.a, self.b, self.c = a, b, c
        self.inverse, self.down = np.linalg.pinv(b), null_space(b.T).T if basis is None else basis.T
        self.hidden, self.seen = null_space(c), np.linalg.pinv(c)
        self.above = self.down @ a @ self.down.T, self.down @ a @ b

    @property
    def meets(self) -> bool:
        """Whether m + p = n."""
        return self.b.shape[1] + len(self.c) == len(self.a)

    def lower_matrices(self, upper_gain: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """B^-, X and Y for K_1 of u = K_1 x."""
        inverse = self.inverse - upper_gain @ self.down
        return inverse, inverse @ self.hidden, inverse @ self.a @ self.hidden

    def feedback(
        self, inverse: np.ndarray, phi: np.ndarray, upper: Spectrum, lower: Spectrum, condition: float
    ) -> OutputFeedback:
        """F from B^- and Phi_0; ``condition`` is cond X."""
        gain = (phi @ inverse - inverse @ self.a) @ self.seen
        return OutputFeedback(
            "direct",
            gain,
            np.concatenate([upper.poles, lower.poles]),
            self.a + self.b @ gain @ self.c,
            upper=upper.poles,
            condition_x=condition,
        )


def direct(level: ZerothLevel, upper: Spectrum, lower: Spectrum) -> OutputFeedback:
    """``upper`` (n - m poles) on the upper level, ``lower`` (m) on the zeroth, for m + p > n. Raises PlacementError."""
    return under(level, make_placement(*level.above, upper) if upper.size else None, upper, lower)


def under(level: ZerothLevel, first: StateFeedback | None, upper: Spectrum, lower: Spectrum) -> OutputFeedback:
    """The zeroth level under the gain of the upper one, ``first``. Raises PlacementError."""
    inverse, x, y = level.lower_matrices(-first.gain if first else np.zeros((lower.size, 0)))
    condition = condition_of(x)
    own, q = y @ np.linalg.pinv(x), null_space(x.T).T
    try:
        z = -make_placement(own.T, q.T, lower).gain.T
    except PlacementError as error:
        if error.reason is not Reason.NOT_CONTROLLABLE:
            raise
        raise PlacementError(
            "output feedback",
            Reason.NOT_OBSERVABLE,
            f"(Y X^+, Q) is not, of its dual {error.problem}",
            error.number,
            "spread the poles in another way",
        ) from None
    feedback = level.feedback(inverse, own + z @ q, upper, lower, condition)
    return feedback if first is None else replace(feedback, levels=first.levels, condition_u=first.condition_u)


def condition_of(x: np.ndarray) -> float:
    """cond X; 1 without columns. Raises PlacementError where it has not full column rank."""
    condition = float(np.linalg.cond(x)) if x.size else 1.0
    if not condition < 1.0 / TOLERANCE:
        raise PlacementError(
            "output feedback",
            Reason.RANK,
            f"X has not full column rank, cond X = {condition:.2g}",
            condition,
            "spread the poles in another way",
        )
    return condition
