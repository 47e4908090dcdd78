"""Output feedback by placing poles on the zeroth and the upper level of the decomposition.

K_1 places n - m poles on (A_1, B_1) = (P A P', P A B), P B = 0. With B^- = B^+ - K_1 P, X = B^- C^perp and Y = B^- A
C^perp (m, n - p) the other m poles are the eigenvalues of

    Phi_0 = Y X^+ + Z Q,    Q X = 0,    F = (Phi_0 B^- - B^- A) C^+,    u = F y,

with Z from the dual placement on (Y X^+, Q). Then F C = Phi_0 B^- - B^- A, which is the state feedback of the
multilevel placement. This works for generic plants with m + p > n. After Van der Woude, "A note on pole placement by
static output feedback for single-input systems" (1988) and the thesis of Lapin (2.3.1.1); the formulas are ours.

For m + p = n the gain K_1 determines Phi_0 = Y X^-1. The eigenvectors S of the upper level are free (Phi_1 = S D S^-1);
they are found by least squares, from random starts, from the m equations for the coefficients of the characteristic
polynomial of Phi_0. The method is ours; for m p > n generic plants have complex solutions (Brockett and Byrnes 1981),
but not always real ones.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.linalg import null_space
from scipy.optimize import least_squares

from ....common.errors import InputError
from .controllability import TOLERANCE
from .freedom import family_of, on_levels
from .place import make_placement, place_levels
from .plant import input_matrix, output_matrix, real_matrix, state_matrix
from .results import OutputFeedback, PlacementError, Reason, StateFeedback
from .smallest import polish
from .spectrum import Spectrum

_ORTHONORMAL = 1e-9
_SOLVED = 1e-5  # residual of the coefficients, with poles in units of the largest; Newton's method does the rest
_STEPS = 60  # iterations of a search; successful ones took fewer


class ZerothLevel:
    """Zeroth level of a plant with full ranks and m + p >= n."""

    def __init__(self, a: np.ndarray, b: np.ndarray, c: np.ndarray, basis: np.ndarray | None = None) -> None:
        """Decompose A (n, n), B (n, m), C (p, n); ``basis`` is P' (n, n - m), by default from the null space of B'.

        Raises PlacementError.
        """
        for name, matrix, rank in (("B", b, b.shape[1]), ("C", c, len(c))):
            sizes = np.linalg.svd(matrix, compute_uv=False)
            if len(sizes) < rank or sizes[-1] <= TOLERANCE * sizes[0]:
                ratio = float(sizes[-1] / sizes[0]) if len(sizes) == rank and sizes[0] else 0.0
                problem = (
                    f"{name} does not have full rank: its smallest singular value is {ratio:.2g} times the largest"
                )
                remedy = "remove inputs or outputs that depend linearly on others"
                raise PlacementError("output feedback", Reason.RANK, problem, ratio, remedy)
        self.a, self.b, self.c = a, b, c
        self.inverse, self.down = np.linalg.pinv(b), null_space(b.T).T if basis is None else basis.T
        self.hidden, self.pseudoinverse = null_space(c), np.linalg.pinv(c)
        self.above = self.down @ a @ self.down.T, self.down @ a @ b

    @property
    def is_exact(self) -> bool:
        """True if m + p = n: the gain of the upper level then determines the poles of the zeroth."""
        return self.b.shape[1] + len(self.c) == len(self.a)

    def lower_matrices(self, upper_gain: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return B^-, X and Y for the gain K_1 of the upper level, u = K_1 x."""
        inverse = self.inverse - upper_gain @ self.down
        return inverse, inverse @ self.hidden, inverse @ self.a @ self.hidden

    def feedback(
        self, inverse: np.ndarray, phi: np.ndarray, upper: Spectrum, lower: Spectrum, condition: float
    ) -> OutputFeedback:
        """Return F from B^- and Phi_0; ``condition`` is the condition number of X."""
        gain = (phi @ inverse - inverse @ self.a) @ self.pseudoinverse
        return OutputFeedback(
            "direct",
            gain,
            np.concatenate([upper.poles, lower.poles]),
            self.a + self.b @ gain @ self.c,
            upper=upper.poles,
            condition_x=condition,
        )


def place_direct(level: ZerothLevel, upper: Spectrum, lower: Spectrum) -> OutputFeedback:
    """Place ``upper`` (n - m poles) on the upper level and ``lower`` (m poles) on the zeroth, for m + p > n.

    Raises PlacementError.
    """
    return place_zeroth_level(level, make_placement(*level.above, upper) if upper.size else None, upper, lower)


def place_zeroth_level(
    level: ZerothLevel, first: StateFeedback | None, upper: Spectrum, lower: Spectrum
) -> OutputFeedback:
    """Return the feedback with gain ``first`` on the upper level and placed zeroth level. Raises PlacementError."""
    inverse, x, y = level.lower_matrices(-first.gain if first else np.zeros((lower.size, 0)))
    condition = condition_of(x)
    own, q = y @ np.linalg.pinv(x), null_space(x.T).T
    try:
        z = -make_placement(own.T, q.T, lower).gain.T
    except PlacementError as error:
        if error.reason is not Reason.NOT_CONTROLLABLE:
            raise
        problem = f"the zeroth level (Y X^+, Q) is not observable; of its dual, {error.problem}"
        remedy = "distribute the poles over the levels in another way"
        raise PlacementError("output feedback", Reason.NOT_OBSERVABLE, problem, error.number, remedy) from None
    feedback = level.feedback(inverse, own + z @ q, upper, lower, condition)
    return feedback if first is None else replace(feedback, levels=first.levels, condition_u=first.condition_u)


def condition_of(x: np.ndarray) -> float:
    """Return cond X; 1 without columns. Raises PlacementError if X does not have full column rank."""
    condition = float(np.linalg.cond(x)) if x.size else 1.0
    if not condition < 1.0 / TOLERANCE:
        problem = f"X does not have full column rank, cond(X) = {condition:.2g}"
        raise PlacementError(
            "output feedback", Reason.RANK, problem, condition, "distribute the poles over the levels in another way"
        )
    return condition


def output_feedback_levels(
    a: ArrayLike, b: ArrayLike, c: ArrayLike, upper: ArrayLike, poles: ArrayLike, *, basis: ArrayLike | None = None
) -> OutputFeedback:
    """Return the gain F (m, p) of **u = F y**, m + p > n, with the matrix ``upper`` on the upper level.

    ``upper`` (n - m, n - m) is the closed-loop matrix of the upper level in the coordinates basis' x, where ``basis``
    (n, n - m) has orthonormal columns with basis' B = 0, by default from a singular value decomposition. ``poles`` are
    the other m poles, on the zeroth level. F is unique for a prescribed basis. For the dual method pass A', C', B' and
    transpose F. Raises InputError, and PlacementError if the upper level is not completely controllable or the method
    does not apply.
    """
    state = state_matrix(a)
    inputs, outputs = input_matrix(b, len(state)), output_matrix(c, len(state))
    size = len(state) - inputs.shape[1]
    checked = None
    if basis is not None:
        checked = real_matrix("basis", basis, (len(state), size))
        off = max(
            np.abs(checked.T @ checked - np.eye(size)).max(), np.abs(checked.T @ inputs).max() / np.abs(inputs).max()
        )
        if off > _ORTHONORMAL:
            problem = f"not an orthonormal basis of the null space of B': the largest error is {off:.2g}"
            raise InputError("modal", "basis", problem, "use orthonormal columns, such as scipy.linalg.null_space(B.T)")
    level = ZerothLevel(state, inputs, outputs, checked)
    desired = real_matrix("upper", upper, (size, size))
    first = place_levels(*level.above, [desired], bases=[np.eye(size)])
    high = Spectrum.of(np.linalg.eigvals(desired), size, "upper")
    return place_zeroth_level(level, first, high, Spectrum.of(poles, inputs.shape[1]))


def place_square(level: ZerothLevel, upper: Spectrum, lower: Spectrum, starts: int, seed: int) -> OutputFeedback:
    """Place ``upper`` (n - m poles) on the upper level and ``lower`` (m poles) on the zeroth, for m + p = n.

    Raises PlacementError.
    """
    levels, family = family_of(*level.above, upper)
    radius = float(np.max(np.abs(lower.poles)))
    desired = np.poly(lower.poles / radius).real[1:]

    def residual(free: np.ndarray) -> np.ndarray:
        _, x, y = level.lower_matrices(family.gain(family.at(free)))
        return np.poly(np.linalg.solve(x.T, y.T) / radius).real[1:] - desired

    random = np.random.default_rng(seed)
    minimum = np.inf
    for _ in range(starts):
        solution = least_squares(residual, random.normal(size=family.parameters), max_nfev=_STEPS)
        minimum = min(minimum, size := float(np.max(np.abs(solution.fun))))
        if size < _SOLVED:
            first = on_levels(levels, family, solution.x)
            inverse, x, y = level.lower_matrices(-first.gain)
            phi = np.linalg.solve(x.T, y.T).T
            placed = replace(level.feedback(inverse, phi, upper, lower, condition_of(x)), levels=first.levels)
            return polish(placed, level.a, level.b, level.c)
    problem = (
        f"the iteration did not converge (m + p = n): after the best of {starts} starts, the residual of "
        f"the characteristic polynomial is {minimum:.2g}"
    )
    remedy = "give more starts, distribute the poles over the levels in another way, or measure more outputs"
    raise PlacementError("output feedback", Reason.RESIDUAL, problem, minimum, remedy)
